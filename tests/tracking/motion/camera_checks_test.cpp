#include "tests/support/checks.h"
#include "tests/tracking/motion/seen_run.h"
#include "tracking/motion/resampling.h"
#include "tracking/rig/calibration_limits.h"

namespace swarmsmith {
namespace {

TEST(CoverageTest, ATruncatedVideoKeepsItsTrajectory) {
  SeenRun seen = seen_run(on_circle, {.cycles = 1200});
  seen.cut(43.01, 1000);
  const TrackedRun run = seen.track().value();
  EXPECT_NEAR(run.covered_s, 43, 1e-6);
  const Issue& issue = issue_of(run, IssueCode::VideoTruncated);
  EXPECT_THAT(issue.text, HasSubstr("covered 43.00 of 120 s"));
  EXPECT_EQ(run.issues.size(), 1U);
  ASSERT_EQ(run.trajectory.instants(), 1200);
  EXPECT_EQ(run.trajectory.at(1199)[0], run.trajectory.at(430)[0]);
  EXPECT_EQ(run.robots[0].cycles[429], CycleKind::Measured);
  EXPECT_EQ(run.robots[0].cycles[430], CycleKind::Missing);
}

/// A video of exactly the run's length ends a frame before its last instant.
TEST(CoverageTest, TheLastInstantIsNeverExtrapolatedWhereItCounts) {
  SeenRun seen = seen_run(on_circle, {.cycles = 200, .past_end_s = -0.01});
  EXPECT_TRUE(seen.track()->issues.empty()) << seen.track()->issues.front().text;
  seen.options.scored_at_the_end = true;
  const TrackedRun run = seen.track().value();
  EXPECT_NE(find_issue(run, IssueCode::VideoTruncated), nullptr);
  EXPECT_EQ(find_check(run, "gap around the last instant", "rvr1")->reason,
            "the film ends before the run");
  // One that reaches it does.
  SeenRun whole = seen_run(on_circle, {.cycles = 200, .past_end_s = 0});
  whole.options.scored_at_the_end = true;
  EXPECT_TRUE(whole.track()->issues.empty()) << whole.track()->issues.front().text;
}

TEST(CoverageTest, AVideoThatBeginsLateOrElsewhereIsSaid) {
  const SeenRun late = seen_run(on_circle, {.cycles = 200, .from_s = 1.0});
  const TrackedRun run = late.track().value();
  ASSERT_NE(find_issue(run, IssueCode::VideoTruncated), nullptr);
  EXPECT_NEAR(run.covered_s, 19, 1e-6);
  EXPECT_NEAR(run.starts[0].x, on_circle(0, 1).x, 1e-4);
  const SeenRun elsewhere = seen_run(on_circle, {.cycles = 200, .from_s = 5.0});
  EXPECT_THAT(elsewhere.track().error().message, HasSubstr("E_VIDEO_TRUNCATED"));
}

TEST(FrameRateTest, BelowTenIsAnErrorAndTenIsNot) {
  const TrackedRun slow = seen_run(on_circle, {.cycles = 200, .frame_rate = 8}).track().value();
  EXPECT_THAT(issue_of(slow, IssueCode::FrameRate).text, HasSubstr("8.0 frames/s"));
  const TrackedRun ten = seen_run(on_circle, {.cycles = 200, .frame_rate = 10}).track().value();
  EXPECT_TRUE(ten.issues.empty()) << ten.issues.front().text;
}

TEST(FrameRateTest, DroppedFramesAreCounted) {
  SeenRun seen = seen_run(on_circle, {.cycles = 600});
  for (int i = 0; i < 30; ++i)  // three frames each, of 1801
    seen.cut(2 * i + 0.01, 2 * i + 0.11);
  TrackedRun run = seen.track().value();
  EXPECT_EQ(run.frames_dropped, 90);
  EXPECT_NEAR(run.frame_rate_least, 7.5, 1e-6);
  EXPECT_EQ(find_issue(run, IssueCode::FramesDropped), nullptr);
  seen.cut(1.01, 1.11);
  run = seen.track().value();
  EXPECT_EQ(run.frames_dropped, 93);
  ASSERT_NE(find_issue(run, IssueCode::FramesDropped), nullptr);
}

TEST(FrameRateTest, TheSamePictureAgainIsCounted) {
  SeenRun seen = seen_run(on_circle, {.cycles = 100});
  for (std::size_t i = 3; i < seen.observations.sightings.size(); ++i) {
    Sighting& sighting = seen.observations.sightings[i];
    if (sighting.frame % 50 == 1) sighting.corners = seen.observations.sightings[i - 3].corners;
  }
  EXPECT_EQ(seen.track()->frames_twice, 7);
}

TEST(LengthTest, EachFileIsCheckedAgainstTheLog) {
  SeenRun seen = seen_run(on_circle, {.cycles = 200});
  const double length = 21.0 + 1.0 / 30;
  CameraRecord& record = seen.observations.cameras[0];
  const auto complains = [&](TimeSource source, const char* file, double said_s) {
    record.time_source = source;
    record.file = file;
    seen.options.span.lengths_s = {said_s};
    return find_issue(seen.track().value(), IssueCode::Duration) != nullptr;
  };
  EXPECT_FALSE(complains(TimeSource::FrameRate, "a.avi", length + 0.19));
  EXPECT_TRUE(complains(TimeSource::FrameRate, "a.avi", length + 0.21));
  EXPECT_TRUE(complains(TimeSource::Container, "a.avi", length + 0.21));
  EXPECT_TRUE(complains(TimeSource::Sidecar, "a.avi", length + 0.21));
  EXPECT_TRUE(complains(TimeSource::Container, "a.mp4", length - 0.21));
  EXPECT_FALSE(complains(TimeSource::Container, "a.mp4", length - 0.19));
}

/// From `from_s` on all floor tags are seen elsewhere. One was kicked, and one is covered half of
/// the time.
void push_camera(SeenRun& seen, double from_s, double shift_px) {
  CameraRecord& record = seen.observations.cameras[0];
  const double start = seen.options.span.starts_s[0];
  for (ReferenceLook& look : record.references) {
    for (ImagePoint& corner : look.corners)
      corner.v += look.time_s - start > from_s - 1e-6 ? shift_px : 0;
    if (look.tag == 100 && look.time_s - start > 5) look.corners[0].u += 80;
  }
  std::erase_if(record.references, [&](const ReferenceLook& look) {
    return look.tag == 101 && look.time_s - start > 10;
  });
}

/// Floor tags from this number on are not seen after a time of the run.
void cover_references(SeenRun& seen, int from_tag, double from_s = -10) {
  std::erase_if(seen.observations.cameras[0].references, [&](const ReferenceLook& look) {
    return look.tag >= from_tag && look.time_s - seen.options.span.starts_s[0] > from_s;
  });
}

/// Calibrations of the time before a place kept its floor tags.
void forget_calibrated_tags(SeenRun& seen) {
  seen.rig.places.begin()->second.tags.clear();
}

TEST(CameraMovedTest, IsSeenByTheFloorTags) {
  for (const bool calibrated : {true, false}) {
    SeenRun seen = seen_run(on_circle, {.cycles = 200});
    push_camera(seen, 11, 1.5);
    if (!calibrated) forget_calibrated_tags(seen);
    const TrackedRun run = seen.track().value();
    const Issue& issue = issue_of(run, IssueCode::CameraMoved);
    EXPECT_NEAR(issue.from.value(), 11, 1e-9);
    EXPECT_THAT(issue.text, HasSubstr("moved between 10.0 s and 11.0 s"));
    EXPECT_THAT(issue.text, HasSubstr("most 1.5 px at 11.0 s"));
  }
}

TEST(CameraMovedTest, BeforeTheRunOnlyTheCalibrationTells) {
  for (const bool calibrated : {true, false}) {
    SeenRun seen = seen_run(on_circle, {.cycles = 200});
    push_camera(seen, -10, 1.5);
    if (!calibrated) forget_calibrated_tags(seen);
    EXPECT_EQ(find_issue(seen.track().value(), IssueCode::CameraMoved) != nullptr, calibrated);
  }
}

TEST(CameraMovedTest, LessThanAPixelOrOneOfSeveralTagsIsNot) {
  SeenRun seen = seen_run(on_circle, {.cycles = 200});
  push_camera(seen, 11, 0.9);
  const TrackedRun run = seen.track().value();
  EXPECT_TRUE(run.issues.empty()) << run.issues.front().text;
}

/// A check that cannot be made is said, and is not consent.
TEST(CameraMovedTest, CannotBeToldWithoutFloorTags) {
  SeenRun seen = seen_run(on_circle, {.cycles = 200});
  cover_references(seen, 100);
  const TrackedRun run = seen.track().value();
  const Issue& issue = issue_of(run, IssueCode::CameraUnchecked);
  EXPECT_THAT(issue.text, HasSubstr("camera camera0 saw none of its floor tags in the run"));
  EXPECT_EQ(run.issues.size(), 1U);
}

TEST(CameraMovedTest, OfOneFloorTagTellsOnlyThatItMoved) {
  SeenRun still = seen_run(on_circle, {.cycles = 200});
  cover_references(still, 101);
  const TrackedRun run = still.track().value();
  EXPECT_THAT(issue_of(run, IssueCode::CameraUnchecked).text,
              HasSubstr("saw only one of its floor tags in the run"));
  EXPECT_EQ(find_issue(run, IssueCode::CameraMoved), nullptr);
  SeenRun pushed = seen_run(on_circle, {.cycles = 200});
  push_camera(pushed, -10, 7);
  cover_references(pushed, 101);
  EXPECT_NE(find_issue(pushed.track().value(), IssueCode::CameraMoved), nullptr);
}

/// A robot stands half over a floor tag from then on, until another time: its corners are found
/// elsewhere.
void stand_on(SeenRun& seen, int tag, double from_s, double to_s) {
  for (ReferenceLook& look : seen.observations.cameras[0].references) {
    const double time = look.time_s - seen.options.span.starts_s[0];
    if (look.tag != tag || time < from_s || time > to_s) continue;
    for (ImagePoint& corner : look.corners)
      corner.u += 1.4;
  }
}

TEST(CameraMovedTest, ARobotOnOneOfTwoFloorTagsIsNoMovedCamera) {
  SeenRun seen = seen_run(on_circle, {.cycles = 300});
  cover_references(seen, 102);
  stand_on(seen, 101, 5, 9);
  EXPECT_TRUE(seen.track()->issues.empty());
  // Until the end, it cannot be told any more, which is a reason for doubt and no consent.
  stand_on(seen, 101, 9.1, 100);
  const TrackedRun run = seen.track().value();
  ASSERT_EQ(run.issues.size(), 1U);
  EXPECT_EQ(run.issues[0].code, IssueCode::CameraUnchecked);
  // A camera that was pushed moves both.
  SeenRun pushed = seen_run(on_circle, {.cycles = 300});
  cover_references(pushed, 102);
  for (ReferenceLook& look : pushed.observations.cameras[0].references) {
    for (ImagePoint& corner : look.corners)
      corner.v += look.time_s - pushed.options.span.starts_s[0] > 11 ? 1.5 : 0;
  }
  EXPECT_NE(find_issue(pushed.track().value(), IssueCode::CameraMoved), nullptr);
}

TEST(CameraMovedTest, AFloorTagAloneIsNoWitnessWhereTwoLaterOnesSayOtherwise) {
  SeenRun seen = seen_run(on_circle, {.cycles = 300});
  stand_on(seen, 100, 5, 9);
  std::erase_if(seen.observations.cameras[0].references, [&](const ReferenceLook& look) {
    const double time = look.time_s - seen.options.span.starts_s[0];
    return look.tag > 100 && time >= 5 && time <= 9;
  });
  EXPECT_TRUE(seen.track()->issues.empty());
}

TEST(CameraMovedTest, IsAskedForAtTheEndAsWell) {
  SeenRun seen = seen_run(on_circle, {.cycles = 300});
  cover_references(seen, 100, 15);
  const TrackedRun run = seen.track().value();
  const Issue& issue = issue_of(run, IssueCode::CameraUnchecked);
  EXPECT_THAT(issue.text, HasSubstr("saw none of its floor tags after 15.0 s"));
  // A cover of some seconds is no reason.
  SeenRun short_while = seen_run(on_circle, {.cycles = 300});
  cover_references(short_while, 100, 23);
  EXPECT_TRUE(short_while.track()->issues.empty());
}

TEST(CalibrationTest, SaysHowNearToItsLimitsItIs) {
  SeenRun seen = seen_run(on_circle, {.cycles = 50});
  CameraCalibration& lens = seen.rig.models.begin()->second;
  PlaceCalibration& place = seen.rig.places.begin()->second;
  const auto expect = [&](const char* question, double& of, double limit, double beyond,
                          double shown) {
    for (const double value : {beyond, limit}) {
      of = value;
      const TrackedRun run = seen.track().value();
      const Check* check = find_check(run, question, "camera0");
      EXPECT_DOUBLE_EQ(check->value.value(), shown * value) << question;
      EXPECT_EQ(check->outcome == Check::Outcome::Passed, value == limit) << question;
    }
  };
  const double lens_px = rms_limit_px(lens.model);
  const double place_px = rms_limit_px(place);
  expect("lens calibration", lens.rms_px, lens_px, 1.01 * lens_px, 1);
  expect("floor tags fit the camera's place", place.rms_px, place_px, 1.01 * place_px, 1);
  expect("worst floor tag, left out", place.worst_left_out_m, 0.005, 0.0051, 1000);
}

TEST(PlaceTest, OfAnEditedFileIsNoPlace) {
  SeenRun seen = seen_run(on_circle, {.cycles = 200});
  seen.rig.places.begin()->second.place.translation.x += 0.002;
  const TrackedRun run = seen.track().value();
  EXPECT_THAT(issue_of(run, IssueCode::Extrinsics).text, HasSubstr("was the file edited?"));
}

TEST(PlaceTest, IsDoubtfulWhenTheSurveyHasChanged) {
  SeenRun seen = seen_run(on_circle, {.cycles = 200});
  seen.rig.references[2].pose.x += 0.05;
  seen.rig.references[4].pose.theta += 0.01;
  const TrackedRun run = seen.track().value();
  EXPECT_THAT(issue_of(run, IssueCode::SurveyChanged).text,
              HasSubstr("102 by 50.00 mm, 104 by 0.00 mm"));
  EXPECT_EQ(run.issues.size(), 1U);
}

/// The file says what share of another arena its tags surround.
TEST(PlaceTest, FloorTagsMustSurroundTheArenaOfTheRun) {
  SeenRun seen = seen_run(on_circle, {.cycles = 200});
  const TrackedRun small = seen.track().value();
  const Check* spread = find_check(small, "floor tags around the arena", "camera0");
  ASSERT_NE(spread, nullptr);
  EXPECT_EQ(spread->outcome, Check::Outcome::Passed);
  EXPECT_NEAR(spread->value.value(), 62, 4);
  seen.arena = regular_dodecagon(12);
  const TrackedRun large = seen.track().value();
  EXPECT_THAT(issue_of(large, IssueCode::ReferenceTags).text,
              AllOf(HasSubstr("surround 2"), HasSubstr("at least 50 %"), HasSubstr("camera0"),
                    HasSubstr("calibrate arena")));
  spread = find_check(large, "floor tags around the arena", "camera0");
  ASSERT_NE(spread, nullptr);
  EXPECT_EQ(spread->outcome, Check::Outcome::Failed);
}

/// A camera reads out one picture after another.
TEST(ShutterTest, ReadoutAndExposureEndBeforeTheNextPicture) {
  struct Row {
    double readout_s;
    double exposure_s;
    const char* wanted;
  };
  for (const Row& row : {Row{0.5, 0, "`readout` of camera \"camera0\" is 500.0 ms"},
                         Row{0.036, 0, "`readout` of camera \"camera0\" is 36.0 ms"},
                         Row{0, 0.1, "`exposure` of camera \"camera0\" is 100.0 ms"}}) {
    SeenRun seen = seen_run(on_circle, {.cycles = 200, .frame_rate = 30});
    seen.rig.cameras[0].readout_s = row.readout_s;
    seen.rig.cameras[0].exposure_s = row.exposure_s;
    EXPECT_THAT(complaint_of(seen.track()),
                AllOf(HasSubstr("E_CONFIG"), HasSubstr(row.wanted),
                      HasSubstr("a picture each 33.3 ms"), HasSubstr("arena.toml")));
  }
  SeenRun seen = seen_run(on_circle, {.cycles = 200, .frame_rate = 30});
  seen.rig.cameras[0].readout_s = 0.033;
  seen.rig.cameras[0].exposure_s = 0.033;
  EXPECT_TRUE(seen.track());
}

}  // namespace
}  // namespace swarmsmith
