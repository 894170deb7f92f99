#pragma once

#include <cstdint>
#include <string>

namespace swarmsmith {

/// What a configuration of the race means outside of it.
struct CandidateText {
  std::string parameters;  ///< JSON object of the active parameters
  /// Text of the grammar, or the switches and values of a parameter file.
  std::string machine;
  /// As workers get it; not the machine's text where programs follow AClib's convention.
  std::string call;
  std::string modules;  ///< JSON object, module name -> occurrences
  std::int64_t states = 0;
  std::int64_t transitions = 0;
};

}  // namespace swarmsmith
