#include "tracking/app/robot_files.h"

#include <utility>

#include "robot/log/log_file.h"

namespace swarmsmith {

RobotFiles read_robot_files(const RunLog& log, const std::filesystem::path& folder,
                            const std::optional<RanMachine>& machine) {
  RobotFiles files;
  for (const RobotNote& note : log.notes) {
    if (note.log.empty()) continue;
    auto record = read_robot_log(folder / note.log);
    if (!record) {
      const Error& first = record.error().front();
      files.issues.push_back(
          {IssueCode::LogUnreadable,
           note.robot + ": its log cannot be read: " + to_string(first) +
               "; copy it from the robot beside the run log, then `rescore` with --run",
           note.robot});
      continue;
    }
    take_log({note.robot, note.log, std::move(*record)}, log, machine, files);
  }
  return files;
}

void take_log(RobotLog log, const RunLog& run, const std::optional<RanMachine>& machine,
              RobotFiles& files) {
  auto misfit = misfit_of(log, run, machine);
  if (!misfit && !files.logs.empty()) misfit = other_machine(log, files.logs.front());
  if (misfit) {
    files.issues.push_back(std::move(*misfit));
  } else {
    files.logs.push_back(std::move(log));
  }
}

}  // namespace swarmsmith
