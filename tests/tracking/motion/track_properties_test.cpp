#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "tests/tracking/motion/seen_run.h"
#include "tracking/motion/resampling.h"

namespace swarmsmith {
namespace {

constexpr int kCycles = 100;

double drawn(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 10001) / 10000.0;
}

/// A run of 10 s, spoilt: tags hidden, frames lost, corners moved, tags seen twice.
SeenRun spoilt_run() {
  SeenRun seen = seen_run(on_circle, {.robots = 2,
                                      .cycles = kCycles,
                                      .frame_rate = static_cast<double>(*rc::gen::inRange(8, 40)),
                                      .from_s = drawn(-0.5, 0.5),
                                      .past_end_s = drawn(-0.3, 0.5),
                                      .noise_px = drawn(0, 2)});
  seen.options.scored_at_the_end = *rc::gen::arbitrary<bool>();
  const int gaps = *rc::gen::inRange(0, 4);
  for (int i = 0; i < gaps; ++i) {
    const double from = drawn(0.5, 11);
    seen.hide(*rc::gen::inRange(1, 3), from, from + drawn(0, 1.6));
  }
  if (*rc::gen::inRange(0, 4) == 0) {
    const double from = drawn(0, 11);
    seen.cut(from, from + drawn(0, 0.5));
  }
  auto& sightings = seen.observations.sightings;
  const int strays = sightings.empty() ? 0 : *rc::gen::inRange(0, 8);
  for (int i = 0; i < strays; ++i) {
    Sighting stray = sightings[*rc::gen::inRange<std::size_t>(0, sightings.size())];
    const double shift = drawn(-900, 900);
    for (ImagePoint& corner : stray.corners)
      corner.v += shift;
    if (*rc::gen::arbitrary<bool>()) stray.corners[1] = {1e9, -1e9};
    sightings.push_back(stray);
  }
  return seen;
}

/// The shortest distance between two used samples around an instant, one at or before it and one
/// at or after it; infinity when one side is empty.
double gap_around(const TrackedRobot& robot, double time_s) {
  double before = -INFINITY;
  double after = INFINITY;
  for (const Sample& sample : robot.samples) {
    if (sample.use != Sample::Use::Used) continue;
    if (sample.time_s <= time_s + kSameInstant_s) before = std::max(before, sample.time_s);
    if (sample.time_s >= time_s - kSameInstant_s) after = std::min(after, sample.time_s);
  }
  return std::max(0.0, after - before);
}

bool has_error(const TrackedRun& run) {
  return std::ranges::any_of(run.issues, [](const Issue& i) { return is_error(i.code); });
}

TEST(TrackPropertiesTest, SpoiltRunsKeepTheirPromises) {
  int tracked = 0;
  EXPECT_TRUE(rc::check("spoilt runs", [&] {
    SeenRun seen = spoilt_run();
    const Expected<TrackedRun> run = seen.track();
    if (!run) return;
    ++tracked;
    RC_ASSERT(run->trajectory.instants() == kCycles);
    for (const Pose& pose : run->trajectory.poses)
      RC_ASSERT(std::isfinite(pose.x) && std::isfinite(pose.y) && std::fabs(pose.theta) <= kPi);
    for (const TrackedRobot& robot : run->robots) {
      RC_ASSERT(std::ranges::is_sorted(robot.samples, {}, &Sample::time_s));
      RC_ASSERT(std::isfinite(robot.sigma.sigma_m) && std::isfinite(robot.mean_scale));
      RC_ASSERT(robot.longest_gap_s >= 0);
      double bridged = 0;
      for (int cycle = 1; cycle <= kCycles; ++cycle) {
        const CycleKind kind = robot.cycles[static_cast<std::size_t>(cycle - 1)];
        const double gap = gap_around(robot, instant_s(cycle));
        // A pose that claims to be measured or bridged lies between two samples.
        if (kind == CycleKind::Measured) RC_ASSERT(gap <= 0.2 + 1e-5);
        if (kind == CycleKind::Interpolated) RC_ASSERT(gap <= 0.5 + 1e-5);
        if (kind == CycleKind::Degraded) RC_ASSERT(gap <= 1.0 + 1e-5);
        if (kind == CycleKind::Interpolated || kind == CycleKind::Degraded) ++bridged;
        if (gap > 1.0 + 1e-5) RC_ASSERT(kind == CycleKind::Missing);
        if (std::isfinite(gap) && gap > 1.0 + 1e-5) RC_ASSERT(has_error(*run));
      }
      if (bridged > 0.05 * kCycles) RC_ASSERT(has_error(*run));
      const double at_end = gap_around(robot, instant_s(kCycles));
      if (seen.options.scored_at_the_end && at_end > 0.2 + 1e-5) RC_ASSERT(has_error(*run));
    }
    // The order in which sightings come says nothing.
    std::ranges::reverse(seen.observations.sightings);
    const TrackedRun again = seen.track().value();
    RC_ASSERT(again.trajectory == run->trajectory);
    RC_ASSERT(again.issues == run->issues);
  }));
  EXPECT_GT(tracked, 50);
}

}  // namespace
}  // namespace swarmsmith
