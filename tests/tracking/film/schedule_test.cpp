#include "tests/support/film/schedule.h"

#include <gtest/gtest.h>

#include "tests/support/film/path.h"

namespace swarmsmith::film {
namespace {

TEST(ScheduleTest, FramesAreTakenInTurn) {
  Schedule schedule;
  schedule.from_s = -1;
  schedule.until_s = 1;
  schedule.rate_hz = 10;
  schedule.clock_ahead_s = 1;
  const std::vector<ShotFrame> frames = frames_of(schedule, Rng(1));
  ASSERT_EQ(frames.size(), 21U);
  EXPECT_DOUBLE_EQ(frames.front().true_s, -1);
  EXPECT_DOUBLE_EQ(frames.back().true_s, 1);
  EXPECT_DOUBLE_EQ(frames.back().stamp_s, 2);
  EXPECT_EQ(frame_times_csv(frames).substr(0, 37), "frame,time_s\n0,0.000000\n1,0.100000\n2,");
}

TEST(ScheduleTest, DroppedFramesAreMissingInTimesAndCountedStampsLie) {
  Schedule schedule;
  schedule.until_s = 100;
  schedule.rate_hz = 10;
  schedule.drop_share = 0.2;
  schedule.drops = {{50, 51}};
  const std::vector<ShotFrame> frames = frames_of(schedule, Rng(1));
  EXPECT_NEAR(static_cast<double>(frames.size()), 0.8 * 991, 40);
  for (const ShotFrame& frame : frames)
    EXPECT_TRUE(frame.true_s < 50 || frame.true_s >= 51);
  schedule.counts_frames = true;
  const std::vector<ShotFrame> counted = frames_of(schedule, Rng(1));
  EXPECT_DOUBLE_EQ(counted.back().stamp_s, 0.1 * static_cast<double>(counted.size() - 1));
  EXPECT_DOUBLE_EQ(counted.back().true_s, 100);
}

TEST(ScheduleTest, ATwiceShownPictureIsTheOneBefore) {
  Schedule schedule;
  schedule.until_s = 10;
  schedule.twice_share = 0.3;
  int twice = 0;
  const std::vector<ShotFrame> frames = frames_of(schedule, Rng(2));
  for (std::size_t i = 1; i < frames.size(); ++i) {
    EXPECT_GT(frames[i].stamp_s, frames[i - 1].stamp_s);
    if (frames[i].picture != frames[i - 1].picture) continue;
    ++twice;
    EXPECT_EQ(frames[i].true_s, frames[i - 1].true_s);
  }
  EXPECT_GT(twice, 25);
}

TEST(PathTest, GoesThroughItsKnotsAndIsSmooth) {
  const std::vector<Pose> knots{{0, 0, 3}, {0.04, 0.01, 3.1}, {0.07, 0.03, -3.1}, {0.09, 0.06, -3}};
  const Path path(knots);
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const Pose at = path.at(0.1 * static_cast<double>(i));
    EXPECT_NEAR(at.x, knots[i].x, 1e-12);
    EXPECT_NEAR(at.y, knots[i].y, 1e-12);
    EXPECT_NEAR(at.theta, knots[i].theta, 1e-12);
  }
  // Stands before and after.
  EXPECT_EQ(path.at(-5), path.at(0));
  EXPECT_EQ(path.at(50), path.at(49));
  // The speed has no jump at an inner knot.
  const double h = 1e-4;
  const double before = (path.at(0.1).x - path.at(0.1 - h).x) / h;
  const double after = (path.at(0.1 + h).x - path.at(0.1).x) / h;
  EXPECT_NEAR(before, after, 1e-3);
}

}  // namespace
}  // namespace swarmsmith::film
