#include "tests/support/film/recorded_run.h"

#include <cmath>
#include <fstream>
#include <numbers>

#include "base/text/whole_file.h"
#include "sim/control/machine_text.h"
#include "sim/engine/simulate.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"
#include "sim/mission/trajectory_csv.h"
#include "tests/support/stepwise_run.h"

namespace swarmsmith::film {
namespace {

/// Cycles that robots go on for after the mission's end.
constexpr int kAfter = 8;

Expected<std::string> machine_text(const std::string& word, const std::string& designs) {
  if (word.starts_with("--")) return word;
  std::ifstream in(designs);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(word + ",")) continue;
    while (!line.empty() && (line.back() == '\r' || line.back() == '\n'))
      line.pop_back();
    return line.substr(line.find("--"));
  }
  return bad_input("no machine " + word + " in " + designs);
}

/// Robots stand at their last poses after its end.
Expected<RecordedRun> run_of_trajectory(const RunWish& wish, const Mission& mission) {
  const auto text = read_file(wish.trajectory, "trajectory");
  if (!text) return Unexpected(text.error());
  auto recorded = parse_trajectory_csv(*text);
  if (!recorded) return Unexpected(recorded.error());
  RecordedRun run;
  run.mission = mission;
  if (wish.seconds) run.mission.cycles = static_cast<int>(std::lround(*wish.seconds * 10));
  const auto instance = instance_of(run.mission, wish.seed);
  if (!instance) return Unexpected(instance.error());
  run.instance = *instance;
  Trajectory& trajectory = recorded->trajectory;
  if (trajectory.robots != mission.robots || trajectory.instants() < run.mission.cycles)
    return bad_input("it is not a trajectory of a whole run of " + mission.name, wish.trajectory);
  run.instance.starts = recorded->starts.empty() ? run.instance.starts : recorded->starts;
  run.poses.resize(static_cast<std::size_t>(trajectory.robots));
  for (std::size_t i = 0; i < run.poses.size(); ++i) {
    run.poses[i].push_back(run.instance.starts[i]);
    for (int instant = 0; instant < trajectory.instants(); ++instant)
      run.poses[i].push_back(trajectory.at(instant)[i]);
  }
  trajectory.poses.resize(static_cast<std::size_t>(run.mission.cycles) * run.poses.size());
  run.trajectory = std::move(trajectory);
  run.score = score_of(run.mission, run.instance, run.trajectory);
  return run;
}

void record_stepwise(const SimulationSetup& setup, RecordedRun& run) {
  StepwiseRun steps = run_stepwise(setup);
  const auto cycles = static_cast<std::size_t>(run.mission.cycles);
  for (std::size_t i = 0; i < steps.poses.size(); ++i) {
    steps.decided[i].resize(cycles);
    steps.neighbours[i].resize(cycles);
  }
  for (std::size_t cycle = 0; cycle < cycles; ++cycle) {
    for (const auto& decided : steps.decided)
      run.trajectory.poses.push_back(decided[cycle].pose);
  }
  run.poses = std::move(steps.poses);
  run.step_s = StepwiseRun::kStep_s;
  run.decided = std::move(steps.decided);
  run.neighbours = std::move(steps.neighbours);
  run.score = score_of(run.mission, run.instance, run.trajectory);
}

}  // namespace

Expected<RecordedRun> record_run(const RunWish& wish, const std::string& designs) {
  const auto found = find_mission(wish.mission, ".");
  if (!found) return Unexpected(found.error().front());
  if (!wish.trajectory.empty()) return run_of_trajectory(wish, found->mission);
  const auto flavour = find_flavour(wish.flavour);
  if (!flavour) return Unexpected(flavour.error());
  const auto text = machine_text(wish.machine, designs);
  if (!text) return Unexpected(text.error());
  const auto machine = parse_machine(*text, **flavour);
  if (!machine) return Unexpected(machine.error());
  auto profile = find_profile(wish.profile, ".");
  if (!profile) return Unexpected(profile.error().front());
  if (wish.latency_s > 0) {
    profile->timing = {};
    profile->timing.delays = {{static_cast<int>(std::lround(wish.latency_s * 100)), 1}};
  }

  RecordedRun run;
  const ControlTiming& timing = profile->timing;
  const bool is_steady = timing.delays.size() <= 1 && timing.jitter == 0 &&
                         timing.least_period == 1 && timing.most_period == 1;
  if (is_steady) {
    run.latency_s = timing.delays.empty() ? 0 : timing.delays.front().sub_steps * 0.01;
  }
  run.mission = found->mission;
  run.machine = print_machine(*machine, **flavour);
  run.flavour = wish.flavour;
  if (wish.seconds) run.mission.cycles = static_cast<int>(std::lround(*wish.seconds * 10));
  const auto instance = instance_of(run.mission, wish.seed);
  if (!instance) return Unexpected(instance.error());
  run.instance = *instance;

  Mission longer = run.mission;
  longer.cycles += kAfter;
  const auto robots = static_cast<std::size_t>(run.mission.robots);
  run.poses.resize(robots);
  run.decided.resize(robots);
  run.neighbours.resize(robots);
  run.trajectory.robots = run.mission.robots;
  const SimulationSetup setup{*machine, **flavour, *profile, longer, run.instance, wish.seed};
  if (wish.every_step) {
    record_stepwise(setup, run);
    return run;
  }
  const Recorder recorder(
      [&](const Snapshot& now) {
        for (std::size_t i = 0; i < robots; ++i) {
          run.poses[i].push_back(now.robots[i].pose);
          if (now.cycle < 1 || now.cycle > run.mission.cycles) continue;
          run.decided[i].push_back(now.robots[i]);
          run.decided[i].back().readings = nullptr;  // good for now alone
          run.neighbours[i].push_back(now.robots[i].readings->neighbours);
          run.trajectory.poses.push_back(now.robots[i].pose);
        }
      },
      Sensors(Sensor::Neighbours));
  simulate(setup, recorder);
  run.score = score_of(run.mission, run.instance, run.trajectory);
  return run;
}

double distance_to_change(const RecordedRun& run, std::size_t robot, double most_m) {
  constexpr double kRing_m = 0.0005;
  constexpr int kDirections = 72;
  Trajectory last;
  last.robots = run.trajectory.robots;
  const auto end = run.trajectory.at(run.trajectory.instants() - 1);
  last.poses.assign(end.begin(), end.end());
  const double score = score_of(run.mission, run.instance, last);
  const Pose pose = last.poses.at(robot);
  for (double radius = kRing_m; radius < most_m; radius += kRing_m) {
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2 * std::numbers::pi * i / kDirections;
      last.poses[robot].x = pose.x + radius * std::cos(angle);
      last.poses[robot].y = pose.y + radius * std::sin(angle);
      if (score_of(run.mission, run.instance, last) != score) return radius;
    }
  }
  return most_m;
}

}  // namespace swarmsmith::film
