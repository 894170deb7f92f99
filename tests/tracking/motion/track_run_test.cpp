#include "tracking/motion/track_run.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "tests/support/checks.h"
#include "tests/tracking/motion/seen_run.h"
#include "tracking/motion/resampling.h"

namespace swarmsmith {
namespace {

Seeing short_run() {
  return {.cycles = 200};
}

int count_of(const TrackedRobot& robot, Sample::Use use) {
  return static_cast<int>(std::ranges::count(robot.samples, use, &Sample::use));
}

TEST(TrackRunTest, FindsTheRobotsBelowTheirTags) {
  const SeenRun seen = seen_run(on_circle, short_run());
  const auto run = value_of(seen.track());
  EXPECT_TRUE(run.issues.empty()) << run.issues.front().text;
  ASSERT_EQ(run.trajectory.instants(), 200);
  ASSERT_EQ(run.starts.size(), 3U);
  // Corners are kept to 1/1000 pixel, 2.5 micrometres at the tag's height; a chord of the circle
  // between frames is 25 micrometres off.
  EXPECT_LT(worst_error(run, on_circle), 5e-5);
  const Pose& last = run.trajectory.at(199)[1];
  EXPECT_NEAR(wrap_angle(last.theta - on_circle(1, 20).theta), 0, 1e-4);
  EXPECT_NEAR(run.starts[2].x, on_circle(2, 0).x, 1e-5);
  for (const TrackedRobot& robot : run.robots) {
    EXPECT_EQ(std::ranges::count(robot.cycles, CycleKind::Measured), 200);
    EXPECT_NEAR(robot.mean_scale, 1, 1e-5);
    EXPECT_LT(robot.mean_residual_m, 1e-5);
    EXPECT_EQ(robot.outliers, 0);
    EXPECT_NEAR(robot.longest_gap_s, 1.0 / 30, 1e-9);
  }
  EXPECT_DOUBLE_EQ(run.covered_s, 20);
  EXPECT_NEAR(run.frame_rate_median, 30, 1e-6);
  EXPECT_EQ(run.frames, 601);
  EXPECT_EQ(run.frames_dropped, 0);
}

TEST(TrackRunTest, DoesNotDependOnTheOrderOfSightings) {
  SeenRun seen = seen_run(on_circle, {.cycles = 100, .noise_px = 0.3});
  const TrackedRun before = seen.track().value();
  std::ranges::reverse(seen.observations.sightings);
  const TrackedRun after = seen.track().value();
  EXPECT_EQ(before.trajectory, after.trajectory);
  EXPECT_EQ(before.issues, after.issues);
}

/// A rig without wrong measurements, which knows it.
void know_all(Rig& rig) {
  rig.survey_error_m = 0;
  rig.tilt_error_rad = 0;
  for (CameraSetup& camera : rig.cameras)
    camera.time_error_s = 0;
  for (RobotSetup& robot : rig.robots)
    robot.height_error_m = 0;
}

TEST(TrackRunTest, EstimatesTheNoiseFromTheScatter) {
  for (const double noise : {0.2, 1.0}) {
    SeenRun seen = seen_run(on_circle, {.cycles = 600, .noise_px = noise});
    know_all(seen.rig);
    TrackOptions options = seen.options;
    options.limits.residual_m = 1;
    const TrackedRun run = track_run(seen.observations, seen.rig, seen.arena, options).value();
    // What the samples are really off by.
    double squares = 0;
    double turn_squares = 0;
    int count = 0;
    for (const Sample& sample : run.robots[0].samples) {
      const Pose is = on_circle(0, sample.time_s);
      squares += (sample.pose.x - is.x) * (sample.pose.x - is.x) +
                 (sample.pose.y - is.y) * (sample.pose.y - is.y);
      const double turn = wrap_angle(sample.pose.theta - is.theta);
      turn_squares += turn * turn;
      ++count;
    }
    EXPECT_NEAR(run.robots[0].sigma.sigma_m / std::sqrt(squares / (2 * count)), 1, 0.15);
    EXPECT_NEAR(run.robots[0].sigma.sigma_rad / std::sqrt(turn_squares / count), 1, 0.15);
  }
}

TEST(TrackRunTest, AddsWhatCalibrationsAreKnownToBeOffBy) {
  SeenRun seen = seen_run(on_circle, short_run());
  know_all(seen.rig);
  seen.rig.offsets.at("rvr1.offset.toml").sigma_y_m = 0.0003;
  seen.rig.places.at("camera0.place.toml").worst_left_out_m = 0.0008;
  const TrackedRun run = seen.track().value();
  EXPECT_NEAR(run.robots[0].sigma.sigma_m, std::sqrt(3e-4 * 3e-4 + 4e-4 * 4e-4 + 1e-8), 1e-6);
  EXPECT_NEAR(run.robots[1].sigma.sigma_m, std::sqrt(4e-4 * 4e-4 + 1e-8), 1e-6);
}

TEST(TrackRunTest, RefusesARobotThatIsNeverSeenEarly) {
  SeenRun seen = seen_run(on_circle, short_run());
  seen.hide(2, -10, 2.1);
  EXPECT_THAT(complaint_of(seen.track()), HasSubstr("E_ROBOT_MISSING: rvr2 (tag 2)"));
}

TEST(TrackRunTest, RefusesARobotWithoutOffset) {
  SeenRun seen = seen_run(on_circle, short_run());
  seen.rig.offsets.erase("rvr3.offset.toml");
  EXPECT_THAT(complaint_of(seen.track()), HasSubstr("E_NO_OFFSET: rvr3"));
  seen.options.takes_tags_for_centres = true;
  const TrackedRun run = seen.track().value();
  EXPECT_EQ(issue_of(run, IssueCode::TagAsCentre).robot, "rvr3");
  const Pose is = tag_pose_of_robot(on_circle(2, 0.1), {0.06, -0.04, 0});
  EXPECT_NEAR(std::hypot(run.trajectory.at(0)[2].x - on_circle(2, 0.1).x,
                         run.trajectory.at(0)[2].y - on_circle(2, 0.1).y),
              std::hypot(is.x - on_circle(2, 0.1).x, is.y - on_circle(2, 0.1).y), 1e-4);
}

TEST(TrackRunTest, RefusesAnOffsetOfAnotherTag) {
  SeenRun seen = seen_run(on_circle, short_run());
  seen.rig.offsets.at("rvr1.offset.toml").tag = 17;
  EXPECT_THAT(complaint_of(seen.track()), HasSubstr("of tag 17"));
}

/// Limits: the RVR's radius, and how far another body reaches.
TEST(TrackRunTest, RefusesATagOutsideOfTheBody) {
  SeenRun seen = seen_run(on_circle, short_run());
  seen.rig.offsets.at("rvr1.offset.toml").offset = {0.109, -0.08, 0};
  EXPECT_THAT(complaint_of(seen.track()),
              HasSubstr("E_SPIN_QUALITY: the tag of rvr1 would sit 135.2 mm from its centre, but a "
                        "robot of this mission reaches 135.0 mm"));
  seen.options.body = BoxOutline{0.25, 0.1};
  EXPECT_THAT(complaint_of(seen.track()), HasSubstr("reaches 134.6 mm"));
  seen.options.body = PolygonOutline{{{0.136, 0}, {-0.1, 0.1}, {-0.1, -0.1}}};
  EXPECT_TRUE(seen.track());
  seen.options.body = CircleOutline{0.136};
  EXPECT_TRUE(seen.track());
}

TEST(TrackRunTest, RefusesCalibrationsOfAnotherSizeOrNone) {
  SeenRun seen = seen_run(on_circle, short_run());
  seen.rig.models.at("camera0.camera.toml").model.size = {1280, 720};
  EXPECT_THAT(
      seen.track().error().message,
      HasSubstr(
          "E_CALIB_SIZE: calibration 1280x720, video 1920x1080; film at the picture size of"));
  seen.rig.models.clear();
  EXPECT_THAT(seen.track().error().message, HasSubstr("`camera0.camera.toml`"));
}

TEST(TrackRunTest, SaysWhenATagIsOfAnotherSizeThanDeclared) {
  SeenRun seen = seen_run(on_circle, short_run());
  seen.rig.robots[1].edge_m = 0.108;
  const TrackedRun run = seen.track().value();
  const Issue& issue = issue_of(run, IssueCode::TagSize);
  EXPECT_EQ(issue.robot, "rvr2");
  EXPECT_THAT(issue.text, HasSubstr("measures 0.1000 m along its edge, declared are 0.1080 m"));
  EXPECT_NEAR(run.robots[1].mean_scale, 0.1 / 0.108, 1e-4);
  EXPECT_LT(worst_error(run, on_circle), 1e-4);
}

/// The thesis' error (tracking facts, section 5), and that the scale gives it away.
TEST(TrackRunTest, WithoutTheHeightRobotsSeemFurtherOut) {
  SeenRun seen = seen_run(on_circle, short_run());
  seen.options.corrects_height = false;
  const TrackedRun run = seen.track().value();
  const Pose tag = tag_pose_of_robot(on_circle(0, 10), {0.06, -0.04, 0.3});
  EXPECT_NEAR(worst_error(run, on_circle), 0.08 * std::hypot(tag.x, tag.y), 0.01);
  EXPECT_NE(find_issue(run, IssueCode::TagSize), nullptr);
}

TEST(TrackRunTest, DropsSingleBadFits) {
  SeenRun seen = seen_run(on_circle, short_run());
  for (Sighting& sighting : seen.observations.sightings) {
    if (sighting.tag == 1 && sighting.frame % 40 == 7) sighting.corners[2].u += 8;
  }
  const TrackedRun run = seen.track().value();
  EXPECT_GT(count_of(run.robots[0], Sample::Use::BadFit), 10);
  EXPECT_LT(worst_error(run, on_circle), 5e-4);
  ASSERT_NE(find_issue(run, IssueCode::Outliers), nullptr);
  EXPECT_EQ(run.issues.size(), 1U);
}

/// Moves a tag in the image by whole pixels.
void shift(Sighting& sighting, double pixels) {
  for (ImagePoint& corner : sighting.corners)
    corner.u += pixels;
}

TEST(TrackRunTest, DropsOutliersThatARobotCannotReach) {
  SeenRun seen = seen_run(on_circle, short_run());
  for (Sighting& sighting : seen.observations.sightings) {
    // The first frame of all is a stray, too: what comes first is not right for that.
    if (sighting.tag == 3 && sighting.frame % 50 == 0) shift(sighting, 60);
  }
  const TrackedRun run = seen.track().value();
  EXPECT_EQ(run.robots[2].outliers, 13);
  EXPECT_LT(worst_error(run, on_circle), 5e-4);
}

TEST(TrackRunTest, DropsJumpsThatAreSlowEnoughAtALowRate) {
  const Truth slow = [](int robot, double time_s) { return on_circle(robot, 0.1 * time_s); };
  SeenRun seen = seen_run(slow, {.cycles = 200, .frame_rate = 10});
  for (Sighting& sighting : seen.observations.sightings) {
    // 64 mm in 100 ms are below the speed limit.
    if (sighting.tag == 1 && sighting.frame % 30 == 7) shift(sighting, 26);
  }
  const TrackedRun run = seen.track().value();
  EXPECT_EQ(run.robots[0].outliers, 7);
}

TEST(TrackRunTest, DropsHeadingsThatARobotCannotTurnTo) {
  SeenRun seen = seen_run(on_circle, short_run());
  for (Sighting& sighting : seen.observations.sightings) {
    if (sighting.tag == 1 && sighting.frame == 100) {
      std::rotate(sighting.corners.begin(), sighting.corners.begin() + 1, sighting.corners.end());
    }
  }
  const TrackedRun run = seen.track().value();
  EXPECT_EQ(run.robots[0].outliers, 1);
}

/// Another tag of the same number at a place of its own.
void add_twin(SeenRun& seen, int tag, const Pose& at, std::int64_t from, std::int64_t to,
              double height_m = 0.2) {
  const View view = seen.rig.view_of(seen.rig.cameras[0]).value();
  std::vector<Sighting> twins;
  for (const Sighting& sighting : seen.observations.sightings) {
    if (sighting.tag != tag || sighting.frame < from || sighting.frame > to) continue;
    twins.push_back(sighting);
    twins.back().corners = seen_corners(view, at, 0.1, height_m);
  }
  seen.observations.sightings.insert(seen.observations.sightings.end(), twins.begin(), twins.end());
}

TEST(TrackRunTest, KeepsTheOneOfTwoThatFitsToTheTrack) {
  SeenRun seen = seen_run(on_circle, short_run());
  add_twin(seen, 1, {-0.9, 0.1, 0}, 200, 204);
  const TrackedRun run = seen.track().value();
  EXPECT_EQ(count_of(run.robots[0], Sample::Use::Duplicate), 5);
  EXPECT_EQ(find_issue(run, IssueCode::DuplicateId), nullptr);
  EXPECT_LT(worst_error(run, on_circle), 5e-5);
}

/// 15 mm apart, either may be the robot: neither is used, and the gap is bridged.
TEST(TrackRunTest, DropsBothOfTwoThatMayBothBeTheRobot) {
  SeenRun seen = seen_run(on_circle, short_run());
  Pose near = tag_pose_of_robot(on_circle(0, 200.0 / 30 - 0.5), {0.06, -0.04, 0.3});
  near.x += 0.015;
  add_twin(seen, 1, near, 200, 200);
  const TrackedRun run = seen.track().value();
  EXPECT_EQ(count_of(run.robots[0], Sample::Use::Duplicate), 2);
  EXPECT_LT(worst_error(run, on_circle), 3e-4);
}

TEST(TrackRunTest, ComplainsOfATwinOnTheFloorThoughItsScaleTellsItFromTheRobot) {
  SeenRun seen = seen_run(on_circle, short_run());
  add_twin(seen, 1, {-0.9, 0.1, 0}, 200, 230, 0);
  const TrackedRun run = seen.track().value();
  EXPECT_NE(find_issue(run, IssueCode::DuplicateId), nullptr);
  EXPECT_LT(worst_error(run, on_circle), 5e-5);
}

/// The offset of each is then wrong on the other robot, and so is the score. After four frames the
/// other's place is within reach again.
TEST(TrackRunTest, TwoRobotsThatExchangeTheirTagsAreNoLongerBelieved) {
  const Truth side_by_side = [](int robot, double time_s) {
    return Pose{-0.5 + 0.25 * robot + 0.001 * time_s, 0.1, 0};
  };
  SeenRun seen = seen_run(side_by_side, {.cycles = 200, .frame_rate = 15});
  for (Sighting& sighting : seen.observations.sightings) {
    if (sighting.frame >= 100 && sighting.tag <= 2) sighting.tag = 3 - sighting.tag;
  }
  const TrackedRun run = seen.track().value();
  const Issue& issue = issue_of(run, IssueCode::Gap);
  EXPECT_THAT(issue.text, HasSubstr("cannot have come"));
}

TEST(TrackRunTest, ComplainsOfATwinThatStays) {
  SeenRun seen = seen_run(on_circle, short_run());
  add_twin(seen, 1, {-0.9, 0.1, 0}, 200, 400);
  const TrackedRun run = seen.track().value();
  const Issue& issue = issue_of(run, IssueCode::DuplicateId);
  EXPECT_THAT(issue.text, HasSubstr("twice in 201 frames, from frame 200 to frame 400"));
  EXPECT_LT(worst_error(run, on_circle), 5e-5);
}

TEST(TrackRunTest, RefusesWhenItCannotTellTwinsFromTheStart) {
  SeenRun seen = seen_run(on_circle, short_run());
  add_twin(seen, 1, {-0.9, 0.1, 0}, 0, 100000);
  EXPECT_THAT(complaint_of(seen.track()), HasSubstr("E_DUPLICATE_ID: rvr1"));
}

TEST(TrackRunTest, ListsTagsThatAreNotDeclared) {
  SeenRun seen = seen_run(on_circle, short_run());
  seen.rig.references.push_back({.tag = 100});
  seen.options.other_tags = {99};
  const Sighting like = seen.observations.sightings[60];
  for (const int tag : {99, 100, 44, 7, 44}) {
    seen.observations.sightings.push_back(like);
    seen.observations.sightings.back().tag = tag;
  }
  const TrackedRun run = seen.track().value();
  ASSERT_EQ(run.issues.size(), 1U);
  EXPECT_EQ(run.issues[0].code, IssueCode::UnknownTags);
  EXPECT_THAT(run.issues[0].text, HasSubstr("7 (1 time), 44 (2 times)"));
}

TEST(TrackRunTest, SaysWhenARobotLeftTheArena) {
  const Truth leaving = [](int robot, double time_s) {
    if (robot != 1) return on_circle(robot, time_s);
    return Pose{0.3 + 0.1 * time_s, 0.2, 0};  // beyond 1.226 + 0.15 m from 10.76 s on
  };
  const SeenRun seen = seen_run(leaving, short_run());
  const TrackedRun run = seen.track().value();
  const Issue& issue = issue_of(run, IssueCode::OutsideArena);
  EXPECT_EQ(issue.robot, "rvr2");
  EXPECT_NEAR(issue.from.value(), 10.76, 0.2);
  EXPECT_NE(find_issue(run, IssueCode::Gap), nullptr);
}

/// Two samples beyond the walls are a misread tag, three in a row a robot.
TEST(TrackRunTest, SaysThatARobotLeftFromThreeSamplesInARowOn) {
  const SeenRun inside = seen_run(on_circle, short_run());
  for (const int outside : {2, 3}) {
    SeenRun seen = inside;
    const View view = seen.rig.view_of(seen.rig.cameras[0]).value();
    const double start = seen.options.span.starts_s.front();
    int moved = 0;
    for (Sighting& sighting : seen.observations.sightings) {
      if (sighting.tag != 2 || sighting.time_s - start < 5 || moved == outside) continue;
      sighting.corners = seen_corners(view, {1.6, 0, 0}, 0.1, 0.2);
      ++moved;
    }
    const TrackedRun run = seen.track().value();
    EXPECT_EQ(find_issue(run, IssueCode::OutsideArena) != nullptr, outside == 3) << outside;
    EXPECT_EQ(find_check(run, "samples in a row outside of the walls", "rvr2")->value, outside);
  }
}

}  // namespace
}  // namespace swarmsmith
