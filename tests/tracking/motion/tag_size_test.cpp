#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "tests/support/checks.h"
#include "tests/tracking/motion/seen_run.h"
#include "tracking/motion/track_run.h"

namespace swarmsmith {
namespace {

constexpr double kDegree = kPi / 180;

Seeing usual() {
  return {.cycles = 200, .frame_rate = 15, .noise_px = 0.1};
}

void lower_heights(SeenRun& seen, double by_m) {
  for (RobotSetup& robot : seen.rig.robots)
    robot.height_m -= by_m;
}

TEST(TagSizeTest, AllHeightsTenCentimetresTooLowAreRefusedWithBothPossibilities) {
  SeenRun seen = seen_run(on_circle, usual());
  lower_heights(seen, 0.1);
  const TrackedRun run = seen.track().value();
  const Issue& issue = issue_of(run, IssueCode::TagSize);
  EXPECT_EQ(std::ranges::count(run.issues, IssueCode::TagSize, &Issue::code), 3);
  EXPECT_THAT(issue.text, HasSubstr("either its `height` is 0.200 m and not 0.100 m"));
  EXPECT_THAT(issue.text, HasSubstr("or its `edge` is 0.1040 m"));
  EXPECT_THAT(issue.text, HasSubstr("all robots are off alike"));
  EXPECT_EQ(find_check(run, "size of the tag", "rvr1")->outcome, Check::Outcome::Failed);
}

TEST(TagSizeTest, AHeightThatIsThreeCentimetresOffIsDoubtfulAndMakesBordersWide) {
  SeenRun seen = seen_run(on_circle, usual());
  seen.rig.robots[1].height_m -= 0.04;
  const TrackedRun run = seen.track().value();
  EXPECT_EQ(issue_of(run, IssueCode::TagSizeDoubtful).robot, "rvr2");
  EXPECT_THAT(find_issue(run, IssueCode::TagSizeDoubtful)->text, HasSubstr("on this robot"));
  EXPECT_EQ(run.issues.size(), 1U);
  // Half a metre from the point below the camera, 1.6 %.
  EXPECT_GT(run.robots[1].sigmas.back().sigma_m, 0.006);
  EXPECT_LT(run.robots[0].sigmas.back().sigma_m, 0.004);
}

TEST(TagSizeTest, WhatCannotBeMeasuredBetterIsNone) {
  SeenRun seen = seen_run(on_circle, usual());
  lower_heights(seen, 0.01);
  seen.rig.robots[0].edge_m *= 1.004;
  const TrackedRun run = seen.track().value();
  EXPECT_TRUE(run.issues.empty()) << run.issues.front().text;
  EXPECT_EQ(find_check(run, "size of the tag", "rvr1")->outcome, Check::Outcome::Passed);
}

/// Light that eats the black border does so on the floor as well.
TEST(TagSizeTest, IsAskedAgainstTheFloorTags) {
  SeenRun seen = seen_run(on_circle, usual());
  const auto shrink = [](TagCorners& corners) {
    ImagePoint middle;
    for (const ImagePoint& corner : corners) {
      middle.u += corner.u / 4;
      middle.v += corner.v / 4;
    }
    for (ImagePoint& corner : corners) {
      corner.u = middle.u + 0.985 * (corner.u - middle.u);
      corner.v = middle.v + 0.985 * (corner.v - middle.v);
    }
  };
  for (Sighting& sighting : seen.observations.sightings)
    shrink(sighting.corners);
  EXPECT_NE(find_issue(seen.track().value(), IssueCode::TagSizeDoubtful), nullptr);
  for (ReferenceLook& look : seen.observations.cameras[0].references)
    shrink(look.corners);
  const TrackedRun run = seen.track().value();
  EXPECT_EQ(find_issue(run, IssueCode::TagSizeDoubtful), nullptr);
}

TEST(TagSizeTest, TwoCamerasTellAHeightFromAnEdge) {
  for (const bool is_height : {true, false}) {
    SeenRun seen = seen_run(on_circle, usual());
    Seeing second = usual();
    second.clock_s = 3;
    second.seed = 2;
    add_camera(seen, on_circle, second, {1.0, 0.3});
    RobotSetup& robot = seen.rig.robots[2];
    is_height ? robot.height_m -= 0.1 : robot.edge_m /= 1.04;
    const TrackedRun run = seen.track().value();
    const IssueCode code = is_height ? IssueCode::TagSize : IssueCode::TagSizeDoubtful;
    EXPECT_THAT(issue_of(run, code).text, HasSubstr("as two cameras show"));
    EXPECT_THAT(find_issue(run, code)->text,
                HasSubstr(is_height ? "its `height` is" : "its `edge` is"));
  }
}

/// The corners of a tag that leans about its middle, upwards along its own x axis.
TagCorners leaning_corners(const View& view, const Pose& tag, double edge_m, double height_m,
                           double tilt_rad) {
  TagCorners corners;
  constexpr std::array<Point, 4> kModel{{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double along = kModel[i].x * edge_m * std::cos(tilt_rad);
    const double aside = kModel[i].y * edge_m;
    corners[i] =
        image_of(view, Point3{tag.x + std::cos(tag.theta) * along - std::sin(tag.theta) * aside,
                              tag.y + std::sin(tag.theta) * along + std::cos(tag.theta) * aside,
                              height_m + kModel[i].x * edge_m * std::sin(tilt_rad)});
  }
  return corners;
}

/// A robot on a circle of 0.9 m, whose tag leans.
SeenRun leaning_run(double tilt_rad, bool leans_with_robot) {
  const Truth wide = [](int robot, double time_s) {
    const double angle = 0.3 * time_s + 2.0 * robot;
    return Pose{0.8 * std::cos(angle), 0.8 * std::sin(angle), wrap_angle(angle + 0.5 * kPi)};
  };
  SeenRun seen = seen_run(wide, usual());
  const View view = seen.rig.view_of(seen.rig.cameras[0]).value();
  for (Sighting& sighting : seen.observations.sightings) {
    if (sighting.tag != 2) continue;
    Pose tag = tag_pose_of_robot(wide(1, sighting.time_s - 12.4), {0.06, -0.04, 0.3});
    if (leans_with_robot) {
      tag.x -= 0.2 * std::sin(tilt_rad) * std::cos(tag.theta);
      tag.y -= 0.2 * std::sin(tilt_rad) * std::sin(tag.theta);
    }
    sighting.corners = leaning_corners(view, tag, 0.1, 0.2, tilt_rad);
  }
  return seen;
}

TEST(TagTiltTest, ATagThatIsNotLevelIsNamedWithItsAngle) {
  for (const double degrees : {4.0, -6.0}) {
    const TrackedRun run = leaning_run(degrees * kDegree, true).track().value();
    EXPECT_EQ(issue_of(run, IssueCode::Tilted).robot, "rvr2");
    EXPECT_NEAR(*find_check(run, "tilt of the tag", "rvr2")->value, std::fabs(degrees), 0.5);
    EXPECT_EQ(find_check(run, "tilt of the tag", "rvr1")->outcome, Check::Outcome::Passed);
    EXPECT_GT(run.robots[1].sigmas.back().sigma_m, 0.2 * std::sin(3.5 * kDegree));
  }
}

TEST(TagTiltTest, OneThatIsLevelToADegreeIsNot) {
  const TrackedRun run = leaning_run(1 * kDegree, true).track().value();
  EXPECT_TRUE(run.issues.empty()) << run.issues.front().text;
}

TEST(TagTiltTest, ARobotThatIsLostByItIsToldSo) {
  const Expected<TrackedRun> run = leaning_run(25 * kDegree, false).track();
  const std::string text = run ? (find_issue(*run, IssueCode::Tilted) != nullptr
                                      ? find_issue(*run, IssueCode::Tilted)->text
                                      : "")
                               : run.error().message;
  EXPECT_THAT(text, HasSubstr("is tilted by"));
}

/// Survey, height, tilt and time, one after the other (docs/tracking.md).
TEST(KnownErrorsTest, AddUpToTheSigmaOfACycle) {
  SeenRun seen = seen_run(on_circle, usual());
  const auto sigma_of = [&](double survey_m, double height_m, double tilt_rad, double time_s,
                            double lens_px) {
    seen.rig.survey_error_m = survey_m;
    seen.rig.tilt_error_rad = tilt_rad;
    for (RobotSetup& robot : seen.rig.robots)
      robot.height_error_m = height_m;
    seen.rig.cameras[0].time_error_s = time_s;
    seen.rig.models.begin()->second.rms_px = lens_px;
    return seen.track().value().robots[0].sigmas.back().sigma_m;
  };
  const double noise = sigma_of(0, 0, 0, 0, 0);
  EXPECT_LT(noise, 0.0005);
  const auto alone = [&](double sigma) { return std::sqrt(sigma * sigma - noise * noise); };
  EXPECT_NEAR(alone(sigma_of(0.002, 0, 0, 0, 0)), 0.002, 1e-6);
  EXPECT_NEAR(alone(sigma_of(0, 0.01, 0, 0, 0)), 0.5 / 2.5 * 0.01, 2e-5);
  EXPECT_NEAR(alone(sigma_of(0, 0, kDegree, 0, 0)), 0.0035, 5e-5);
  EXPECT_NEAR(alone(sigma_of(0, 0, 0, 0.01, 0)), 0.003, 5e-5);
  EXPECT_NEAR(alone(sigma_of(0, 0, 0, 0, 0.4)), 0.4 / 1015 * 2.5, 1e-6);
  // What laboratories have if they say nothing.
  const TrackedRun run = seen_run(on_circle, usual()).track().value();
  EXPECT_NEAR(run.robots[0].sigmas.back().sigma_m, 0.0031, 0.0003);
  EXPECT_NEAR(run.robots[0].sigma.sigma_m, 0.0031, 0.0003);
}

}  // namespace
}  // namespace swarmsmith
