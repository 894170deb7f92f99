#include <gmock/gmock.h>

#include "tests/tracking/motion/seen_run.h"
#include "tracking/motion/resampling.h"

namespace swarmsmith {
namespace {

using testing::HasSubstr;

TEST(CoverageTest, ATruncatedVideoKeepsItsTrajectory) {
  SeenRun seen = seen_run(on_circle, {.cycles = 1200});
  seen.cut(43.01, 1000);
  const TrackedRun run = seen.track().value();
  EXPECT_NEAR(run.covered_s, 43, 1e-6);
  const Issue* issue = find_issue(run, IssueCode::VideoTruncated);
  ASSERT_NE(issue, nullptr);
  EXPECT_THAT(issue->text, HasSubstr("covered 43.00 of 120 s"));
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
  EXPECT_NE(find_issue(*seen.track(), IssueCode::VideoTruncated), nullptr);
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
  ASSERT_NE(find_issue(slow, IssueCode::FrameRate), nullptr);
  EXPECT_THAT(find_issue(slow, IssueCode::FrameRate)->text, HasSubstr("8.0 frames/s"));
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

TEST(LengthTest, AFileWithoutTimesIsCheckedAgainstTheLog) {
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
  EXPECT_FALSE(complains(TimeSource::Sidecar, "a.avi", length + 0.21));
  EXPECT_FALSE(complains(TimeSource::Container, "a.mp4", length + 0.21));
}

/// Looks at six floor tags, each 5 s; from `moved_from_s` on all are shifted.
void look_at_references(SeenRun& seen, double moved_from_s, double shift_px, bool calibrated) {
  for (int tag = 100; tag < 106; ++tag) {
    TagCorners corners{};
    for (std::size_t i = 0; i < corners.size(); ++i)
      corners.at(i) = {300.0 * (tag - 99) + static_cast<double>(i), 500};
    if (calibrated) {
      PlaceCalibration::Seen calibration{};
      calibration.tag.tag = tag;
      calibration.corners = corners;
      seen.rig.places.begin()->second.tags.push_back(calibration);
    }
    for (double time = 2.5; time < 20; time += 5) {
      TagCorners now = corners;
      for (ImagePoint& corner : now)
        corner.v += time >= moved_from_s ? shift_px : 0;
      // One tag was kicked, and one is covered half of the time.
      if (tag == 100 && time > 5) now[0].u += 80;
      if (tag == 101 && time > 10) continue;
      seen.observations.cameras[0].references.push_back({time + 12.4, tag, now, 100});
    }
  }
}

TEST(CameraMovedTest, IsSeenByTheFloorTags) {
  for (const bool calibrated : {true, false}) {
    SeenRun seen = seen_run(on_circle, {.cycles = 200});
    look_at_references(seen, 11, 1.5, calibrated);
    const TrackedRun run = seen.track().value();
    const Issue* issue = find_issue(run, IssueCode::CameraMoved);
    ASSERT_NE(issue, nullptr);
    EXPECT_NEAR(issue->from.value(), 12.5, 1e-9);
    EXPECT_THAT(issue->text, HasSubstr("most 1.5 px at 12.5 s"));
  }
}

TEST(CameraMovedTest, BeforeTheRunOnlyTheCalibrationTells) {
  for (const bool calibrated : {true, false}) {
    SeenRun seen = seen_run(on_circle, {.cycles = 200});
    look_at_references(seen, 0, 1.5, calibrated);
    EXPECT_EQ(find_issue(seen.track().value(), IssueCode::CameraMoved) != nullptr, calibrated);
  }
}

TEST(CameraMovedTest, LessThanAPixelOrOneTagIsNot) {
  SeenRun seen = seen_run(on_circle, {.cycles = 200});
  look_at_references(seen, 11, 0.9, true);
  EXPECT_EQ(find_issue(seen.track().value(), IssueCode::CameraMoved), nullptr);
}

}  // namespace
}  // namespace swarmsmith
