#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/expected.h"
#include "robot/runtime/run_record.h"

namespace swarmsmith {

/// The result of stepping the controller through the readings of a log.
struct LogReplay {
  std::int64_t stepped = 0;  ///< number of cycles
  /// The first cycle that differs, with a description.
  struct Difference {
    std::int64_t cycle = 0;
    std::string what;
  };
  std::optional<Difference> difference;
};

/// Steps the controller in the log's head through the readings of the rows, and compares commands,
/// states and random numbers bit by bit. BadInput: the controller or flavour in the head cannot be
/// read.
Expected<LogReplay> replay_log(const RunRecord& record);

}  // namespace swarmsmith
