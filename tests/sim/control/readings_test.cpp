#include "sim/control/readings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/control/flavour.h"
#include "tests/sim/control/fake_senses.h"

namespace swarmsmith {
namespace {

TEST(ObstacleStrength, OfTheThesisFallsLinearlyFromOneToZero) {
  const ObstacleModel& model = watermelon().obstacles;
  EXPECT_EQ(obstacle_strength(-kNothing, model), 1);
  EXPECT_EQ(obstacle_strength(0.05, model), 1);
  EXPECT_NEAR(obstacle_strength(0.225, model), 0.5, 1e-15);
  EXPECT_EQ(obstacle_strength(0.4, model), 0);
  EXPECT_EQ(obstacle_strength(kNothing, model), 0);
}

TEST(ObstacleStrength, OfTheProgramIsTheInverseDistanceWithinItsRange) {
  const ObstacleModel& model = watermelon_argos3().obstacles;
  EXPECT_EQ(obstacle_strength(-kNothing, model), 0);
  EXPECT_EQ(obstacle_strength(0.049, model), 0);
  EXPECT_EQ(obstacle_strength(0.05, model), 20);
  EXPECT_EQ(obstacle_strength(0.4, model), 2.5);
  EXPECT_EQ(obstacle_strength(0.41, model), 0);
  EXPECT_EQ(obstacle_strength(kNothing, model), 0);
}

TEST(NeighbourStrength, FallsFromTouchToHalfAMetre) {
  const ObstacleModel& model = watermelon().obstacles;
  EXPECT_EQ(neighbour_strength(0.2, model), 1);
  EXPECT_EQ(neighbour_strength(0.275, model), 1);
  EXPECT_NEAR(neighbour_strength(0.4125, model), 0.5, 1e-15);
  EXPECT_EQ(neighbour_strength(0.55, model), 0);
  EXPECT_EQ(neighbour_strength(0.7, model), 0);
}

TEST(ProximityDirections, AreUnitVectorsOfTheirAngles) {
  for (std::size_t i = 0; i < kProximityDirections.size(); ++i) {
    const double angle = kProximityDirections_deg[i] * 3.14159265358979323846 / 180;
    EXPECT_NEAR(kProximityDirections[i].x, std::cos(angle), 1e-15);
    EXPECT_NEAR(kProximityDirections[i].y, std::sin(angle), 1e-15);
  }
}

TEST(ObstacleVector, OfTheProgramIsCutToOne) {
  const auto senses = FakeSenses{}.obstacle(0, 0.25).obstacle(90, 1.0 / 3);  // (4, 3), length 5
  const Vector2 sum = obstacle_vector(senses.distances, {}, watermelon_argos3().obstacles);
  EXPECT_NEAR(sum.x, 0.8, 1e-15);
  EXPECT_NEAR(sum.y, 0.6, 1e-15);
  // Readings that nearly cancel leave a short vector: 1/0.2 - 1/0.206 = 0.146.
  const auto between = FakeSenses{}.obstacle(0, 0.2).obstacle(180, 0.206);
  const Vector2 rest = obstacle_vector(between.distances, {}, watermelon_argos3().obstacles);
  EXPECT_NEAR(rest.x, 1 / 0.2 - 1 / 0.206, 1e-12);
  EXPECT_EQ(rest.y, 0);
}

TEST(ObstacleVector, OfTheThesisIsThePlainSumWithTheNeighbours) {
  const auto senses =
      FakeSenses{}.obstacle(0, 0.05).obstacle(90, 0.225).neighbour(0.4125, 0).neighbour(0.275, -90);
  const Vector2 sum = obstacle_vector(senses.distances, senses.others, watermelon().obstacles);
  EXPECT_NEAR(sum.x, 1.5, 1e-15);
  EXPECT_NEAR(sum.y, -0.5, 1e-15);
}

TEST(GrayLevel, IsAnExactIntegerInThousandths) {
  EXPECT_EQ(gray_level({0, 0, 0}), 0);
  EXPECT_EQ(gray_level({127, 127, 127}), 127'000);
  EXPECT_EQ(gray_level({255, 255, 255}), 255'000);
  EXPECT_EQ(gray_level({0, 255, 0}), 149'685);
  EXPECT_EQ(gray_level({255, 255, 0}), 225'930);
}

TEST(HueAndSaturation, GoRoundTheWheel) {
  const auto hue = [](Rgb color) { return hue_and_saturation(color)->hue_deg; };
  EXPECT_EQ(hue({255, 0, 0}), 0);
  EXPECT_EQ(hue({255, 255, 0}), 60);
  EXPECT_EQ(hue({0, 255, 0}), 120);
  EXPECT_EQ(hue({0, 255, 255}), 180);
  EXPECT_EQ(hue({0, 0, 255}), 240);
  EXPECT_EQ(hue({255, 0, 255}), 300);
  EXPECT_EQ(hue({200, 0, 100}), 330);
  EXPECT_EQ(hue_and_saturation({200, 100, 100})->saturation, 0.5);
}

TEST(HueAndSaturation, GreysHaveNone) {
  EXPECT_FALSE(hue_and_saturation({0, 0, 0}).has_value());
  EXPECT_FALSE(hue_and_saturation({127, 127, 127}).has_value());
}

}  // namespace
}  // namespace swarmsmith
