#include <gmock/gmock.h>

#include <cmath>

#include "sim/mission/trajectory.h"
#include "tests/support/film/scene.h"
#include "tracking/overlay/draw_overlay.h"

namespace swarmsmith {
namespace {

Mission mission_named(const std::string& name) {
  Mission mission = built_in_mission(name).value();
  mission.cycles = 20;
  return mission;
}

/// Two robots, 20 cycles: one drives along x at 0.2 m/s, the other stands beside the arena's
/// middle.
TrackedRun two_robots() {
  TrackedRun run;
  run.starts = {{-0.2, 0, 0}, {0.9, 0.3, 1}};
  run.trajectory.robots = 2;
  for (int cycle = 1; cycle <= 20; ++cycle) {
    run.trajectory.poses.push_back({-0.2 + 0.02 * cycle, 0, 0});
    run.trajectory.poses.push_back({0.9, 0.3, 1});
  }
  for (const char* name : {"rvr1", "rvr2"}) {
    TrackedRobot robot;
    robot.name = name;
    robot.cycles.assign(20, CycleKind::Measured);
    run.robots.push_back(robot);
  }
  run.robots[1].cycles[9] = CycleKind::Degraded;
  return run;
}

Rig rig_of_two() {
  Rig rig;
  rig.robots = {{"rvr1", 1, 0.1, 0.2, {}}, {"rvr2", 2, 0.1, 0.3, {}}};
  return rig;
}

OverlayRun overlay_of(const std::string& mission, std::vector<Issue> issues = {}) {
  return {two_robots(), rig_of_two(), mission_named(mission), std::move(issues)};
}

TEST(OverlayRunTest, RobotsAreBetweenTheirCycles) {
  const OverlayRun run = overlay_of("aggregation");
  EXPECT_DOUBLE_EQ(run.duration_s(), 2);
  const OverlayMoment moment = run.at(0.55);
  ASSERT_EQ(moment.robots.size(), 2U);
  EXPECT_EQ(moment.robots[0].name, "rvr1");
  EXPECT_NEAR(moment.robots[0].pose.x, -0.2 + 0.2 * 0.55, 1e-12);
  EXPECT_EQ(moment.robots[1].height_m, 0.3);
  // The start, five cycles, and now.
  ASSERT_EQ(moment.robots[0].trail.size(), 7U);
  EXPECT_EQ(moment.robots[0].trail.front().x, -0.2);
  EXPECT_NEAR(moment.robots[0].trail.back().x, -0.09, 1e-12);
}

TEST(OverlayRunTest, AGapIsWhereTheCycleSaysIt) {
  const OverlayRun run = overlay_of("aggregation");
  EXPECT_EQ(run.at(0.85).robots[1].kind, CycleKind::Measured);
  EXPECT_EQ(run.at(0.95).robots[1].kind, CycleKind::Degraded);
  EXPECT_EQ(run.at(1.0).robots[1].kind, CycleKind::Degraded);
  EXPECT_EQ(run.at(1.05).robots[1].kind, CycleKind::Measured);
}

TEST(OverlayRunTest, TheScoreIsThatOfTheCyclesBefore) {
  const OverlayRun spot = overlay_of("aggregation");
  EXPECT_FALSE(spot.at(0.05).score.has_value());
  EXPECT_EQ(spot.at(0.1).score, 1);
  const OverlayRun grid = overlay_of("grid_exploration");
  Mission mission = mission_named("grid_exploration");
  const TrackedRun run = two_robots();
  const Instance instance = instance_of(mission, 1).value();
  EXPECT_EQ(grid.at(2).score, score_of(mission, instance, run.trajectory));
  EXPECT_EQ(grid.at(9).score, grid.at(2).score);
  EXPECT_LT(*grid.at(2).score, 0);
}

/// Their sum over all cycles is the score itself.
TEST(OverlayRunTest, TilesAreAsOldAsTheScoreSees) {
  const OverlayRun grid = overlay_of("grid_exploration");
  double sum = 0;
  for (int cycle = 1; cycle <= 20; ++cycle) {
    const OverlayMoment moment = grid.at(0.1 * cycle);
    ASSERT_EQ(moment.tile_ages_s.size(), 100U);
    for (const double age_s : moment.tile_ages_s)
      sum += age_s / 0.1;
  }
  EXPECT_NEAR(-sum / 100, *grid.at(2).score, 1e-9);
  EXPECT_TRUE(overlay_of("aggregation").at(1).tile_ages_s.empty());
}

TEST(OverlayRunTest, BeforeTheRunThereAreNoRobots) {
  const OverlayMoment moment = overlay_of("aggregation").at(-1);
  EXPECT_TRUE(moment.robots.empty());
  EXPECT_FALSE(moment.score.has_value());
  EXPECT_EQ(overlay_of("aggregation").at(7).robots.size(), 2U);
}

TEST(OverlayRunTest, IssuesAreShownWhileTheyLast) {
  const OverlayRun run =
      overlay_of("aggregation", {{IssueCode::Gap, "not seen for 0.7 s", "rvr2", 0.3, 1.5},
                                 {IssueCode::UnknownTags, "33", {}, {}, {}}});
  EXPECT_TRUE(run.at(0.2).issues.empty());
  EXPECT_EQ(run.at(0.4).issues, std::vector<std::string>{"E_GAP rvr2: not seen for 0.7 s"});
  EXPECT_EQ(run.at(1.4).issues.size(), 1U);
  EXPECT_TRUE(run.at(1.6).issues.empty());
}

constexpr ImageSize kSize{960, 540};

View view_from_above() {
  return {{kSize, Lens::Pinhole, 507, 507, 479.5, 269.5, {-0.285, 0.08, 0.0005, -0.0003, 0}},
          film::looking_at({0.12, -0.08, 2.7}, {0, 0})};
}

ColorImage grey_picture() {
  return {kSize.width, kSize.height,
          std::vector<std::uint8_t>(static_cast<std::size_t>(3 * kSize.width * kSize.height), 100)};
}

Rgb pixel(const ColorImage& image, const ImagePoint& at) {
  const auto i =
      static_cast<std::size_t>(3 * (std::lround(at.v) * image.width + std::lround(at.u)));
  return {image.bgr[i + 2], image.bgr[i + 1], image.bgr[i]};
}

/// Of the nine pixels about a place; lines are about a pixel wide.
int brightest(const ColorImage& image, const ImagePoint& at) {
  int most = 0;
  for (const int du : {-1, 0, 1})
    for (const int dv : {-1, 0, 1})
      most = std::max<int>(most, pixel(image, {at.u + du, at.v + dv}).g);
  return most;
}

bool is_changed(const ColorImage& image, const ImagePoint& at) {
  return pixel(image, at) != Rgb{100, 100, 100};
}

/// Along each wall, not only at its corners: the lens bends it.
TEST(DrawOverlayTest, WallsLieWhereTheLensSeesThem) {
  const Mission mission = mission_named("aggregation");
  const View view = view_from_above();
  ColorImage image = grey_picture();
  draw_floor(image, view, mission, {});
  for (const Wall& wall : mission.arena.walls)
    for (const double share : {0.0, 0.3, 0.5, 0.8}) {
      const ImagePoint at =
          image_of(view, Point3{wall.from.x + share * (wall.to.x - wall.from.x),
                                wall.from.y + share * (wall.to.y - wall.from.y), 0});
      EXPECT_GT(brightest(image, at), 180) << wall.from.x << " " << share;
    }
  EXPECT_FALSE(is_changed(image, image_of(view, Point3{0.9, 0, 0})));
}

TEST(DrawOverlayTest, ObstaclesAreOutlinedWhereTheyStand) {
  Mission mission = mission_named("aggregation");
  mission.arena.obstacles = {{BoxOutline{0.4, 0.2}, {0.2, -0.5, 0.5}}};
  const View view = view_from_above();
  ColorImage image = grey_picture();
  draw_floor(image, view, mission, {});
  // The middles of the front and of the left side, and the centre, where nothing is drawn.
  const double c = std::cos(0.5);
  const double s = std::sin(0.5);
  EXPECT_GT(brightest(image, image_of(view, Point3{0.2 + 0.2 * c, -0.5 + 0.2 * s, 0})), 180);
  EXPECT_GT(brightest(image, image_of(view, Point3{0.2 - 0.1 * s, -0.5 + 0.1 * c, 0})), 180);
  EXPECT_FALSE(is_changed(image, image_of(view, Point3{0.2, -0.5, 0})));
}

TEST(DrawOverlayTest, ARobotWithoutMeasurementsIsHollow) {
  const View view = view_from_above();
  OverlayRobot robot;
  robot.name = "rvr1";
  robot.pose = {0.3, -0.2, 0.5};
  robot.height_m = 0.2;
  const Outline body = BoxOutline{0.286, 0.286};
  // Behind its middle, where no line runs.
  const ImagePoint inside =
      image_of(view, Point3{0.3 - 0.09 * std::cos(0.5) - 0.05 * std::sin(0.5),
                            -0.2 - 0.09 * std::sin(0.5) + 0.05 * std::cos(0.5), 0.2});
  ColorImage measured = grey_picture();
  draw_robots(measured, view, body, {robot});
  EXPECT_TRUE(is_changed(measured, inside));
  // The body is drawn at the tag's height; its centre on the floor is marked apart.
  EXPECT_GT(pixel(measured, image_of(view, Point3{0.3, -0.2, 0})).b, 200);
  robot.kind = CycleKind::Degraded;
  ColorImage gap = grey_picture();
  draw_robots(gap, view, body, {robot});
  EXPECT_FALSE(is_changed(gap, inside));
  EXPECT_TRUE(
      is_changed(gap, image_of(view, Point3{0.3 + 0.143 * (std::cos(0.5) - std::sin(0.5)),
                                            -0.2 + 0.143 * (std::sin(0.5) + std::cos(0.5)), 0.2})));
}

TEST(DrawOverlayTest, SamePictureSameBytesAndNothingBeyondTheEdge) {
  const View view = view_from_above();
  const OverlayRun run = overlay_of("grid_exploration");
  std::vector<OverlayTag> tags{{7, {{{-20, 10}, {5, 10}, {5, -15}, {-20, -15}}}},
                               {8, {{{950, 530}, {990, 530}, {990, 560}, {950, 560}}}}};
  ColorImage first = grey_picture();
  ColorImage second = grey_picture();
  draw_overlay(first, view, run.mission(), run.at(1.23), tags);
  draw_overlay(second, view, run.mission(), run.at(1.23), tags);
  EXPECT_EQ(first.bgr, second.bgr);
  // A camera that looks elsewhere: everything is outside.
  View away = view;
  away.camera.cx = -4000;
  ColorImage aside = grey_picture();
  draw_floor(aside, away, run.mission(), run.at(1.23).tile_ages_s);
  EXPECT_EQ(aside.bgr, grey_picture().bgr);
}

}  // namespace
}  // namespace swarmsmith
