#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>

namespace swarmsmith {

/// The result of an evaluation on its way from the simulator or program to the store. A new number
/// is a field here: the code that reads and writes messages and rows takes all fields, and does not
/// compile if one is missing. In a store's answer, the state digest stands for all numbers of a
/// run; only a number that decides races is added there (storage/answer.cpp).
struct Measured {
  double score = 0;  ///< larger is better; 0 for a rejected evaluation
  std::uint64_t state_digest =
      0;                     ///< of the final state of the simulation: equal bits mean an equal run
  std::int64_t wall_us = 0;  ///< wall time on the worker; not part of the answer
  double time = 0;           ///< as reported by a target, in its unit; 0 if it reports none
};

/// References to all fields, in their order.
template <class AnyMeasured>
constexpr auto measured_fields(AnyMeasured& measured) {
  auto& [score, state_digest, wall_us, time] = measured;
  return std::tie(score, state_digest, wall_us, time);
}
inline constexpr std::size_t kMeasuredFields =
    std::tuple_size_v<decltype(measured_fields(std::declval<Measured&>()))>;

/// Whether two runs of one evaluation gave the same result, bit by bit. Times may differ, and -0 is
/// 0, as in stores.
inline bool same_bits(const Measured& one, const Measured& other) {
  return std::bit_cast<std::uint64_t>(one.score + 0.0) ==
             std::bit_cast<std::uint64_t>(other.score + 0.0) &&
         one.state_digest == other.state_digest;
}

}  // namespace swarmsmith
