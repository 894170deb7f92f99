#pragma once

#include <bit>
#include <cstdint>

namespace swarmsmith {

/// The result of an evaluation on its way from the worker to the store. A new number must be a
/// field here: the code that reads and writes messages and rows takes the fields apart by
/// structured bindings, and does not compile if one is missing.
struct Measured {
  double score = 0;  ///< larger is better; 0 for a rejected evaluation
  std::uint64_t state_digest =
      0;                     ///< of the final state of the simulation: equal bits mean an equal run
  std::int64_t wall_us = 0;  ///< wall time on the worker; not part of the answer
  double time = 0;           ///< as reported by a target, in its unit; 0 if it reports none
};

/// Whether two runs of one evaluation gave the same result, bit by bit. Times may differ.
inline bool same_bits(const Measured& one, const Measured& other) {
  return std::bit_cast<std::uint64_t>(one.score) == std::bit_cast<std::uint64_t>(other.score) &&
         one.state_digest == other.state_digest;
}

}  // namespace swarmsmith
