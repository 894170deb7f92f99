#include "tracking/motion/repeats.h"

#include <cmath>
#include <map>
#include <utility>

#include "base/rng.h"
#include "tests/support/checks.h"
#include "tests/tracking/motion/seen_run.h"

namespace swarmsmith {
namespace {

/// Robots that drive in circles and stand from `until_s` on, each from its own time.
Truth that_stop(double until_s, double apart_s = 0, int of = 3) {
  return [=](int robot, double time_s) {
    if (robot >= of) return Pose{0.2 * robot, -0.4, 0};
    return on_circle(robot, std::min(time_s, until_s + apart_s * robot));
  };
}

/// Frames get the picture of the frame that `shown` names, whose copies differ by what a codec
/// does.
template <class Shown>
void hold(SeenRun& seen, const Shown& shown, double codec_px = 0.03) {
  std::map<std::pair<std::int64_t, int>, TagCorners> corners;
  for (const Sighting& sighting : seen.observations.sightings)
    corners[{sighting.frame, sighting.tag}] = sighting.corners;
  Rng rng(7);
  for (Sighting& sighting : seen.observations.sightings) {
    const std::int64_t other = shown(sighting.frame);
    if (other == sighting.frame) continue;
    sighting.corners = corners.at({other, sighting.tag});
    for (ImagePoint& corner : sighting.corners) {
      corner.u += codec_px * rng.normal();
      corner.v += codec_px * rng.normal();
    }
  }
}

std::size_t repeats_in(const SeenRun& seen) {
  return repeats_of(seen.observations, 0, seen.rig.robots).count;
}

constexpr Seeing kFilm{.cycles = 300, .frame_rate = 15, .noise_px = 0.05};

double worst_mm(const TrackedRun& run, const Truth& truth) {
  double worst = 0;
  for (int cycle = 0; cycle < run.trajectory.instants(); ++cycle) {
    for (int robot = 0; robot < 3; ++robot) {
      const Pose at = truth(robot, 0.1 * (cycle + 1));
      const Pose& seen = run.trajectory.at(cycle)[static_cast<std::size_t>(robot)];
      worst = std::max(worst, 1000 * std::hypot(at.x - seen.x, at.y - seen.y));
    }
  }
  return worst;
}

TEST(RepeatsTest, AFilmOfRobotsThatMoveHasNone) {
  EXPECT_EQ(repeats_in(seen_run(on_circle, kFilm)), 0U);
}

TEST(RepeatsTest, EachPictureTwiceIsHalfAsManyPictures) {
  for (const double codec_px : {0.0, 0.05, 0.1}) {
    SeenRun seen = seen_run(on_circle, {.cycles = 300, .frame_rate = 30, .noise_px = 0.05});
    hold(
        seen, [](std::int64_t frame) { return frame / 2 * 2; }, codec_px);
    EXPECT_NEAR(static_cast<double>(repeats_in(seen)), 465, 3) << codec_px;
    const TrackedRun run = seen.track().value();
    EXPECT_NEAR(run.frame_rate_median, 15, 0.1);
    EXPECT_LT(worst_mm(run, on_circle), 2);
    EXPECT_NE(find_issue(run, IssueCode::PicturesRepeated), nullptr);
  }
}

TEST(RepeatsTest, ASlowCameraIsNotMadeFasterByHolding) {
  SeenRun seen = seen_run(on_circle, kFilm);
  hold(seen, [](std::int64_t frame) { return frame / 2 * 2; });
  const TrackedRun run = seen.track().value();
  EXPECT_THAT(issue_of(run, IssueCode::FrameRate).text, HasSubstr("7.5 frames/s"));
}

TEST(RepeatsTest, ARecorderThatHangsToTheEndCoversNoMore) {
  for (const int moving : {2, 3}) {
    SeenRun seen = seen_run(that_stop(1000, 0, moving), kFilm);
    hold(seen, [](std::int64_t frame) { return std::min<std::int64_t>(frame, 300); });
    if (moving == 3) seen.hide(3, 19.4, 100);  // what was not seen then says nothing
    const TrackedRun run = seen.track().value();
    EXPECT_THAT(issue_of(run, IssueCode::VideoTruncated).text, HasSubstr("hung"));
    EXPECT_NEAR(issue_of(run, IssueCode::PicturesRepeated).from.value(), 19.5, 0.01);
  }
}

TEST(RepeatsTest, AFewPicturesOverAndOverAreARecorderThatHangsToo) {
  for (const std::int64_t pictures : {2, 3, 7}) {
    SeenRun seen = seen_run(on_circle, kFilm);
    hold(seen, [&](std::int64_t frame) {
      return frame < 300 ? frame : 300 - pictures + (frame - 300) % pictures;
    });
    const TrackedRun run = seen.track().value();
    EXPECT_THAT(issue_of(run, IssueCode::VideoTruncated).text, HasSubstr("hung"));
    EXPECT_THAT(issue_of(run, IssueCode::PicturesRepeated).text, HasSubstr("over and over"));
  }
}

TEST(RepeatsTest, ARecorderThatHangsForAWhileLeavesAGap) {
  // In the middle, or to the last picture but one.
  for (const auto& [moving, first] : {std::pair(1, 150), std::pair(3, 150), std::pair(3, 435)}) {
    SeenRun seen = seen_run(that_stop(1000, 0, moving), kFilm);
    hold(seen, [from = first](std::int64_t frame) {
      return frame > from && frame < from + 30 ? from : frame;
    });
    const TrackedRun run = seen.track().value();
    EXPECT_EQ(run.frames_twice, 29);
    EXPECT_NE(find_issue(run, IssueCode::Gap), nullptr);
    EXPECT_NE(find_issue(run, IssueCode::PicturesRepeated), nullptr);
  }
}

TEST(RepeatsTest, ARecorderThatHangsBeforeOrAfterTheRunTakesNothing) {
  for (const std::int64_t first : {15, 555}) {
    SeenRun seen = seen_run(
        on_circle,
        {.cycles = 300, .frame_rate = 15, .from_s = -3, .past_end_s = 6, .noise_px = 0.05});
    hold(seen,
         [&](std::int64_t frame) { return frame > first && frame < first + 15 ? first : frame; });
    const TrackedRun run = seen.track().value();
    EXPECT_EQ(run.frames_twice, 14);
    EXPECT_TRUE(run.issues.empty()) << run.issues.front().text;
  }
}

/// Pulled up from 24 to 30 frames a second, from 25, from 10.
TEST(RepeatsTest, OtherRatesThanTheCamerasAreSeenThrough) {
  for (const double rate : {10.0, 20.0, 24.0, 25.0}) {
    SeenRun seen = seen_run(on_circle, {.cycles = 300, .frame_rate = 30, .noise_px = 0.05});
    hold(seen, [&](std::int64_t frame) {
      const auto picture = std::floor(static_cast<double>(frame) * rate / 30 + 1e-9);
      return static_cast<std::int64_t>(std::ceil(picture * 30 / rate - 1e-9));
    });
    const double wanted = 931 * (1 - rate / 30);
    EXPECT_NEAR(static_cast<double>(repeats_in(seen)), wanted, 0.02 * wanted + 2) << rate;
  }
}

/// What stands is where the film shows it, with a codec that hides the camera's noise, too.
TEST(RepeatsTest, RobotsThatStandAreNotRefused) {
  const auto start_together = [](int robot, double time_s) {
    return on_circle(robot, std::max(time_s, 2.0));
  };
  const auto pause_together = [](int robot, double time_s) {
    return on_circle(robot, time_s < 10 ? time_s : std::max(10.0, time_s - 8));
  };
  for (const double noise_px : {0.0, 0.05, 0.15}) {
    for (const Truth& truth : {Truth(start_together), Truth(pause_together), that_stop(20.02, 0.33),
                               that_stop(20.02, 0.33, 1), that_stop(20.02), that_stop(29.91)}) {
      SeenRun seen = seen_run(truth, {.cycles = 300, .frame_rate = 15, .noise_px = noise_px});
      seen.options.scored_at_the_end = true;
      const TrackedRun run = seen.track().value();
      EXPECT_LE(run.frames_twice, 0) << noise_px;
      for (const Issue& issue : run.issues)
        EXPECT_FALSE(is_error(issue.code)) << noise_px << ": " << issue.text;
    }
  }
}

TEST(RepeatsTest, RobotsThatStandFromTheBeginningHaveNoise) {
  const SeenRun noisy = seen_run(that_stop(-1), kFilm);
  EXPECT_TRUE(noisy.track()->issues.empty()) << noisy.track()->issues.front().text;
  const SeenRun frozen = seen_run(that_stop(-1), {.cycles = 300, .frame_rate = 15});
  const TrackedRun run = frozen.track().value();
  EXPECT_NE(find_issue(run, IssueCode::PicturesRepeated), nullptr);
  EXPECT_EQ(run.issues.size(), 1U);
}

TEST(RepeatsTest, OneRobotThatStopsAfterAFullStepIsDoubtful) {
  SeenRun seen = seen_run(that_stop(1000, 0, 1), kFilm);
  hold(seen, [](std::int64_t frame) { return std::min<std::int64_t>(frame, 300); });
  const TrackedRun run = seen.track().value();
  EXPECT_THAT(issue_of(run, IssueCode::PicturesRepeated).text, HasSubstr("nothing that moves"));
}

}  // namespace
}  // namespace swarmsmith
