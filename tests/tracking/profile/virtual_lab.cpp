#include "tests/tracking/profile/virtual_lab.h"

#include <algorithm>
#include <stdexcept>

#include "base/rng.h"
#include "sim/control/machine_text.h"
#include "sim/engine/simulate.h"
#include "sim/files/profile_file.h"

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
  Recorded run;
  run.tracked.trajectory.robots = mission.robots;
  run.tracked.robots.resize(static_cast<std::size_t>(mission.robots));
  run.logs.resize(run.tracked.robots.size());
  Rng noise(static_cast<std::uint64_t>(seed) + 1000);
  const Recorder recorder(
      [&](const Snapshot& now) {
        for (std::size_t i = 0; i < now.robots.size(); ++i) {
          const RobotRecord& record = now.robots[i];
          TrackedRobot& robot = run.tracked.robots[i];
          Sample sample;
          sample.time_s = now.cycle * 0.1;
          sample.frame = now.cycle;
          sample.pose = {record.pose.x + noise.normal(0, lab.noise_m),
                         record.pose.y + noise.normal(0, lab.noise_m),
                         record.pose.theta + noise.normal(lab.heading_off_rad, lab.noise_rad)};
          robot.samples.push_back(sample);
          if (now.cycle == 0) {
            run.tracked.starts.push_back(sample.pose);
            continue;
          }
          robot.cycles.push_back(CycleKind::Measured);
          run.tracked.trajectory.poses.push_back(sample.pose);
          LogRow& row = run.logs[i].record.rows.emplace_back();
          row.cycle = now.cycle;
          row.clock_s = kBegin_s + now.cycle * 0.1;
          row.sensed.time_s = now.cycle * 0.1;
          row.state = record.state;
          row.command = record.command;
          row.sensed.neighbours = record.readings->neighbours;
          row.age_ms[index_of(Feed::Neighbours)] = 0;
        }
      },
      Sensors(Sensor::Neighbours));
  simulate({*machine, flavour, lab.truth, mission, *instance, seed}, recorder);
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
