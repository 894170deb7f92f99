#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/rng.h"
#include "tests/support/checks.h"
#include "tests/tracking/motion/seen_run.h"
#include "tracking/motion/resampling.h"

namespace swarmsmith {
namespace {

constexpr std::string_view kAgreement = "tags of one robot agree";
constexpr Seeing kFirst{.cycles = 300, .noise_px = 0.2, .seed = 1};
/// Lower, smaller, behind, and turned.
constexpr Seeing kSecond{.cycles = 300,
                         .noise_px = 0.2,
                         .seed = 2,
                         .offset = {0.05, 0.09, -1.2},
                         .height_m = 0.15,
                         .edge_m = 0.08};
constexpr int kMore = 20;

/// Where a second tag truly sits at a time of the run.
using Mounted = std::function<TagOffset(double time_s)>;

/// Each robot carries tag i + 1 and tag i + 21.
SeenRun two_tags(const Mounted& mounted = [](double) { return kSecond.offset; }) {
  SeenRun run = seen_run(on_circle, kFirst);
  const View view = run.rig.view_of(run.rig.cameras.front()).value();
  const std::vector<double> times = run.observations.cameras.front().frame_times;
  Rng rng(kSecond.seed);
  for (RobotSetup& robot : run.rig.robots) {
    RobotSetup more{robot.name, robot.tag + kMore, kSecond.edge_m, kSecond.height_m,
                    robot.offset_file};
    robot.more_tags = {more};
    OffsetCalibration& calibration = run.rig.offsets[robot.offset_file];
    OffsetCalibration second = calibration;
    second.tag = more.tag;
    second.offset = kSecond.offset;
    calibration.more_tags = {second};
    for (std::size_t frame = 0; frame < times.size(); ++frame) {
      const double time = times[frame] - kFirst.clock_s;
      Sighting seen{.frame = static_cast<std::int64_t>(frame),
                    .time_s = times[frame],
                    .tag = more.tag,
                    .margin = 60};
      const Pose tag = tag_pose_of_robot(on_circle(robot.tag - 1, time), mounted(time));
      seen.corners = seen_corners(view, tag, more.edge_m, more.height_m);
      for (ImagePoint& corner : seen.corners) {
        corner.u += kSecond.noise_px * rng.normal();
        corner.v += kSecond.noise_px * rng.normal();
      }
      run.observations.sightings.push_back(seen);
    }
  }
  return run;
}

TEST(SeveralTagsTest, TogetherAreBetterThanOne) {
  const double alone = rms_error(seen_run(on_circle, kFirst).track().value());
  SeenRun seen = two_tags();
  const TrackedRun run = seen.track().value();
  for (int tag = 1; tag <= 3; ++tag)
    seen.hide(tag, -10, 100);
  EXPECT_TRUE(run.issues.empty()) << run.issues.front().text;
  EXPECT_LT(rms_error(run), alone);
  EXPECT_LT(rms_error(run), 0.8 * rms_error(seen.track().value()));
  ASSERT_NE(find_check(run, kAgreement, "rvr3"), nullptr);
  EXPECT_EQ(find_check(run, kAgreement, "rvr3")->outcome, Check::Outcome::Passed);
  EXPECT_EQ(find_check(seen_run(on_circle, kFirst).track().value(), kAgreement, "rvr3"), nullptr);
}

TEST(SeveralTagsTest, HiddenTagLosesNothing) {
  SeenRun seen = two_tags();
  seen.hide(1, 5, 12);  // the other one is seen
  seen.hide(21, 20, 23);
  const TrackedRun run = seen.track().value();
  EXPECT_TRUE(run.issues.empty()) << run.issues.front().text;
  EXPECT_EQ(std::ranges::count(run.robots[0].cycles, CycleKind::Measured), 300);
  EXPECT_LT(rms_error(run), 0.002);
  // Both at once is a gap as ever.
  seen.hide(21, 8, 10);
  const TrackedRun gap = seen.track().value();
  EXPECT_THAT(issue_of(gap, IssueCode::Gap).text, HasSubstr("rvr1 (tags 1, 21) was not seen"));
}

TEST(SeveralTagsTest, OneThatIsNeverSeenTakesNothingAndIsSaid) {
  SeenRun seen = two_tags();
  for (int tag = 21; tag <= 23; ++tag)
    seen.hide(tag, -10, 100);
  const TrackedRun run = seen.track().value();
  EXPECT_EQ(run.trajectory, seen_run(on_circle, kFirst).track()->trajectory);
  ASSERT_EQ(run.issues.size(), 3U);
  EXPECT_EQ(run.issues.front().code, IssueCode::FilmOdd);
  EXPECT_THAT(run.issues.front().text, HasSubstr("rvr1 carries tag 21, too, which was never seen"));
  EXPECT_EQ(find_check(run, kAgreement, "rvr1")->outcome, Check::Outcome::NotRun);
}

TEST(SeveralTagsTest, LooseTagIsNamed) {
  const auto slips = [](double by_m) {
    return [by_m](double time_s) {
      TagOffset offset = kSecond.offset;
      if (time_s > 10) offset.x_m += by_m;
      return offset;
    };
  };
  for (const double by_m : {0.02, -0.012}) {
    const TrackedRun run = two_tags(slips(by_m)).track().value();
    const Issue& issue = issue_of(run, IssueCode::TagsDisagree);
    EXPECT_EQ(issue.robot, "rvr1");
    EXPECT_THAT(issue.text, HasSubstr("rvr1 has tags 1 and 21"));
    EXPECT_NEAR(issue.from.value(), 10, 0.6);
    EXPECT_NEAR(issue.to.value(), 30.5, 0.5);
    EXPECT_EQ(find_check(run, kAgreement, "rvr1")->outcome, Check::Outcome::Failed);
  }
  EXPECT_EQ(find_issue(two_tags(slips(0.002)).track().value(), IssueCode::TagsDisagree), nullptr);
}

TEST(SeveralTagsTest, ShortSlipIsSeen) {
  const auto slips = [](double time_s) {
    TagOffset offset = kSecond.offset;
    if (time_s > 14 && time_s < 15) offset.y_m += 0.02;
    return offset;
  };
  const TrackedRun run = two_tags(slips).track().value();
  EXPECT_NE(find_issue(run, IssueCode::TagsDisagree), nullptr);
}

TEST(SeveralTagsTest, TurnedTagIsNamed) {
  // About the robot's own centre: its place stays right, its heading does not.
  const auto turned = [](double) {
    TagOffset offset = kSecond.offset;
    offset.yaw_rad += 8 * kPi / 180;
    return offset;
  };
  const TrackedRun run = two_tags(turned).track().value();
  EXPECT_THAT(issue_of(run, IssueCode::TagsDisagree).text, HasSubstr("mm) and 8."));
}

TEST(SeveralTagsTest, NeverTogetherIsDoubtful) {
  SeenRun seen = two_tags();
  seen.hide(1, 15, 100);
  seen.hide(21, -10, 15);
  const TrackedRun run = seen.track().value();
  EXPECT_EQ(issue_of(run, IssueCode::TagPlaceDoubtful).robot, "rvr1");
  EXPECT_EQ(std::ranges::count(run.robots[0].cycles, CycleKind::Measured), 300);
}

TEST(SeveralTagsTest, NeedTheirCalibrations) {
  SeenRun seen = two_tags();
  seen.rig.offsets["rvr2.offset.toml"].more_tags.front().has_yaw = false;
  const auto turned = seen.track();
  ASSERT_FALSE(turned.has_value());
  EXPECT_THAT(turned.error().message,
              HasSubstr("E_NO_OFFSET: rvr2 has tags 2, 22, and no straight"));
  seen.rig.offsets["rvr2.offset.toml"].more_tags.clear();
  seen.options.takes_tags_for_centres = true;
  const auto without = seen.track();
  ASSERT_FALSE(without.has_value());
  EXPECT_THAT(without.error().message, HasSubstr("E_NO_OFFSET"));
}

}  // namespace
}  // namespace swarmsmith
