#include "robot/app/run_file.h"

#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <filesystem>

#include "base/text/whole_file.h"
#include "robot/log/log_file.h"
#include "sim/files/mission_file.h"

namespace swarmsmith {
namespace {

std::string file_of(const RunFileWords& words, const std::string& name) {
  return words.write.empty() ? name + ".toml" : words.write;
}

/// The local date by the wall clock.
std::string date_of(double unix_s) {
  const auto seconds = static_cast<std::time_t>(unix_s);
  std::tm parts{};
  localtime_r(&seconds, &parts);
  return fmt::format("{:04}-{:02}-{:02}", parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday);
}

/// The path of a file relative to the folder of the run log.
std::string seen_from(const std::filesystem::path& file, const std::filesystem::path& run_file) {
  std::error_code failed;
  const auto folder = std::filesystem::absolute(run_file, failed).parent_path();
  const auto relative = std::filesystem::absolute(file, failed)
                            .lexically_normal()
                            .lexically_relative(folder.lexically_normal());
  return relative.empty() ? file.string() : relative.string();
}

/// The clock of the video's frames, from the finished recording or from one in progress.
std::optional<CameraClock> clock_of(const std::string& video,
                                    const std::function<void(const std::string&)>& note) {
  if (video.empty()) return std::nullopt;
  const std::filesystem::path place(video);
  const std::string sidecar = (place.parent_path() / place.stem()).string() + ".times.csv";
  for (const std::string& file : {sidecar, sidecar + ".part"}) {
    const auto text = read_whole_file(file);
    if (!text) continue;
    const auto clock = camera_clock_of(*text, file);
    if (clock) return *clock;
    note(to_string(clock.error()));
    return std::nullopt;
  }
  note(sidecar + ": there are no frame times yet");
  return std::nullopt;
}

}  // namespace

void RunFileWords::declare(Options& options) {
  options.text("--write FILE", write, "Run log for `swarmsmith track score` (default RUN.toml)");
  options.flag("--no-run-log", none, "Do not write a run log");
  options.text("--mission MISSION|FILE", run.mission,
               "For that log: the mission, a name or a file; its robot is the kind of the robots");
  options.text("--design DESIGN", run.design, "For that log: the design whose winner ran, d3");
  options.text("--candidate CANDIDATE", run.candidate,
               "For that log: the candidate that ran, c812");
  options.text("--video FILE", run.video,
               "For that log: the video that is recorded on this computer");
  options.text("--camera CAMERA", run.camera,
               "For that log: the video's camera, as in the arena file");
  options.text("--robot-logs DIR", logs, "For that log: the folder where you put the robots' logs");
  options.integer("--sync-tag", sync_tag, {0, 100000}, "For that log: a tag covered at the start");
  options.flag("--patches", run.has_patches,
               "For that log: measure the colour patches in the video");
}

Expected<std::optional<Robot>> RunFileWords::robot_of_mission(const std::string& name) const {
  if (run.mission.empty()) return std::nullopt;
  std::error_code ignored;
  auto mission = find_mission(
      run.mission, std::filesystem::absolute(file_of(*this, name), ignored).parent_path());
  if (!mission) {
    Error error = mission.error().front();
    error.message += "; the mission says which robot the run is for, or say it with --kind";
    return Unexpected(std::move(error));
  }
  return std::move(mission->mission.robot);
}

Expected<void> RunFileWords::check(const std::string& name) const {
  if (none) return {};
  const std::string file = file_of(*this, name);
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored)) {
    return unexpected(ErrorKind::Conflict,
                      "already exists, from an earlier run; give the run another name, or "
                      "another file with --write",
                      file);
  }
  const auto folder = std::filesystem::absolute(file, ignored).parent_path();
  if (!std::filesystem::is_directory(folder, ignored))
    return unexpected(ErrorKind::NotFound, "there is no such folder", folder.string());
  return {};
}

Expected<std::string> RunFileWords::write_file(
    const std::string& name, const RunStarter& starter,
    const std::function<void(const std::string&)>& note) const {
  if (none) return std::string();
  const std::string file = file_of(*this, name);
  StartedRun started = run;
  started.run = name;
  started.recorded = date_of(starter.start().unix_s);
  started.at_clock_s = seconds_of(starter.start().clock.time_since_epoch());
  if (!run.video.empty()) started.video = seen_from(run.video, file);
  if (sync_tag) started.sync_tag = static_cast<int>(*sync_tag);
  for (const RolledRobot& robot : starter.roll().robots()) {
    NodeReport node{.robot = robot.name, .log = "", .verdict = {}, .reasons = {}};
    if (!logs.empty()) node.log = seen_from(log_files_of(logs, name, robot.name).rows, file);
    if (starter.is_over_for(robot)) {
      node.verdict = robot.state->verdict;
      node.reasons = robot.state->reasons;
    }
    started.nodes.push_back(std::move(node));
  }
  const TrackLog log = track_log_of(started, clock_of(run.video, note));
  for (const std::string& warning : log.warnings) {
    if (!run.video.empty()) note(warning);
  }
  if (const auto written = write_whole_file(file, log.text); !written)
    return Unexpected(written.error());
  return file;
}

}  // namespace swarmsmith
