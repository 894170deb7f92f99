#include "sim/engine/internal/light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/math.h"
#include "sim/control/flavour.h"
#include "sim/control/readings.h"
#include "sim/engine/fitting.h"
#include "sim/engine/simulate.h"
#include "sim/mission/mission.h"

namespace swarmsmith {
namespace {

/// A square arena with walls 4 m apart.
Arena square() {
  Arena arena;
  const std::vector<Point> corners = {{2, -2}, {2, 2}, {-2, 2}, {-2, -2}};
  for (std::size_t i = 0; i < 4; ++i)
    arena.walls.push_back({corners[i], corners[(i + 1) % 4]});
  return arena;
}

struct Scene {
  Arena arena = square();
  std::vector<Pose> poses = {{0, 0, 0}};

  World world() const { return World(arena, rvr(), poses, ContactModel::Box2d); }
  double front() const { return front_light(world(), arena, 0); }
  std::array<double, kProximitySensors> ring() const {
    std::vector<int> room;
    std::array<double, kProximitySensors> lux{};
    light_ring(world(), arena, 0, room, lux);
    return lux;
  }
  bool occluded(const SpacePoint& sensor, const SpacePoint& light) const {
    return is_occluded(world(), arena.wall_height_m, 0, sensor, light);
  }
};

TEST(FrontLight, IsIntensityByTheSquareOfTheDistanceInSpace) {
  Scene scene;
  EXPECT_EQ(scene.front(), 0);
  scene.arena.lights = {{.x_m = 1.143, .y_m = 0, .z_m = 1.114, .intensity_cd = 500}};
  EXPECT_NEAR(scene.front(), 500 / 2.0, 1e-10) << "1 m ahead, 1 m up";
  // After a quarter turn the sensor is at (0, 0.143).
  scene.poses[0].theta = kPi / 2;
  EXPECT_NEAR(scene.front(), 500 / (1.143 * 1.143 + 0.143 * 0.143 + 1), 1e-10);
  // As sensitive backwards.
  scene.poses[0] = {2.0, 0, kPi};
  EXPECT_NEAR(scene.front(), 500 / (0.714 * 0.714 + 1), 1e-10);
}

TEST(FrontLight, SumsTheLightsAndThenClamps) {
  Scene scene;
  scene.arena.lights = {{.x_m = 1.143, .y_m = 0, .z_m = 0.114, .intensity_cd = 9000},
                        {.x_m = 0.143, .y_m = 2, .z_m = 0.114, .intensity_cd = 8000}};
  EXPECT_NEAR(scene.front(), 9000 + 2000, 1e-9);
  scene.arena.lights[1].intensity_cd = 40'000;
  EXPECT_EQ(scene.front(), 16'000);
  scene.arena.lights = {{.x_m = 0.143, .y_m = 0, .z_m = 0.114, .intensity_cd = 1}};
  EXPECT_EQ(scene.front(), 16'000) << "right at the sensor";
  scene.arena.lights[0].intensity_cd = 0;
  EXPECT_EQ(scene.front(), 0);
}

TEST(FrontLight, AnOccludedLightDoesNotCount) {
  Scene scene;
  scene.arena.lights = {{.x_m = 1.143, .y_m = 0, .z_m = 0.114, .intensity_cd = 100},
                        {.x_m = 0.143, .y_m = 1, .z_m = 0.114, .intensity_cd = 10}};
  scene.arena.obstacles = {{.outline = CircleOutline{0.1}, .pose = {0.6, 0, 0}, .height_m = 0.2}};
  EXPECT_NEAR(scene.front(), 10, 1e-12);
  scene.arena.obstacles[0].height_m = 0.1;
  EXPECT_NEAR(scene.front(), 110, 1e-12) << "over it";
}

TEST(Occlusion, ByAWallEndsAtItsHeight) {
  Scene scene;
  scene.arena.wall_height_m = 0.25;
  // Half way to the light stands the wall at x = 2; the segment is there at (0.125 + z) / 2.
  EXPECT_TRUE(scene.occluded({1, 0, 0.125}, {3, 0, 0.3})) << "through it";
  EXPECT_TRUE(scene.occluded({1, 0, 0.125}, {3, 0, 0.375})) << "touches its edge";
  EXPECT_FALSE(scene.occluded({1, 0, 0.125}, {3, 0, 0.376}));
  EXPECT_FALSE(scene.occluded({1, 0, 0.125}, {1.9, 0, 0})) << "before it";
  EXPECT_TRUE(scene.occluded({1, 0, 0.125}, {2, 0, 0.25})) << "the light sits on it";
  EXPECT_TRUE(scene.occluded({1, 1, 0.125}, {3, 3, 0.125})) << "through the corner";
  EXPECT_TRUE(scene.occluded({2, 1, 0.125}, {2, 3, 5})) << "starts on it, along it";
}

TEST(Occlusion, ByAWallThatIsNotConvexEndsAtItsEnds) {
  Scene scene;
  scene.arena.wall_height_m = 0.5;
  scene.arena.walls.clear();
  // A corner cut out of the square, up and to the right.
  const std::vector<Point> corners = {{2, -2}, {2, 0}, {0, 0}, {0, 2}, {-2, 2}, {-2, -2}};
  for (std::size_t i = 0; i < corners.size(); ++i)
    scene.arena.walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  EXPECT_TRUE(scene.occluded({1, -1, 0.125}, {-0.5, 1, 0.125}));
  EXPECT_TRUE(scene.occluded({1, -1, 0.125}, {-1, 1, 0.125})) << "touches the corner";
  EXPECT_FALSE(scene.occluded({1, -1, 0.125}, {-1.01, 1, 0.125}));
}

TEST(Occlusion, ByASolidEndsAtItsTopAndItsOutline) {
  Scene scene;
  scene.arena.obstacles = {{.outline = BoxOutline{0.5, 0.5}, .pose = {1, 0, 0}, .height_m = 0.25}};
  EXPECT_TRUE(scene.occluded({0, 0, 0.125}, {1.5, 0, 0.125}));
  EXPECT_TRUE(scene.occluded({0, 0.25, 0.125}, {1.5, 0.25, 0.125})) << "along a face";
  EXPECT_FALSE(scene.occluded({0, 0.2501, 0.125}, {1.5, 0.2501, 0.125}));
  EXPECT_TRUE(scene.occluded({0, 0, 0.25}, {1.5, 0, 0.25})) << "along the top";
  EXPECT_FALSE(scene.occluded({0, 0, 0.2501}, {1.5, 0, 0.2501}));
  // Rising from 0.125 to 0.625 over 1.5 m it is at 0.375 over the near face, 0.25 at x = 0.375.
  EXPECT_FALSE(scene.occluded({0, 0, 0.125}, {1.5, 0, 0.625}));
  EXPECT_TRUE(scene.occluded({1.5, 0, 0.625}, {0.75, 0, 0.25})) << "touches the edge";
  EXPECT_TRUE(scene.occluded({1, 0, 0.125}, {1, 0, 2})) << "from inside, straight up";
  EXPECT_FALSE(scene.occluded({0.7, 0, 0.125}, {0.7, 0, 2})) << "beside it, straight up";
}

TEST(Occlusion, ByOtherRobotsAndObjectsButNotByTheOwnBody) {
  Scene scene;
  EXPECT_FALSE(scene.occluded({-0.5, 0, 0.0625}, {0.5, 0, 0.0625}));
  scene.poses.push_back({0, 1, 0});
  EXPECT_TRUE(scene.occluded({-0.5, 1, 0.0625}, {0.5, 1, 0.0625}));
  EXPECT_FALSE(scene.occluded({-0.5, 1, 0.2}, {0.5, 1, 0.2})) << "above its 0.114 m";
  scene.arena.objects = {{.outline = CircleOutline{0.1}, .start = {0, -1, 0}, .height_m = 0.3}};
  EXPECT_TRUE(scene.occluded({-0.5, -1, 0.2}, {0.5, -1, 0.2}));
  EXPECT_FALSE(scene.occluded({-0.5, -1, 0.4}, {0.5, -1, 0.4}));
}

TEST(LightRing, WeighsEachLightByTheCosineToIt) {
  Scene scene;
  scene.poses[0] = {0.5, 0.25, 0.3};
  const Light light = {.x_m = 1.5, .y_m = 1.0, .z_m = 0.75, .intensity_cd = 1000};
  scene.arena.lights = {light};
  const auto ring = scene.ring();
  int dark = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const double angle = 0.3 + kProximityDirections_deg[i] * kPi / 180;
    const double dx = light.x_m - (0.5 + 0.143 * std::cos(angle));
    const double dy = light.y_m - (0.25 + 0.143 * std::sin(angle));
    const double dz = light.z_m - 0.114;
    const double cosine = std::cos(std::atan2(dy, dx) - angle);
    EXPECT_NEAR(ring[i], 1000 / (dx * dx + dy * dy + dz * dz) * std::fmax(0, cosine), 1e-9) << i;
    dark += ring[i] == 0 ? 1 : 0;
  }
  EXPECT_EQ(dark, 4);
}

TEST(LightRing, SumsClampsAndIsOccludedSensorBySensor) {
  Scene scene;
  scene.arena.lights = {{.x_m = 1.143, .y_m = 0, .z_m = 0.114, .intensity_cd = 500},
                        {.x_m = 2.143, .y_m = 0, .z_m = 0.114, .intensity_cd = 400}};
  EXPECT_NEAR(scene.ring()[1], 500 + 100, 1e-9);
  EXPECT_EQ(scene.ring()[5], 0);
  scene.arena.lights[0].intensity_cd = 50'000;
  EXPECT_EQ(scene.ring()[1], 16'000);
  // A post between the front sensor and both lights; the diagonal sensors look past it.
  scene.arena.obstacles = {{.outline = CircleOutline{0.01}, .pose = {0.3, 0, 0}, .height_m = 1}};
  EXPECT_EQ(scene.ring()[1], 0);
  EXPECT_GT(scene.ring()[0], 0);
}

TEST(LightRing, ALightRightAboveASensorGivesItNothing) {
  Scene scene;
  scene.arena.lights = {{.x_m = 0.143, .y_m = 0, .z_m = 1, .intensity_cd = 500}};
  EXPECT_EQ(scene.ring()[1], 0);
}

/// Control software knows where they are, and takes them for no proximity sensors.
TEST(LightRing, OfItsOwnSaysWhereTheLightIs) {
  Scene scene;
  scene.arena.lights = {{.x_m = 0, .y_m = 1.5, .z_m = 0.114, .intensity_cd = 500}};
  Robot robot = rvr();
  robot.light.angles_deg = {0, 90, 180, 270};
  const World world(scene.arena, robot, scene.poses, ContactModel::Box2d);
  std::vector<int> room;
  std::array<double, kProximitySensors> lux{};
  light_ring(world, scene.arena, 0, room, lux);
  const Vector2 light = light_vector(lux, fitted(**find_flavour("chocolate"), robot).light);
  EXPECT_NEAR(atan2(light.y, light.x), kPi / 2, 1e-9);

  Mission mission = built_in_mission("aggregation").value();
  EXPECT_EQ(engine_version_of(mission, {}), kEngineVersion);
  mission.robot = robot;
  EXPECT_EQ(engine_version_of(mission, {}), kLightVersion);
}

}  // namespace
}  // namespace swarmsmith
