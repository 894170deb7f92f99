#include <algorithm>
#include <string>

#include "base/math.h"
#include "tests/support/checks.h"
#include "tests/tracking/motion/seen_run.h"
#include "tracking/motion/resampling.h"

namespace swarmsmith {
namespace {

/// A run of 60 s in which one tag was hidden.
TrackedRun with_gap(double from_s, double to_s, bool scored_at_the_end = false) {
  SeenRun seen = seen_run(on_circle, {.cycles = 600});
  seen.hide(2, from_s, to_s);
  seen.options.scored_at_the_end = scored_at_the_end;
  return seen.track().value();
}

auto count_of(const TrackedRun& run, CycleKind kind) {
  return std::ranges::count(run.robots[1].cycles, kind);
}

TEST(GapsTest, UpToHalfASecondAreBridgedWithoutAWord) {
  const TrackedRun run = with_gap(20.02, 20.44);
  EXPECT_EQ(count_of(run, CycleKind::Interpolated), 4);
  EXPECT_EQ(count_of(run, CycleKind::Measured), 596);
  EXPECT_TRUE(run.issues.empty()) << run.issues.front().text;
  EXPECT_NEAR(run.robots[1].longest_gap_s, 20.4667 - 20, 1e-3);
  EXPECT_NEAR(run.robots[1].longest_gap_from_s, 20, 0.04);
}

TEST(GapsTest, UpToASecondAreMarked) {
  const TrackedRun run = with_gap(20.02, 20.82);
  EXPECT_EQ(count_of(run, CycleKind::Degraded), 8);
  ASSERT_EQ(run.issues.size(), 1U);
  EXPECT_EQ(run.issues[0].code, IssueCode::Interpolated);
  EXPECT_EQ(run.issues[0].robot, "rvr2");
}

TEST(GapsTest, LongerOnesAreErrorsAndHoldTheLastPose) {
  const TrackedRun run = with_gap(20.02, 22.02);
  const Issue& issue = issue_of(run, IssueCode::Gap);
  EXPECT_EQ(issue.robot, "rvr2");
  EXPECT_NEAR(issue.from.value(), 20, 0.04);
  EXPECT_NEAR(issue.to.value(), 22.03, 0.04);
  EXPECT_THAT(issue.text, HasSubstr("rvr2 (tag 2) was not seen from 20.00 s to 22.03 s"));
  EXPECT_EQ(count_of(run, CycleKind::Missing), 20);
  EXPECT_EQ(run.issues.size(), 1U);
  // Instants 20.1 s and 22.0 s.
  EXPECT_EQ(run.trajectory.at(200)[1], run.trajectory.at(219)[1]);
  EXPECT_EQ(run.trajectory.at(199)[1], run.trajectory.at(200)[1]);
}

TEST(GapsTest, AroundTheLastInstantTheLimitIsShorter) {
  for (const bool at_the_end : {false, true}) {
    EXPECT_EQ(find_issue(with_gap(59.92, 60.12, at_the_end), IssueCode::Gap) != nullptr,
              at_the_end);
    EXPECT_EQ(find_issue(with_gap(59.92, 60.08, at_the_end), IssueCode::Gap), nullptr);
    // Nothing comes after: not extrapolated.
    EXPECT_EQ(find_issue(with_gap(59.98, 70, at_the_end), IssueCode::Gap) != nullptr, at_the_end);
  }
}

TEST(GapsTest, AtTheEndThePoseIsTheLastKnownOne) {
  const TrackedRun run = with_gap(59.88, 70, true);
  EXPECT_EQ(run.robots[1].cycles.back(), CycleKind::Missing);
  EXPECT_EQ(run.robots[1].cycles[598], CycleKind::Missing);
  const Pose last_seen = on_circle(1, 59.0 + 26.0 / 30);
  EXPECT_NEAR(run.trajectory.at(599)[1].x, last_seen.x, 1e-4);
  EXPECT_NEAR(run.trajectory.at(599)[1].y, last_seen.y, 1e-4);
}

TEST(GapsTest, MoreThanOneInTwentyCyclesBridgedIsAnError) {
  for (const int gaps : {7, 8}) {
    SeenRun seen = seen_run(on_circle, {.cycles = 600});
    for (int i = 0; i < gaps; ++i)  // 4 cycles each
      seen.hide(2, 4 * (i + 1) + 0.02, 4 * (i + 1) + 0.44);
    const TrackedRun run = seen.track().value();
    const Issue* issue = find_issue(run, IssueCode::Gap);
    ASSERT_EQ(issue != nullptr, gaps == 8);
    if (issue == nullptr) continue;
    EXPECT_THAT(issue->text, HasSubstr("32 of 600 cycles (5.3 %, limit 5 %)"));
  }
}

/// What is said of the second robot.
std::string gap_of_the_second(const TrackedRun& run) {
  for (const Issue& issue : run.issues)
    if (issue.code == IssueCode::Gap && issue.robot == "rvr2") return issue.text;
  return "";
}

/// The advice follows from what is missing: frames, or the robot in them.
TEST(GapsTest, SaysWhetherFramesAreMissingOrTheRobotInThem) {
  SeenRun dropped = seen_run(on_circle, {.cycles = 600});
  SeenRun hidden = dropped;
  for (int i = 1; i <= 10; ++i) {  // 4 cycles each
    dropped.cut(4 * i + 0.02, 4 * i + 0.44);
    hidden.hide(2, 4 * i + 0.02, 4 * i + 0.44);
  }
  EXPECT_THAT(gap_of_the_second(dropped.track().value()),
              HasSubstr("was interpolated in 40 of 600 cycles (6.7 %, limit 5 %), in 40 of them "
                        "since frames are missing; a faster disk"));
  EXPECT_THAT(gap_of_the_second(hidden.track().value()),
              HasSubstr("was interpolated in 40 of 600 cycles (6.7 %, limit 5 %), in 0 of them "
                        "since frames are missing; more light"));
}

/// A robot that a person carried: both parts of its track are its own, and nothing lies between.
TEST(GapsTest, NothingIsInterpolatedAcrossAWayThatNoRobotGoes) {
  const Truth carried = [](int robot, double time_s) {
    return on_circle(robot, robot != 1 || time_s < 30 ? time_s : time_s + 5);
  };
  SeenRun seen = seen_run(carried, {.cycles = 600});
  seen.hide(2, 29.82, 30.18);
  const TrackedRun run = seen.track().value();
  EXPECT_THAT(gap_of_the_second(run), HasSubstr("cannot have come"));
  EXPECT_EQ(count_of(run, CycleKind::Missing), 3);
  EXPECT_NEAR(run.trajectory.at(305)[1].x, carried(1, 30.6).x, 1e-4);
}

/// Where a camera sees the middle of a robot's tag.
HandPoint seen_by_a_person(const SeenRun& seen, int robot, double time_s) {
  const View view = seen.rig.view_of(seen.rig.cameras[0]).value();
  const TagOffset offset = seen.rig.offsets.begin()->second.offset;
  const Pose tag = tag_pose_of_robot(on_circle(robot, time_s), offset);
  HandPoint point{.robot = "rvr" + std::to_string(robot + 1), .time_s = time_s, .who = "A. Person"};
  point.middle = image_of(view, Point3{tag.x, tag.y, seen.rig.robots[0].height_m});
  return point;
}

TEST(HandPointTest, BridgesAGapAndIsMarked) {
  SeenRun seen = seen_run(on_circle, {.cycles = 300});
  seen.hide(2, 10, 11.5);
  ASSERT_NE(find_issue(seen.track().value(), IssueCode::Gap), nullptr);
  for (const double time : {10.4, 10.8, 11.2}) {
    seen.options.points.push_back(seen_by_a_person(seen, 1, time));
    seen.options.points.back().heading_deg = on_circle(1, time).theta * 180 / kPi;
  }
  const TrackedRun run = seen.track().value();
  EXPECT_EQ(find_issue(run, IssueCode::Gap), nullptr);
  const Issue& issue = issue_of(run, IssueCode::ByHand);
  EXPECT_THAT(issue.text, HasSubstr("3 times from 10.40 s to 11.20 s (A. Person)"));
  for (int cycle = 101; cycle <= 114; ++cycle) {
    const auto at = static_cast<std::size_t>(cycle - 1);
    EXPECT_EQ(run.robots[1].cycles[at], CycleKind::Interpolated) << cycle;
    const Pose& pose = run.trajectory.at(cycle - 1)[1];
    const Pose truth = on_circle(1, instant_s(cycle));
    EXPECT_NEAR(hypot(pose.x - truth.x, pose.y - truth.y), 0, 0.003) << cycle;
    EXPECT_GT(run.robots[1].sigmas[at].sigma_m, run.robots[0].sigmas[at].sigma_m) << cycle;
  }
  // Others are as they were.
  EXPECT_EQ(run.robots[0].cycles[104], CycleKind::Measured);
}

TEST(HandPointTest, WhereTheTagWasSeenItChangesNothing) {
  SeenRun seen = seen_run(on_circle, {.cycles = 300});
  seen.hide(2, 10, 11.2);
  seen.options.points.push_back(seen_by_a_person(seen, 1, 10.6));
  const TrackedRun before = seen.track().value();
  seen.options.points.push_back(seen_by_a_person(seen, 1, 20.03));
  seen.options.points.back().middle.u += 40;
  seen.options.points.push_back(seen_by_a_person(seen, 2, 9.97));
  const TrackedRun run = seen.track().value();
  for (int cycle = 1; cycle <= 300; ++cycle) {
    for (std::size_t robot = 0; robot < run.robots.size(); ++robot)
      EXPECT_EQ(run.trajectory.at(cycle - 1)[robot], before.trajectory.at(cycle - 1)[robot]);
  }
  EXPECT_THAT(issue_of(run, IssueCode::ByHand).text, HasSubstr("1 time at 10.60 s (A. Person)"));
  std::vector<std::string> odd;
  for (const Issue& issue : run.issues) {
    if (issue.code == IssueCode::FilmOdd) odd.push_back(issue.text);
  }
  ASSERT_EQ(odd.size(), 2U);
  EXPECT_THAT(odd[0], HasSubstr("1 time at 20.03 s (A. Person), although a camera saw its tag"));
  EXPECT_THAT(odd[1], HasSubstr("9.97 s"));
}

TEST(HandPointTest, WithoutAHeadingGoesOnAsItsNeighbours) {
  SeenRun seen = seen_run(on_circle, {.cycles = 300});
  seen.hide(2, 10, 11.2);
  seen.options.points.push_back(seen_by_a_person(seen, 1, 10.6));
  const TrackedRun run = seen.track().value();
  EXPECT_EQ(find_issue(run, IssueCode::Gap), nullptr);
  const Pose& pose = run.trajectory.at(105)[1];
  const Pose truth = on_circle(1, 10.6);
  EXPECT_NEAR(hypot(pose.x - truth.x, pose.y - truth.y), 0, 0.005);
}

}  // namespace
}  // namespace swarmsmith
