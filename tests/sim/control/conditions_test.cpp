#include "sim/control/conditions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "sim/control/flavour.h"
#include "sim/control/readings.h"
#include "tests/sim/control/fake_senses.h"

namespace swarmsmith {
namespace {

double probability_on(const Condition& condition, Rgb floor, const Flavour& flavour) {
  FakeSenses senses;
  senses.floor = floor;
  return enabling_probability(condition, senses, flavour);
}

bool holds_on(const Condition& condition, Rgb floor, const Flavour& flavour) {
  return probability_on(condition, floor, flavour) > 0;
}

Rgb gray(int level) {
  const auto channel = static_cast<std::uint8_t>(level);
  return {channel, channel, channel};
}

/// What a floor means to the floor and colour conditions.
struct FloorCase {
  Rgb floor;
  bool black;
  bool gray;
  bool white;
  std::optional<ColorLabel> label;
};

void expect_floor(const FloorCase& expected, const Flavour& flavour) {
  const Rgb floor = expected.floor;
  SCOPED_TRACE(flavour.name + ", red " + std::to_string(floor.r) + " green " +
               std::to_string(floor.g) + " blue " + std::to_string(floor.b));
  EXPECT_EQ(holds_on(BlackFloor{1}, floor, flavour), expected.black);
  EXPECT_EQ(holds_on(GrayFloor{1}, floor, flavour), expected.gray);
  EXPECT_EQ(holds_on(WhiteFloor{1}, floor, flavour), expected.white);
  for (const LabelSpec& spec : flavour.floor.labels) {
    EXPECT_EQ(holds_on(ColorDetection{1, spec.label}, floor, flavour), expected.label == spec.label)
        << name_of(spec.label);
  }
}

TEST(FloorConditions, FollowTheTableOfTheThesis) {
  // thesis facts, section 7.
  for (const FloorCase& expected :
       {FloorCase{{0, 0, 0}, true, false, false, std::nullopt},
        FloorCase{{127, 127, 127}, false, true, false, std::nullopt},
        FloorCase{{0, 255, 0}, false, true, false, ColorLabel::Green},
        FloorCase{{255, 0, 0}, false, false, false, ColorLabel::Red},
        FloorCase{{255, 255, 0}, false, false, true, ColorLabel::Yellow},
        FloorCase{{0, 0, 255}, false, false, false, ColorLabel::Blue}}) {
    expect_floor(expected, watermelon());
  }
}

TEST(FloorConditions, FollowTheTableOfTheProgram) {
  // rvr-automode facts, section 6.1: red counts as grey.
  for (const FloorCase& expected :
       {FloorCase{{0, 0, 0}, true, false, false, std::nullopt},
        FloorCase{{127, 127, 127}, false, true, false, std::nullopt},
        FloorCase{{0, 255, 0}, false, true, false, ColorLabel::Green},
        FloorCase{{255, 0, 0}, false, true, false, ColorLabel::Red},
        FloorCase{{255, 255, 0}, false, false, true, ColorLabel::Yellow},
        FloorCase{{0, 0, 255}, false, true, false, ColorLabel::Blue}}) {
    expect_floor(expected, watermelon_argos3());
  }
}

TEST(FloorConditions, ThresholdsOfTheThesisAreFractionsOfOne) {
  const Flavour& flavour = watermelon();
  EXPECT_TRUE(holds_on(BlackFloor{1}, gray(12), flavour));    // 0.047
  EXPECT_FALSE(holds_on(BlackFloor{1}, gray(13), flavour));   // 0.051
  EXPECT_FALSE(holds_on(GrayFloor{1}, gray(94), flavour));    // 0.3686
  EXPECT_TRUE(holds_on(GrayFloor{1}, gray(95), flavour));     // 0.3725
  EXPECT_TRUE(holds_on(GrayFloor{1}, gray(160), flavour));    // 0.6275
  EXPECT_FALSE(holds_on(GrayFloor{1}, gray(161), flavour));   // 0.6314
  EXPECT_FALSE(holds_on(WhiteFloor{1}, gray(198), flavour));  // 0.776
  EXPECT_TRUE(holds_on(WhiteFloor{1}, gray(199), flavour));   // 0.7804
}

TEST(FloorConditions, ThresholdsOfTheProgramAreOf255) {
  const Flavour& flavour = watermelon_argos3();
  EXPECT_FALSE(holds_on(BlackFloor{1}, {0, 0, 1}, flavour));  // 0.114: noise hides the black
  EXPECT_TRUE(holds_on(GrayFloor{1}, {0, 0, 1}, flavour));
  EXPECT_TRUE(holds_on(GrayFloor{1}, gray(159), flavour));
  EXPECT_FALSE(holds_on(GrayFloor{1}, gray(160), flavour));
  EXPECT_FALSE(holds_on(WhiteFloor{1}, gray(219), flavour));
  EXPECT_TRUE(holds_on(WhiteFloor{1}, gray(220), flavour));
}

TEST(FloorConditions, AreEnabledWithTheirProbability) {
  EXPECT_EQ(probability_on(BlackFloor{0.3}, gray(0), watermelon()), 0.3);
  EXPECT_EQ(probability_on(GrayFloor{0.4}, gray(127), watermelon()), 0.4);
  EXPECT_EQ(probability_on(WhiteFloor{0.5}, gray(255), watermelon()), 0.5);
  EXPECT_EQ(probability_on(ColorDetection{0.6, ColorLabel::Red}, {255, 0, 0}, watermelon()), 0.6);
}

TEST(ColorDetection, TheThesisWrapsTheHueTheProgramDoesNot) {
  // Hue 345.9 degrees: 14.1 from red, the short way.
  const ColorDetection red{1, ColorLabel::Red};
  EXPECT_TRUE(holds_on(red, {255, 0, 60}, watermelon()));
  EXPECT_FALSE(holds_on(red, {255, 0, 60}, watermelon_argos3()));
}

TEST(ColorDetection, TheThesisLooksAtTheHueAloneTheProgramAtTheSaturationToo) {
  const ColorDetection red{1, ColorLabel::Red};
  EXPECT_TRUE(holds_on(red, {128, 127, 127}, watermelon()));  // a grey floor with noise
  EXPECT_FALSE(holds_on(red, {128, 127, 127}, watermelon_argos3()));
  EXPECT_TRUE(holds_on(red, {250, 51, 51}, watermelon()));  // saturation 0.796
  EXPECT_FALSE(holds_on(red, {250, 51, 51}, watermelon_argos3()));
  EXPECT_TRUE(holds_on(red, {250, 49, 49}, watermelon_argos3()));  // 0.804
}

TEST(ColorDetection, AHueMustBeNearerThan15Degrees) {
  for (const Flavour* flavour : {&watermelon(), &watermelon_argos3()}) {
    EXPECT_FALSE(holds_on(ColorDetection{1, ColorLabel::Red}, {240, 60, 0}, *flavour));  // 15
    EXPECT_TRUE(holds_on(ColorDetection{1, ColorLabel::Red}, {240, 59, 0}, *flavour));   // 14.75
    EXPECT_TRUE(holds_on(ColorDetection{1, ColorLabel::Yellow}, {240, 190, 0}, *flavour));
  }
}

TEST(NeighbourCount, IsASigmoidOfTheNumberOfNeighbours) {
  FakeSenses senses;
  const NeighbourCount count{.eta = 2, .xi = 1};
  EXPECT_NEAR(enabling_probability(count, senses, watermelon()), 1 / (1 + std::exp(2.0)), 1e-15);
  senses.neighbour(0.5, 0);
  EXPECT_EQ(enabling_probability(count, senses, watermelon()), 0.5);
  senses.neighbour(0.5, 90);
  EXPECT_NEAR(enabling_probability(count, senses, watermelon()), 1 / (1 + std::exp(-2.0)), 1e-15);
}

TEST(NeighbourCount, WithEtaZeroIsOneHalfWhateverTheNeighbours) {
  FakeSenses senses;
  for (int n = 0; n < 3; ++n) {
    EXPECT_EQ(enabling_probability(NeighbourCount{.eta = 0, .xi = 1}, senses, watermelon()), 0.5);
    senses.neighbour(0.5, 0);
  }
}

TEST(InvertedNeighbourCount, IsOneMinusTheOther) {
  FakeSenses senses;
  senses.neighbour(0.5, 0);
  for (const int xi : {0, 1, 2, 10}) {
    const double z =
        enabling_probability(NeighbourCount{.eta = 1.5, .xi = xi}, senses, watermelon());
    EXPECT_EQ(
        enabling_probability(InvertedNeighbourCount{.eta = 1.5, .xi = xi}, senses, watermelon()),
        1 - z);
  }
}

TEST(FixedProbability, AsksForNothing) {
  FakeSenses senses;
  EXPECT_EQ(enabling_probability(FixedProbability{0.25}, senses, watermelon()), 0.25);
  EXPECT_EQ(senses.asked(), 0);
}

TEST(Condition, AsksOnlyForItsSensor) {
  FakeSenses senses;
  enabling_probability(NeighbourCount{.eta = 1, .xi = 1}, senses, watermelon());
  EXPECT_EQ(senses.ground_asked, 0);
  enabling_probability(BlackFloor{1}, senses, watermelon());
  EXPECT_EQ(senses.ground_asked, 1);
  enabling_probability(InvertedNeighbourCount{.eta = 1, .xi = 1}, senses, chocolate());
  EXPECT_EQ(senses.neighbours_asked, 2);
  EXPECT_EQ(senses.asked(), 3) << "neither light, obstacles nor the time";
}

TEST(Condition, IsMadeFromItsModuleAndParameters) {
  for (const Condition& condition :
       {Condition(BlackFloor{0.1}), Condition(GrayFloor{0.2}), Condition(WhiteFloor{0.3}),
        Condition(NeighbourCount{.eta = 1.5, .xi = 3}),
        Condition(InvertedNeighbourCount{.eta = 2.5, .xi = 0}), Condition(FixedProbability{0.4}),
        Condition(ColorDetection{0.5, ColorLabel::Yellow})}) {
    EXPECT_EQ(make_condition(module_of(condition), parameters_of(condition)), condition);
  }
}

TEST(Condition, IsNotMadeFromABehaviourOrTooFewParameters) {
  const std::vector<double> one = {0.5};
  EXPECT_THROW(make_condition(Module::Attraction, one), std::invalid_argument);
  EXPECT_THROW(make_condition(Module::NeighbourCount, one), std::invalid_argument);
}

}  // namespace
}  // namespace swarmsmith
