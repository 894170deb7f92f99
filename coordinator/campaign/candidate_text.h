#pragma once

#include <cstdint>
#include <string>

namespace swarmsmith {

/// What a configuration of the race means outside of it.
struct CandidateText {
  std::string parameters;  ///< JSON object of the active parameters
  /// Text of the grammar, or the switches and values of a parameter file: as workers get it.
  std::string machine;
  std::string modules;  ///< JSON object, module name -> occurrences
  std::int64_t states = 0;
  std::int64_t transitions = 0;
};

}  // namespace swarmsmith
