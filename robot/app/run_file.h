#pragma once

#include <functional>
#include <optional>
#include <string>

#include "base/expected.h"
#include "console/options.h"
#include "robot/log/track_log.h"
#include "robot/runtime/roll_call.h"
#include "sim/robot/robot.h"

namespace swarmsmith {

/// The run log that `start` writes for `swarmsmith track`: data from arguments, which only a person
/// knows, and data of the run (robot/log/track_log.h).
struct RunFileWords {
  std::string write;  ///< the file; empty: RUN.toml
  StartedRun run;     ///< the part that is given by arguments
  std::string logs;
  std::optional<std::int64_t> sync_tag;
  bool none = false;

  void declare(Options& options);
  /// The robot of the mission, which is a name or a file beside the run log; nothing if none is
  /// given.
  Expected<std::optional<Robot>> robot_of_mission(const std::string& name) const;
  /// Called before the run: checks that the file can be written, and that no other file is lost by
  /// it.
  Expected<void> check(const std::string& name) const;
  /// Called after the run. Returns the name of the file, empty if none was requested; `note` gets
  /// remarks for the user.
  Expected<std::string> write_file(const std::string& name, const RunStarter& starter,
                                   const std::function<void(const std::string&)>& note) const;
};

}  // namespace swarmsmith
