#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace swarmsmith {

/// Why a slot idles (orchestration facts, 11).
enum class IdleCause {
  StartUp,  ///< the worker has not asked for work since it came
  Barrier,  ///< nothing is wanted that is not leased already
  Credit,   ///< the worker asked for less than it has slots
  Network,  ///< it is leased enough and has not begun, or its result is on the way
  Commit,   ///< nothing is leased, because a store cannot write or does not keep up
  Held,     ///< nothing is leased, because the coordinator ends or people said so
  Alone,    ///< the worker is kept free for a task that may have killed one
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
