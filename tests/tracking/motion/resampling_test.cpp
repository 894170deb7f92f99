#include "tracking/motion/resampling.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/math.h"
#include "sim/control/machine_text.h"
#include "sim/engine/simulate.h"
#include "sim/files/profile_file.h"
#include "sim/mission/trajectory.h"
#include "tests/sim/engine/reference_data.h"
#include "tests/tracking/motion/seen_run.h"

namespace swarmsmith {
namespace {

TEST(PoseAtTest, InterpolatesAlongTheLineAndTheShorterArc) {
  const std::vector<TimedPose> track{{1.0, {0, 0, 3.0}}, {1.1, {0.02, -0.04, -3.0}}};
  const PoseAt half = pose_at(track, 1.05, {});
  EXPECT_EQ(half.kind, CycleKind::Measured);
  EXPECT_NEAR(half.pose.x, 0.01, 1e-12);
  EXPECT_NEAR(half.pose.y, -0.02, 1e-12);
  EXPECT_NEAR(std::fabs(half.pose.theta), kPi, 1e-9);
}

TEST(PoseAtTest, GivesTheBitsOfASampleAtTheInstant) {
  const std::vector<TimedPose> track{
      {0.1, {0.1, 0.2, 0.3}}, {0.30000000000000004, {1.0 / 3, 0.7, 1}}, {9, {0, 0, 0}}};
  const PoseAt at = pose_at(track, instant_s(3), {});
  EXPECT_EQ(at.pose, track[1].pose);
  EXPECT_EQ(at.kind, CycleKind::Measured);
  EXPECT_EQ(at.gap_s, 0);
}

TEST(PoseAtTest, NamesGapsByTheirLength) {
  const auto kind_across = [](double gap_s) {
    const std::vector<TimedPose> track{{1, {0, 0, 0}}, {1 + gap_s, {0.01, 0, 0}}};
    return pose_at(track, 1 + gap_s / 2, {}).kind;
  };
  EXPECT_EQ(kind_across(0.15), CycleKind::Measured);
  EXPECT_EQ(kind_across(0.16), CycleKind::Interpolated);
  EXPECT_EQ(kind_across(0.5), CycleKind::Interpolated);
  EXPECT_EQ(kind_across(0.51), CycleKind::Degraded);
  EXPECT_EQ(kind_across(1.0), CycleKind::Degraded);
  EXPECT_EQ(kind_across(1.01), CycleKind::Missing);
}

TEST(PoseAtTest, HoldsTheLastPoseWhereThereIsNothingBetween) {
  const std::vector<TimedPose> track{{1, {0.1, 0, 0}}, {3, {0.2, 0, 0}}, {3.2, {0.9, 0, 0}}};
  EXPECT_EQ(pose_at(track, 0.5, {}).pose, track[0].pose);
  EXPECT_EQ(pose_at(track, 2.9, {}).pose, track[0].pose);
  EXPECT_EQ(pose_at(track, 4.0, {}).pose, track[2].pose);
  // 0.7 m in 0.2 s is not the robot's way.
  EXPECT_EQ(pose_at(track, 3.1, {}).pose, track[1].pose);
  for (const double time : {0.5, 2.9, 3.1, 4.0})
    EXPECT_EQ(pose_at(track, time, {}).kind, CycleKind::Missing);
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
  const SimulationResult result =
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
  for (int cycle = 1; cycle <= run.mission.cycles; ++cycle) {
    for (const auto& track : run.robots)
      trajectory.poses.push_back(pose_at(track, instant_s(cycle), {}).pose);
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

}  // namespace
}  // namespace swarmsmith
