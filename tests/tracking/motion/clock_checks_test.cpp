#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/support/checks.h"
#include "tests/tracking/motion/seen_run.h"
#include "tracking/motion/internal/clock_checks.h"

namespace swarmsmith {
namespace {

constexpr Seeing kFilm{.cycles = 300, .frame_rate = 15, .noise_px = 0.05};

/// The camera's clock says another time than the true one.
template <class Clock>
SeenRun with_clock(const Truth& truth, const Clock& clock, const Seeing& seeing = kFilm) {
  SeenRun seen = seen_run(truth, seeing);
  const auto said = [&](double time_s) { return clock(time_s - seeing.clock_s) + seeing.clock_s; };
  CameraRecord& record = seen.observations.cameras[0];
  for (double& time : record.frame_times)
    time = said(time);
  for (Sighting& sighting : seen.observations.sightings)
    sighting.time_s = said(sighting.time_s);
  for (ReferenceLook& look : record.references)
    look.time_s = said(look.time_s);
  return seen;
}

std::vector<double> times_of(double rate, int frames, double grain) {
  std::vector<double> times;
  for (int i = 0; i < frames; ++i)
    times.push_back(grain > 0 ? std::round(i / rate / grain) * grain : i / rate);
  return times;
}

TEST(CountedTest, MultiplesOfAPeriodWereCounted) {
  for (const double rate : {10.0, 11.0, 15.0, 24000.0 / 1001, 25.0, 29.97, 30.0, 59.94}) {
    for (const double grain : {0.0, 1e-3, 1.0 / 90000}) {
      const auto period = counted_period_s(times_of(rate, 2000, grain));
      ASSERT_TRUE(period) << rate << ", " << grain;
      EXPECT_NEAR(1 / *period, rate, 0.001 * rate);
    }
  }
}

TEST(CountedTest, WithHolesTheyWereCountedToo) {
  std::vector<double> times = times_of(30, 2000, 1e-3);
  std::erase_if(times, [](double time) { return std::fmod(time, 1.7) < 0.08 && time > 0; });
  EXPECT_TRUE(counted_period_s(times));
}

TEST(CountedTest, AClockHasItsOwnTimes) {
  std::vector<double> times = times_of(30, 2000, 0);
  for (std::size_t i = 0; i < times.size(); ++i)
    times[i] += 0.002 * std::sin(1.3 * static_cast<double>(i));
  EXPECT_FALSE(counted_period_s(times));
  for (double& time : times)
    time = std::round(time * 1000) / 1000;
  EXPECT_FALSE(counted_period_s(times));
  // Since 1970: of a bag.
  times = times_of(30, 2000, 0);
  for (double& time : times)
    time += 1.7e9;
  EXPECT_FALSE(counted_period_s(times));
  EXPECT_FALSE(counted_period_s(times_of(30, 10, 0)));
}

TEST(CountedTest, IsDegradedUntilALengthAgrees) {
  SeenRun seen = seen_run(on_circle, kFilm);
  seen.observations.cameras[0].time_source = TimeSource::Container;
  TrackedRun run = seen.track().value();
  EXPECT_THAT(issue_of(run, IssueCode::ClockCounted).text, HasSubstr("`length`"));
  seen.options.span.lengths_s = {31.0 + 1.0 / 15};
  run = seen.track().value();
  EXPECT_TRUE(run.issues.empty()) << run.issues.front().text;
  seen.options.span.lengths_s = {46.6};
  run = seen.track().value();
  EXPECT_THAT(find_issue(run, IssueCode::Duration)->text, HasSubstr("1.5 times as fast"));
}

TEST(ClockStepTest, AStepIsSeenByAllRobotsAndNamed) {
  for (const double step : {0.3, 0.7, 1.5, 30.0}) {
    const SeenRun seen = with_clock(
        on_circle, [&](double time) { return time > 12 ? time + step : time; }, kFilm);
    const TrackedRun run = seen.track().value();
    const Issue& issue = issue_of(run, IssueCode::ClockStep);
    EXPECT_THAT(issue.text, HasSubstr("jumped ahead by")) << step;
    EXPECT_THAT(issue.text, HasSubstr("s of driving apart"));
    const Issue* gap = find_issue(run, IssueCode::Gap);
    EXPECT_EQ(gap, nullptr) << step << " " << gap->text;
    EXPECT_NEAR(issue.from.value(), 12 + step, 0.11);
  }
}

/// The clock is set back, so that frames between cannot be ordered and were left out.
SeenRun with_lost_time(const Truth& truth, double from_s, double step_s) {
  SeenRun seen = seen_run(truth, kFilm);
  seen.cut(from_s + 0.01, from_s + 0.01 + step_s);
  const double from_clock = from_s + kFilm.clock_s + 0.01;
  for (double& time : seen.observations.cameras[0].frame_times)
    if (time > from_clock) time -= step_s;
  for (Sighting& sighting : seen.observations.sightings)
    if (sighting.time_s > from_clock) sighting.time_s -= step_s;
  return seen;
}

TEST(ClockStepTest, TimeThatIsLostIsNamed) {
  for (const double step : {0.3, 0.7, 1.5}) {
    const TrackedRun run = with_lost_time(on_circle, 12, step).track().value();
    EXPECT_THAT(issue_of(run, IssueCode::ClockStep).text, HasSubstr("lost")) << step;
  }
}

/// Straight on for 0.6 s, and a turn for 0.4 s, each robot at another time.
Pose turning(int robot, double time_s) {
  const double phase = time_s + 0.35 * robot;
  const double turned = std::floor(phase) + std::clamp(std::fmod(phase, 1.0) / 0.4, 0.0, 1.0);
  Pose pose{-0.55 + 0.55 * robot, robot == 1 ? 0.5 : -0.4, 0};
  constexpr double kTurn_rad = 1.7;
  for (int leg = 0; leg < static_cast<int>(phase); ++leg) {
    pose.x += 0.18 * std::cos(kTurn_rad * (leg + 1));
    pose.y += 0.18 * std::sin(kTurn_rad * (leg + 1));
  }
  pose.theta = kTurn_rad * turned;
  const double way = 0.3 * std::max(0.0, std::fmod(phase, 1.0) - 0.4);
  pose.x += way * std::cos(pose.theta);
  pose.y += way * std::sin(pose.theta);
  return pose;
}

/// Robots turn in a second, so that nothing says how far each went: they are elsewhere at once.
TEST(ClockStepTest, ASecondThatIsLostAtOnceIsTheCauseThatIsNamed) {
  for (const double from : {8.0, 11.3, 12.7, 15.2, 17.5}) {
    const TrackedRun run = with_lost_time(turning, from, 1).track().value();
    const Issue& issue = issue_of(run, IssueCode::ClockStep);
    EXPECT_THAT(issue.text, HasSubstr("lost"));
    EXPECT_NEAR(issue.from.value(), from, 0.15);
    EXPECT_EQ(find_issue(run, IssueCode::Gap), nullptr) << find_issue(run, IssueCode::Gap)->text;
  }
}

TEST(ClockStepTest, MostJumpsAheadAreNamedWhileRobotsTurn) {
  int named = 0;
  for (const double from : {8.0, 8.2, 8.4, 8.6, 8.8, 9.0, 9.2, 9.4}) {
    const SeenRun seen = with_clock(
        turning, [&](double time) { return time < from ? time : time + 0.5; }, kFilm);
    const TrackedRun run = seen.track().value();
    const Issue* issue = find_issue(run, IssueCode::ClockStep);
    if (issue == nullptr) continue;
    ++named;
    EXPECT_THAT(issue->text, HasSubstr("jumped ahead by 0."));
    EXPECT_NEAR(issue->from.value(), from + 0.5, 0.15);
  }
  EXPECT_GE(named, 5);
  // The same pause, and no jump: pictures were dropped, and robots went on.
  SeenRun dropped = seen_run(turning, kFilm);
  for (const double from : {8.0, 9.2, 10.4, 11.6})
    dropped.cut(from, from + 0.45);
  EXPECT_EQ(find_issue(dropped.track().value(), IssueCode::ClockStep), nullptr);
}

TEST(ClockStepTest, FramesThatAreLostWhileCountingAddUp) {
  SeenRun seen = seen_run(on_circle, kFilm);
  CameraRecord& record = seen.observations.cameras[0];
  const std::vector<double> times = record.frame_times;
  for (std::size_t i = 25; i < times.size(); i += 25)
    seen.cut(times[i] - kFilm.clock_s - 0.01, times[i] - kFilm.clock_s + 0.01);
  const auto said = [&](double time) {
    return time - std::floor((time - times[0]) * kFilm.frame_rate / 25) / kFilm.frame_rate;
  };
  for (double& time : record.frame_times)
    time = said(time);
  for (Sighting& sighting : seen.observations.sightings)
    sighting.time_s = said(sighting.time_s);
  const TrackedRun run = seen.track().value();
  EXPECT_THAT(issue_of(run, IssueCode::ClockStep).text, HasSubstr("lost"));
}

TEST(OrderTest, PicturesInAnotherOrderAreNoFilm) {
  // Two exchanged, in all places or in three.
  for (const int most : {1000, 3}) {
    SeenRun seen = seen_run(on_circle, kFilm);
    const std::vector<double> times = seen.observations.cameras[0].frame_times;
    for (Sighting& sighting : seen.observations.sightings) {
      const std::int64_t pair = sighting.frame / 2;
      if (most == 3 && pair != 50 && pair != 90 && pair != 130) continue;
      const auto other = static_cast<std::size_t>(sighting.frame ^ 1);
      if (other >= times.size()) continue;
      sighting.frame = static_cast<std::int64_t>(other);
      sighting.time_s = times[other];
    }
    const TrackedRun run = seen.track().value();
    EXPECT_THAT(issue_of(run, IssueCode::Timestamps).text, HasSubstr("out of order")) << most;
  }
}

TEST(ClockStepTest, DroppedFramesJitterAndPausesAreNone) {
  SeenRun dropped = seen_run(on_circle, kFilm);
  for (int i = 1; i < 12; ++i)
    dropped.cut(2 * i + 0.01, 2 * i + 0.35);
  EXPECT_EQ(find_issue(dropped.track().value(), IssueCode::ClockStep), nullptr);
  const SeenRun jitter =
      with_clock(on_circle, [](double time) { return time + 0.02 * std::sin(50.0 * time); });
  EXPECT_EQ(find_issue(jitter.track().value(), IssueCode::ClockStep), nullptr);
  const auto pause = [](int robot, double time_s) {
    return on_circle(robot, time_s < 10 ? time_s : std::max(10.0, time_s - 3));
  };
  EXPECT_EQ(find_issue(seen_run(pause, kFilm).track().value(), IssueCode::ClockStep), nullptr);
}

TEST(FilmSpeedTest, NothingDrivesFasterThanItCan) {
  const auto at_speed = [](double share) {
    return [=](int robot, double time_s) { return on_circle(robot, share * time_s); };
  };
  for (const double share : {0.67, 1.0, 1.2}) {
    const TrackedRun run = seen_run(at_speed(share), kFilm).track().value();
    EXPECT_TRUE(run.issues.empty()) << share << run.issues.front().text;
  }
  for (const double share : {1.4, 1.5, 2.0}) {
    SeenRun seen = seen_run(at_speed(share), kFilm);
    EXPECT_NE(find_issue(seen.track().value(), IssueCode::FilmSpeed), nullptr) << share;
    seen.options.limits.knows_driving_speed = true;
    EXPECT_NE(find_issue(seen.track().value(), IssueCode::FilmTooFast), nullptr) << share;
  }
}

TEST(FilmSpeedTest, OnlyTheRunItselfCounts) {
  const Truth carried = [](int robot, double time_s) {  // twice as fast before and after it
    return on_circle(robot, time_s + std::min(time_s, 0.0) + std::max(time_s - 30, 0.0));
  };
  Seeing seeing = kFilm;
  seeing.from_s = -6;
  seeing.past_end_s = 6;
  const TrackedRun run = seen_run(carried, seeing).track().value();
  EXPECT_EQ(find_issue(run, IssueCode::FilmSpeed), nullptr);
}

TEST(FilmSpeedTest, OnlyUsedSamplesOfTheFirstCameraDuringTheRunCount) {
  TrackedRobot robot;
  for (int i = -300; i < 600; ++i) {
    const double time_s = 0.1 * i;
    const bool is_run = i >= 0 && i <= 300;
    robot.samples.push_back({.time_s = time_s, .pose = {(is_run ? 0.1 : 1) * time_s, 0, 0}});
    if (!is_run) continue;
    const Pose jump{5.0 * (i % 2), 5, 0};
    robot.samples.push_back({.time_s = time_s + 0.03, .camera = 1, .pose = jump});
    robot.samples.push_back({.time_s = time_s + 0.06, .pose = jump, .use = Sample::Use::Outlier});
  }
  Findings findings;
  check_speeds({robot}, {.driving_speed_m_s = 0.4}, 30, findings);
  EXPECT_NEAR(findings.checks.at(0).value.value(), 0.25, 1e-9);
}

TEST(FilmSpeedTest, FasterRobotsMayDriveFaster) {
  const auto twice = [](int robot, double time_s) { return on_circle(robot, 2 * time_s); };
  SeenRun seen = seen_run(twice, kFilm);
  ASSERT_NE(find_issue(seen.track().value(), IssueCode::FilmSpeed), nullptr);
  allow_speed(seen.options.limits, 0.8, 11);
  const TrackedRun run = seen.track().value();
  for (const IssueCode code : {IssueCode::FilmSpeed, IssueCode::Gap, IssueCode::Outliers,
                               IssueCode::PicturesRepeated, IssueCode::ClockStep})
    EXPECT_EQ(find_issue(run, code), nullptr) << name_of(code);
  const auto check = std::ranges::find(run.checks, "speed of the robots", &Check::name);
  ASSERT_NE(check, run.checks.end());
  EXPECT_LT(*check->value, 1.15);
}

TEST(FilmSpeedTest, LimitsAreThoseOfTheMissionsRobotAndOfTheLogs) {
  const TrackLimits usual;
  const Robot rvr{};
  Robot slow;
  slow.drive.max_speed_mps = 0.12;
  Robot fast;
  fast.drive.max_speed_mps = 0.7;
  Robot large;
  large.body.outline = BoxOutline{0.29, 0.29};
  for (const auto& [robot, logged] : {std::pair(rvr, 0.0), std::pair(slow, 0.0),
                                      std::pair(rvr, 0.35), std::pair(rvr, kMaxWheelSpeed_mps)}) {
    const TrackLimits limits = limits_of(robot, logged);
    EXPECT_EQ(limits.driving_speed_m_s, logged > 0 ? logged : usual.driving_speed_m_s);
    EXPECT_EQ(limits.top_speed_m_s, usual.top_speed_m_s);
    EXPECT_EQ(limits.top_turn_rad_s, usual.top_turn_rad_s);
    EXPECT_EQ(limits.jump_m, usual.jump_m);
    EXPECT_EQ(limits.corner_speed_m_s, usual.corner_speed_m_s);
    EXPECT_EQ(limits.knows_driving_speed, logged > 0);
  }
  EXPECT_DOUBLE_EQ(limits_of(fast, 0).driving_speed_m_s, 0.7);
  EXPECT_DOUBLE_EQ(limits_of(fast, 0).top_speed_m_s, 2);
  EXPECT_DOUBLE_EQ(limits_of(large, 0).driving_speed_m_s, kMaxWheelSpeed_mps);
  EXPECT_DOUBLE_EQ(limits_of(rvr, 0.7).top_speed_m_s, 2);
  EXPECT_DOUBLE_EQ(limits_of(rvr, 0.7).driving_speed_m_s, 0.7);
}

}  // namespace
}  // namespace swarmsmith
