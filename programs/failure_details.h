#pragma once

#include <string>

namespace swarmsmith {

/// Details about a program that gave no score: all empty for the simulator.
struct FailureDetails {
  std::string command;  ///< the command line, as it was run
  std::string output;   ///< its standard output; only the end if it is long
  std::string errors;   ///< the same for standard error

  friend bool operator==(const FailureDetails&, const FailureDetails&) = default;
};

}  // namespace swarmsmith
