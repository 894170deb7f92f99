#include "tracking/motion/resampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/math.h"
#include "sim/control/machine_text.h"
#include "sim/engine/simulate.h"
#include "sim/files/profile_file.h"
#include "sim/mission/trajectory.h"
#include "tests/sim/engine/reference_data.h"
#include "tests/support/film/path.h"
#include "tests/tracking/motion/seen_run.h"

namespace swarmsmith {
namespace {

TEST(MotionTest, OfTwoSamplesIsALineAndTheShorterArc) {
  const Motion motion({{1.0, {0, 0, 3.0}}, {1.1, {0.02, -0.04, -3.0}}}, {});
  const PoseAt half = motion.at(1.05);
  EXPECT_EQ(half.kind, CycleKind::Measured);
  EXPECT_NEAR(half.pose.x, 0.01, 1e-6);
  EXPECT_NEAR(half.pose.y, -0.02, 1e-6);
  EXPECT_NEAR(std::fabs(half.pose.theta), kPi, 1e-6);
}

TEST(MotionTest, GivesTheBitsOfASampleAtTheInstant) {
  const std::vector<TimedPose> track{{0.1, {0.1, 0.2, 0.3}},
                                     {0.30000000000000004, {1.0 / 3, 0.7, 1}, {0.001, 0.002}},
                                     {9, {0, 0, 0}}};
  const PoseAt at = Motion(track, {}).at(instant_s(3));
  EXPECT_EQ(at.pose, track[1].pose);
  EXPECT_EQ(at.sigma.sigma_m, 0.001);
  EXPECT_EQ(at.sigma.sigma_rad, 0.002);
  EXPECT_EQ(at.kind, CycleKind::Measured);
  EXPECT_EQ(at.gap_s, 0);
}

TEST(MotionTest, NamesGapsByTheirLength) {
  const auto kind_across = [](double gap_s) {
    const Motion motion({{1, {0, 0, 0}}, {1 + gap_s, {0.01, 0, 0}}}, {});
    return motion.at(1 + gap_s / 2).kind;
  };
  EXPECT_EQ(kind_across(0.2), CycleKind::Measured);
  EXPECT_EQ(kind_across(0.21), CycleKind::Interpolated);
  EXPECT_EQ(kind_across(0.5), CycleKind::Interpolated);
  EXPECT_EQ(kind_across(0.51), CycleKind::Degraded);
  EXPECT_EQ(kind_across(1.0), CycleKind::Degraded);
  EXPECT_EQ(kind_across(1.01), CycleKind::Missing);
}

TEST(MotionTest, HoldsTheLastPoseWhereThereIsNothingBetween) {
  const std::vector<TimedPose> track{{1, {0.1, 0, 0}}, {3, {0.2, 0, 0}}, {3.2, {0.9, 0, 0}}};
  const Motion motion(track, {});
  EXPECT_EQ(motion.at(0.5).pose, track[0].pose);
  EXPECT_EQ(motion.at(2.9).pose, track[0].pose);
  EXPECT_EQ(motion.at(4.0).pose, track[2].pose);
  // 0.7 m in 0.2 s is not the robot's way.
  EXPECT_EQ(motion.at(3.1).pose, track[1].pose);
  for (const double time : {0.5, 2.9, 3.1, 4.0})
    EXPECT_EQ(motion.at(time).kind, CycleKind::Missing);
  // It may be as far as the limits let it go.
  EXPECT_NEAR(motion.at(1.5).sigma.sigma_m, 0.5, 1e-12);
  EXPECT_NEAR(motion.at(2.9).sigma.sigma_rad, kPi, 1e-12);
}

/// A robot that goes on a circle, seen every so often.
std::vector<TimedPose> circling(double every_s, double sigma_m = 1e-4) {
  std::vector<TimedPose> track;
  for (int i = 0; i * every_s < 5; ++i) {
    const double angle = 0.8 * i * every_s;
    track.push_back({i * every_s,
                     {0.4 * std::cos(angle), 0.4 * std::sin(angle), wrap_angle(angle + kPi / 2)},
                     {sigma_m, 5e-4}});
  }
  return track;
}

TEST(MotionTest, FollowsACurveBetweenSamples) {
  const Motion motion(circling(1.0 / 12), {});
  for (double time = 0.5; time < 4.5; time += 0.0371) {
    const Pose pose = motion.at(time).pose;
    EXPECT_NEAR(pose.x, 0.4 * std::cos(0.8 * time), 1e-4) << time;
    EXPECT_NEAR(pose.y, 0.4 * std::sin(0.8 * time), 1e-4) << time;
    EXPECT_NEAR(wrap_angle(pose.theta - 0.8 * time - kPi / 2), 0, 1e-3) << time;
  }
}

TEST(MotionTest, IsLessSureTheWiderTheGap) {
  double before = 0;
  for (const double gap : {0.04, 0.1, 0.3, 0.6, 0.9}) {
    std::vector<TimedPose> track = circling(0.02);
    std::erase_if(track, [&](const TimedPose& sample) {
      return sample.time_s > 2.01 && sample.time_s < 2 + gap - 0.005;
    });
    const Motion motion(track, {});
    const double sigma = motion.at(2 + gap / 2).sigma.sigma_m;
    EXPECT_GT(sigma, before) << gap;
    EXPECT_LT(motion.at(2 + gap / 10).sigma.sigma_m, sigma) << "nearer to a sample, " << gap;
    before = sigma;
  }
}

TEST(MotionTest, IsLessSureWhereTheRobotTurns) {
  // Straight on, then along y at once.
  std::vector<TimedPose> track;
  for (int i = 0; i <= 60; ++i) {
    const double way = 0.02 * i;
    track.push_back(
        {i / 15.0, i <= 30 ? Pose{way, 0, 0} : Pose{0.6, way - 0.6, kPi / 2}, {1e-4, 5e-4}});
  }
  const Motion motion(track, {});
  EXPECT_GT(motion.at(30.5 / 15).sigma.sigma_m, 3 * motion.at(10.5 / 15).sigma.sigma_m);
  EXPECT_GT(motion.at(30.5 / 15).sigma.sigma_rad, 3 * motion.at(10.5 / 15).sigma.sigma_rad);
}

TEST(MotionTest, TakesCamerasThatNearlyCoincide) {
  // Half a millisecond and a millimetre apart: no speed of 2 m/s.
  std::vector<TimedPose> track;
  for (int i = 0; i <= 60; ++i) {
    const double time = i / 15.0;
    track.push_back({time, {0.3 * time, 0, 0}, {1e-3, 5e-4}});
    track.push_back({time + 0.0005, {0.3 * time + 0.001, 0, 0}, {1e-3, 5e-4}});
  }
  std::erase_if(
      track, [](const TimedPose& sample) { return sample.time_s > 2.01 && sample.time_s < 2.39; });
  const Motion motion(track, {});
  EXPECT_NEAR(motion.at(2.2).pose.x, 0.6605, 0.002);
  EXPECT_LT(motion.at(2.2).sigma.sigma_m, 0.01);
}

/// One simulated run, as the simulator saw it.
struct Recorded {
  Mission mission;
  Instance instance;
  double score = 0;
  std::vector<std::vector<TimedPose>> robots;
};

Recorded recorded_run(const char* mission_name, const ReferenceMachine& machine,
                      std::int64_t seed) {
  Recorded run{.mission = built_in_mission(mission_name).value(), .instance = {}, .robots = {}};
  run.instance = instance_of(run.mission, seed).value();
  run.robots.resize(static_cast<std::size_t>(run.mission.robots));
  const Flavour& flavour = watermelon_argos3();
  const Machine parsed = parse_machine(machine.text, flavour).value();
  const Profile profile = built_in_profile("rvr").value();
  const Measured result =
      simulate({parsed, flavour, profile, run.mission, run.instance, seed},
               Recorder([&](const Snapshot& snapshot) {
                 for (std::size_t i = 0; i < run.robots.size(); ++i)
                   run.robots[i].push_back({instant_s(snapshot.cycle), snapshot.robots[i].pose});
               }));
  run.score = result.score;
  return run;
}

double resampled_score(const Recorded& run) {
  Trajectory trajectory{.robots = run.mission.robots};
  std::vector<Motion> motions;
  for (const auto& track : run.robots)
    motions.emplace_back(track, TrackLimits{});
  for (int cycle = 1; cycle <= run.mission.cycles; ++cycle) {
    for (const Motion& motion : motions)
      trajectory.poses.push_back(motion.at(instant_s(cycle)).pose);
  }
  return score_of(run.mission, run.instance, trajectory);
}

/// Between the instants, samples that are off by what a camera may be: they must not matter.
void add_samples_between(std::vector<TimedPose>& track) {
  std::vector<TimedPose> more;
  for (std::size_t i = 0; i < track.size(); ++i) {
    more.push_back(track[i]);
    if (i + 1 == track.size()) break;
    for (const double share : {0.3333, 0.71}) {
      TimedPose between = track[i];
      between.time_s += share * kControlPeriod_s;
      between.pose.x += 0.011;
      between.pose.theta = wrap_angle(between.pose.theta + 0.1);
      more.push_back(between);
    }
  }
  track = std::move(more);
}

/// Tracking facts, section 9: trajectories of the simulator that are pushed through the resampling
/// give the simulator's own bits.
class ResampledScores : public testing::TestWithParam<ReferenceMission> {};

TEST_P(ResampledScores, AreTheSimulatorsToTheBit) {
  const std::vector<ReferenceMachine> machines = reference_machines();
  for (std::int64_t seed = 1; seed <= 6; ++seed) {
    Recorded run =
        recorded_run(GetParam().ours, machines[static_cast<std::size_t>(seed) * 3], seed);
    ASSERT_EQ(run.robots.front().size(), 1201U);
    EXPECT_EQ(resampled_score(run), run.score) << "seed " << seed;
    for (auto& track : run.robots)
      add_samples_between(track);
    EXPECT_EQ(resampled_score(run), run.score) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Missions, ResampledScores, testing::ValuesIn(kReferenceMissions),
                         [](const auto& mission) { return std::string(mission.param.ours); });

/// How far poses between frames are from the truth, over all cycles of some runs.
struct Errors {
  double heading_squares = 0;
  double worst_m = 0;
  double worst_rad = 0;
  int cycles = 0;
  int beyond_3_sigma = 0;  ///< of three coordinates a cycle

  void add(const PoseAt& found, const Pose& truth) {
    const double turn = std::fabs(wrap_angle(found.pose.theta - truth.theta));
    const double dx = std::fabs(found.pose.x - truth.x);
    const double dy = std::fabs(found.pose.y - truth.y);
    heading_squares += turn * turn;
    worst_m = std::max(worst_m, hypot(dx, dy));
    worst_rad = std::max(worst_rad, turn);
    beyond_3_sigma += (dx > 3 * found.sigma.sigma_m ? 1 : 0) +
                      (dy > 3 * found.sigma.sigma_m ? 1 : 0) +
                      (turn > 3 * found.sigma.sigma_rad ? 1 : 0);
    ++cycles;
  }
  double heading_rms() const { return std::sqrt(heading_squares / cycles); }
};

/// The motion between the simulator's instants, unknown for a real robot: with smooth
/// velocities, or with velocities that change at the instants.
enum class Between { Smooth, Straight };

Pose truth_at(const std::vector<TimedPose>& robot, const film::Path& smooth, Between between,
              double time_s) {
  if (between == Between::Smooth) return smooth.at(time_s);
  const double place =
      std::clamp(time_s / kControlPeriod_s, 0.0, static_cast<double>(robot.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(place), robot.size() - 2);
  const double share = place - static_cast<double>(i);
  const Pose& a = robot[i].pose;
  const Pose& b = robot[i + 1].pose;
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
          wrap_angle(a.theta + share * wrap_angle(b.theta - a.theta))};
}

/// Runs of a mission as 12 frames a second see them, 3 % of them dropped, with the noise of tags
/// that was measured (tracking facts, section 6).
Errors errors_between_frames(const char* mission, Between between) {
  constexpr double kRate = 12;
  constexpr Scatter kNoise{1.3e-4, 0.0021};
  Errors errors;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const std::vector<ReferenceMachine> machines = reference_machines();
  for (std::size_t k = 0; k < 4; ++k) {
    const Recorded run =
        recorded_run(mission, machines[5 * k + 1], 11 + static_cast<std::int64_t>(k));
    for (const std::vector<TimedPose>& robot : run.robots) {
      std::vector<Pose> poses;
      for (const TimedPose& pose : robot)
        poses.push_back(pose.pose);
      const film::Path smooth(poses);
      std::vector<TimedPose> seen;
      for (double time = uniform(random) / kRate; time < robot.back().time_s; time += 1 / kRate) {
        if (uniform(random) < 0.03) continue;
        Pose pose = truth_at(robot, smooth, between, time);
        pose.x += kNoise.sigma_m * normal(random);
        pose.y += kNoise.sigma_m * normal(random);
        pose.theta = wrap_angle(pose.theta + kNoise.sigma_rad * normal(random));
        seen.push_back({time, pose, kNoise});
      }
      const Motion motion(seen, {});
      for (const TimedPose& truth : robot) {
        const PoseAt found = motion.at(truth.time_s);
        if (found.kind != CycleKind::Missing) errors.add(found, truth.pose);
      }
    }
  }
  return errors;
}

class BetweenFrames : public testing::TestWithParam<ReferenceMission> {};

TEST_P(BetweenFrames, PosesAreNearTheTruthAndTheirSigmasAreHonest) {
  for (const Between between : {Between::Smooth, Between::Straight}) {
    const Errors errors = errors_between_frames(GetParam().ours, between);
    EXPECT_GT(errors.cycles, 14'000);
    // Velocities that jump at the instants themselves are the worst that a robot can do.
    const bool is_smooth = between == Between::Smooth;
    EXPECT_LT(errors.heading_rms(), (is_smooth ? 0.4 : 0.6) * kPi / 180);
    EXPECT_LT(errors.worst_m, is_smooth ? 0.005 : 0.007);
    EXPECT_LT(errors.beyond_3_sigma, errors.cycles * 3 * 0.005) << "of " << errors.cycles;
  }
}

INSTANTIATE_TEST_SUITE_P(Missions, BetweenFrames, testing::ValuesIn(kReferenceMissions),
                         [](const auto& mission) { return std::string(mission.param.ours); });

}  // namespace
}  // namespace swarmsmith
