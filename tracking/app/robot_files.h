#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tracking/observing/observations.h"
#include "tracking/rig/run_log.h"
#include "tracking/robots/robot_logs.h"

namespace swarmsmith {

/// The robots' logs of a run that are readable and belong to it.
struct RobotFiles {
  std::vector<RobotLog> logs;
  std::vector<Issue> issues;  ///< W_LOG_UNREADABLE and E_LOG_FOREIGN: why other logs are left out
};

/// Reads the logs that the run log names, relative to `folder`. `machine` is the machine that
/// should have run, if it is known; all robots must have run the same machine.
RobotFiles read_robot_files(const RunLog& log, const std::filesystem::path& folder,
                            const std::optional<RanMachine>& machine);

/// Adds a log to `files`, or its issue if it is not of this run or of another machine than the
/// first one.
void take_log(RobotLog log, const RunLog& run, const std::optional<RanMachine>& machine,
              RobotFiles& files);

}  // namespace swarmsmith
