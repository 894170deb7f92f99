#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace swarmsmith {

/// The reasons why a slot is idle (orchestration facts, 11).
enum class IdleCause {
  StartUp,  ///< the worker has not asked for work since it connected
  Barrier,  ///< all wanted tasks are leased already
  Credit,   ///< the worker asked for fewer tasks than it has slots
  Network,  ///< the worker has enough leases; a task has not begun, or its result is on the way
  Commit,   ///< leasing is stopped because a store cannot write or is too slow
  Held,     ///< leasing is stopped because the coordinator is ending or people paused it
  Alone,    ///< the worker is kept free for a task that may have killed a worker
};
inline constexpr std::size_t kIdleCauses = 7;
/// As in metrics and JSON: "start-up", "barrier", ...
std::string_view name_of(IdleCause cause);

/// Seconds of slots, summed over workers: `slots` = `busy` + the sum of `idle`.
struct SlotTimes {
  double slots = 0;
  double busy = 0;
  std::array<double, kIdleCauses> idle{};  ///< by IdleCause

  double idle_total() const;
};

}  // namespace swarmsmith
