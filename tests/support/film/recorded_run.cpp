#include "tests/support/film/recorded_run.h"

#include <cmath>
#include <fstream>
#include <numbers>

#include "sim/control/machine_text.h"
#include "sim/engine/simulate.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"

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

}  // namespace

Expected<RecordedRun> record_run(const RunWish& wish, const std::string& designs) {
  const auto found = find_mission(wish.mission, ".");
  if (!found) return Unexpected(found.error().front());
  const auto flavour = find_flavour(wish.flavour);
  if (!flavour) return Unexpected(flavour.error());
  const auto text = machine_text(wish.machine, designs);
  if (!text) return Unexpected(text.error());
  const auto machine = parse_machine(*text, **flavour);
  if (!machine) return Unexpected(machine.error());
  const auto profile = find_profile(wish.profile, ".");
  if (!profile) return Unexpected(profile.error().front());

  RecordedRun run;
  run.mission = found->mission;
  if (wish.seconds) run.mission.cycles = static_cast<int>(std::lround(*wish.seconds * 10));
  const auto instance = instance_of(run.mission, wish.seed);
  if (!instance) return Unexpected(instance.error());
  run.instance = *instance;

  Mission longer = run.mission;
  longer.cycles += kAfter;
  const auto robots = static_cast<std::size_t>(run.mission.robots);
  run.poses.resize(robots);
  run.trajectory.robots = run.mission.robots;
  const Recorder recorder([&](const Snapshot& now) {
    for (std::size_t i = 0; i < robots; ++i) {
      run.poses[i].push_back(now.robots[i].pose);
      if (now.cycle >= 1 && now.cycle <= run.mission.cycles)
        run.trajectory.poses.push_back(now.robots[i].pose);
    }
  });
  simulate({*machine, **flavour, *profile, longer, run.instance, wish.seed}, recorder);
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
