#pragma once

#include <cstdint>
#include <string>

namespace swarmsmith {

/// A configuration of the race in the forms that are used outside the race.
struct CandidateText {
  std::string parameters;  ///< JSON object of the active parameters
  /// A text of the grammar, or the switches and values of a parameter file.
  std::string machine;
  /// In the form that workers get; it differs from `machine` if programs follow AClib's convention.
  std::string call;
  std::string modules;  ///< JSON object, module name -> occurrences
  std::int64_t states = 0;
  std::int64_t transitions = 0;
};

}  // namespace swarmsmith
