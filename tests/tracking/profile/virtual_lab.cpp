#include "tests/tracking/profile/virtual_lab.h"

#include <algorithm>
#include <stdexcept>

#include "base/rng.h"
#include "sim/control/machine_text.h"
#include "sim/files/profile_file.h"
#include "tests/support/film/path.h"
#include "tests/support/stepwise_run.h"

namespace swarmsmith {
namespace {

/// Of the robots' clocks, when the run begins.
constexpr double kBegin_s = 4711.5;

/// What the camera and the robots' logs have of a run.
struct Recorded {
  TrackedRun tracked;
  std::vector<RobotLog> logs;
};

Recorded recorded(const VirtualLab& lab, const Mission& mission, std::int64_t seed) {
  const Flavour& flavour = watermelon_argos3();
  const auto machine = parse_machine(lab.machine, flavour);
  const auto instance = instance_of(mission, seed);
  if (!machine || !instance) throw std::runtime_error("no such machine or start");
  const StepwiseRun steps = run_stepwise({*machine, flavour, lab.truth, mission, *instance, seed});
  Recorded run;
  run.tracked.trajectory.robots = mission.robots;
  run.tracked.robots.resize(steps.poses.size());
  run.logs.resize(steps.poses.size());
  Rng noise(static_cast<std::uint64_t>(seed) + 1000);
  const auto seen = [&](const Pose& pose, double time_s) {
    const double pushed_m = lab.pushed_m * std::clamp(time_s - 60, 0.0, 1.0);
    return Pose{pose.x + pushed_m + noise.normal(0, lab.noise_m),
                pose.y + noise.normal(0, lab.noise_m),
                pose.theta + noise.normal(lab.heading_off_rad, lab.noise_rad)};
  };
  // The first frame comes at any time.
  const double first_s = noise.uniform(0, 1) / lab.rate_hz;
  for (std::size_t i = 0; i < steps.poses.size(); ++i) {
    const film::Path path(steps.poses[i], 0, StepwiseRun::kStep_s);
    TrackedRobot& robot = run.tracked.robots[i];
    for (std::int64_t frame = 0; first_s + static_cast<double>(frame) / lab.rate_hz < path.end_s();
         ++frame) {
      Sample sample;
      sample.time_s = first_s + static_cast<double>(frame) / lab.rate_hz;
      sample.frame = frame;
      sample.pose = seen(path.at(sample.time_s), sample.time_s);
      robot.samples.push_back(sample);
    }
    run.tracked.starts.push_back(seen(steps.poses[i].front(), 0));
    robot.cycles.assign(steps.decided[i].size(), CycleKind::Measured);
    for (std::size_t cycle = 1; cycle <= steps.decided[i].size(); ++cycle) {
      const RobotRecord& decided = steps.decided[i][cycle - 1];
      LogRow& row = run.logs[i].record.rows.emplace_back();
      row.cycle = static_cast<std::int64_t>(cycle);
      row.clock_s = kBegin_s + kControlPeriod_s * static_cast<double>(cycle);
      row.sensed.time_s = row.clock_s - kBegin_s;
      row.state = decided.state;
      row.command = decided.command;
      row.sensed.neighbours = steps.neighbours[i][cycle - 1];
      row.age_ms[index_of(Feed::Neighbours)] = 0;
    }
  }
  for (int cycle = 0; cycle < mission.cycles; ++cycle) {
    for (const auto& decided : steps.decided)
      run.tracked.trajectory.poses.push_back(
          seen(decided[static_cast<std::size_t>(cycle)].pose, kControlPeriod_s * (cycle + 1)));
  }
  for (std::size_t i = 0; i < run.logs.size(); ++i) {
    const std::string name = "rvr" + std::to_string(i + 1);
    run.tracked.robots[i].name = name;
    run.logs[i].robot = name;
    run.logs[i].record.head.start_clock_s = kBegin_s;
  }
  return run;
}

}  // namespace

std::vector<MeasuredRobot> VirtualLab::run(std::int64_t seed) const {
  const Mission built_in = built_in_mission(mission).value();
  const Recorded run = recorded(*this, built_in, seed);
  std::vector<MeasuredRobot> robots;
  for (std::size_t i = 0; i < run.logs.size(); ++i) {
    const Latency latency =
        tells_latency ? latency_of(commands_of(run.logs[i].record), run.tracked.robots[i].samples)
                      : Latency{.reason = "not asked"};
    robots.push_back({"run" + std::to_string(seed), run.logs[i].robot,
                      reality_of({run.tracked, built_in, i, run.logs[i]}, latency)});
  }
  return robots;
}

std::vector<MeasuredRobot> VirtualLab::runs(int count, std::int64_t first_seed) const {
  std::vector<MeasuredRobot> all;
  for (int i = 0; i < count; ++i) {
    for (MeasuredRobot& robot : run(first_seed + i))
      all.push_back(std::move(robot));
  }
  return all;
}

Profile rvr_profile() {
  return built_in_profile("rvr").value();
}

}  // namespace swarmsmith
