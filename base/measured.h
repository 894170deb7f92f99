#pragma once

#include <bit>
#include <cstdint>

namespace swarmsmith {

/// What an evaluation gives, from the worker to the store. A further number is a field here: what
/// reads and writes messages and rows takes these apart by name, and does not compile without it.
struct Measured {
  double score = 0;                ///< larger is better; 0 of a rejected evaluation
  std::uint64_t state_digest = 0;  ///< of the simulation's end: equal bits, equal run
  std::int64_t wall_us = 0;        ///< of the worker's clock; no part of the answer
  double time = 0;                 ///< as a target says it, in its unit; 0 where it does not
};

/// Whether two runs of one evaluation gave the same, bit by bit. What a clock says may differ.
inline bool same_bits(const Measured& one, const Measured& other) {
  return std::bit_cast<std::uint64_t>(one.score) == std::bit_cast<std::uint64_t>(other.score) &&
         one.state_digest == other.state_digest;
}

}  // namespace swarmsmith
