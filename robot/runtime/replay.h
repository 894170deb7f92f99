#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/expected.h"
#include "robot/runtime/run_record.h"

namespace swarmsmith {

/// What stepping the controller through a log's readings gave.
struct LogReplay {
  std::int64_t stepped = 0;  ///< cycles
  /// The first cycle that differs, and how.
  struct Difference {
    std::int64_t cycle = 0;
    std::string what;
  };
  std::optional<Difference> difference;
};

/// Steps the controller of the log's head through the readings of its rows and compares commands,
/// states and random numbers bit by bit. BadInput: a head whose controller or flavour cannot be
/// read.
Expected<LogReplay> replay_log(const RunRecord& record);

}  // namespace swarmsmith
