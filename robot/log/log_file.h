#pragma once

#include <filesystem>
#include <string>

#include "base/text/csv.h"
#include "robot/runtime/run_record.h"

namespace swarmsmith {

/// The two files of a log: `run07.rvr1.log.csv` and `run07.rvr1.toml`.
struct LogFiles {
  std::filesystem::path rows;
  std::filesystem::path head;
};

/// The files of a robot's run in a folder.
LogFiles log_files_of(const std::filesystem::path& folder, const std::string& run,
                      const std::string& robot);
/// The same from the name of either file; a name with another ending is an error.
Expected<LogFiles> log_files_at(const std::filesystem::path& either);

/// Reads a log, given the name of either file; all errors in it are returned.
OrErrors<RunRecord> read_robot_log(const std::filesystem::path& either);

}  // namespace swarmsmith
