#include <cmath>

#include "base/math.h"
#include "sim/mission/polygon.h"
#include "tests/support/checks.h"
#include "tests/tracking/motion/seen_run.h"

namespace swarmsmith {
namespace {

constexpr const char* kBodies = "bodies beside each other";

/// rvr1 and rvr2 stand face to face, and rvr3 against the wall on the x axis, all of 0.2 m a side.
Pose pressed(int robot, double /*time_s*/) {
  if (robot == 2) return {1.2256 - 0.1, 0, 0};
  return {robot == 0 ? -0.1 : 0.1, -0.4, robot == 0 ? 0 : kPi};
}

SeenRun pressed_run(const Outline& body, const Truth& truth = pressed) {
  SeenRun seen = seen_run(truth, {.cycles = 300, .frame_rate = 15, .noise_px = 0.05});
  seen.options.body = body;
  return seen;
}

TEST(BodiesTest, ThatTouchAreNoNews) {
  const TrackedRun run = pressed_run(BoxOutline{0.2, 0.2}).track().value();
  EXPECT_EQ(find_issue(run, IssueCode::BodiesOverlap), nullptr);
  const Check* check = find_check(run, kBodies, "");
  ASSERT_NE(check, nullptr);
  EXPECT_EQ(check->outcome, Check::Outcome::Passed);
  EXPECT_EQ(check->unit, "mm");
  EXPECT_LT(check->value.value(), 6);
}

/// The thesis' robots are rounder than the squares of its simulator.
TEST(BodiesTest, MayHaveRoundCorners) {
  const auto corner_to_corner = [](int robot, double) {
    return robot == 2 ? Pose{0, 0.6, 0} : Pose{robot == 0 ? -0.135 : 0.135, -0.4, kPi / 4};
  };
  const TrackedRun run = pressed_run(BoxOutline{0.286, 0.286}, corner_to_corner).track().value();
  EXPECT_EQ(find_issue(run, IssueCode::BodiesOverlap), nullptr);
  EXPECT_NEAR(find_check(run, kBodies, "")->value.value(), 16, 2);
}

TEST(BodiesTest, AreTooLargeWhenTheyAreInsideEachOtherAllTheTime) {
  struct Row {
    Outline body;
    double depth_mm;
  };
  const std::vector<Row> rows = {{BoxOutline{0.286, 0.286}, 86},
                                 {CircleOutline{0.14}, 80},
                                 {PolygonOutline{regular_polygon(6, 0.14)}, 80}};
  for (const Row& row : rows) {
    const TrackedRun run = pressed_run(row.body).track().value();
    const Issue& issue = issue_of(run, IssueCode::BodiesOverlap);
    EXPECT_THAT(
        issue.text,
        AllOf(HasSubstr("rvr1 and rvr2 were "), HasSubstr("mm inside each other"),
              HasSubstr("for 30.0 s in all, and so was 1 other: "), HasSubstr("mission's robot")))
        << "rvr3 is in the wall";
    EXPECT_DOUBLE_EQ(issue.from.value(), 0.1);
    EXPECT_DOUBLE_EQ(issue.to.value(), 30);
    EXPECT_FALSE(is_error(issue.code));
    const Check* check = find_check(run, kBodies, "");
    ASSERT_NE(check, nullptr);
    EXPECT_EQ(check->outcome, Check::Outcome::Warned);
    EXPECT_NEAR(check->value.value(), row.depth_mm, 2);
    EXPECT_EQ(check->limit, 30.0);
  }
}

TEST(BodiesTest, AreNotInsideWallsAndObstacles) {
  const auto far_apart = [](int robot, double time_s) {
    return robot == 2 ? pressed(2, time_s) : Pose{robot == 0 ? -0.5 : 0.2, -0.4, 0};
  };
  const TrackedRun at_wall = pressed_run(BoxOutline{0.286, 0.286}, far_apart).track().value();
  EXPECT_THAT(issue_of(at_wall, IssueCode::BodiesOverlap).text,
              HasSubstr("rvr3 was 43 mm inside a wall"));
  const auto away = [](int robot, double) { return Pose{0.6 * (robot - 1), 0.5, 0}; };
  SeenRun seen = pressed_run(BoxOutline{0.286, 0.286}, away);
  EXPECT_EQ(find_issue(seen.track().value(), IssueCode::BodiesOverlap), nullptr);
  seen.arena.obstacles = {{.outline = CircleOutline{0.1}, .pose = {0.6, 0.3, 0}}};
  EXPECT_THAT(issue_of(seen.track().value(), IssueCode::BodiesOverlap).text,
              HasSubstr("rvr3 was 43 mm inside an obstacle"));
}

/// A knock, a person's carry, or a wrong sample is another check's.
TEST(BodiesTest, MayComeTooNearForAMoment) {
  const auto knock = [](int robot, double time_s) {
    const double apart = std::fabs(time_s - 10) < 0.4 ? 0.1 : 0.16;
    return Pose{robot == 0 ? -apart : robot == 1 ? apart : 0, robot == 2 ? 0.6 : -0.4, 0};
  };
  const TrackedRun run = pressed_run(BoxOutline{0.286, 0.286}, knock).track().value();
  EXPECT_EQ(find_issue(run, IssueCode::BodiesOverlap), nullptr);
}

TEST(BodiesTest, OfARobotThatWasNotSeenAreNotJudged) {
  SeenRun seen = pressed_run(BoxOutline{0.286, 0.286});
  seen.hide(2, 0.3, 100);
  seen.hide(3, 0.3, 100);
  EXPECT_EQ(find_issue(seen.track().value(), IssueCode::BodiesOverlap), nullptr);
}

}  // namespace
}  // namespace swarmsmith
