#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tracking/observing/observations.h"
#include "tracking/rig/run_log.h"
#include "tracking/robots/robot_logs.h"

namespace swarmsmith {

/// The robots' logs of a run, as far as they can be read and are of it.
struct RobotFiles {
  std::vector<RobotLog> logs;
  std::vector<Issue> issues;  ///< W_LOG_UNREADABLE and E_LOG_FOREIGN: why others are left out
};

/// Reads what the run log names, from `folder` on. `machine` is what should have run, if
/// anybody says; all robots must have run the same.
RobotFiles read_robot_files(const RunLog& log, const std::filesystem::path& folder,
                            const std::optional<RanMachine>& machine);

}  // namespace swarmsmith
