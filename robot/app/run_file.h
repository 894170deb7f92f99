#pragma once

#include <functional>
#include <optional>
#include <string>

#include "base/expected.h"
#include "console/options.h"
#include "robot/log/track_log.h"
#include "robot/runtime/roll_call.h"

namespace swarmsmith {

/// The run log that `start` writes for the camera's side: words that only a person knows, and what
/// the run was (robot/log/track_log.h).
struct RunFileWords {
  std::string write;  ///< the file; empty: RUN.toml
  StartedRun run;     ///< what words say of it
  std::string logs;
  std::optional<std::int64_t> sync_tag;
  bool none = false;

  void declare(Options& options);
  /// Before the run: the file can be written, and nothing is lost by it.
  Expected<void> check(const std::string& name) const;
  /// After it. The file's name, empty when none was wanted; `note` gets what a person should know.
  Expected<std::string> write_file(const std::string& name, const RunStarter& starter,
                                   const std::function<void(const std::string&)>& note) const;
};

}  // namespace swarmsmith
