#pragma once

#include <string>

namespace swarmsmith {

/// What a program did that gave no score: all empty for the simulator.
struct FailureDetails {
  std::string command;  ///< the command line, as it was run
  std::string output;   ///< what it wrote to standard output, the end of it when it is long
  std::string errors;   ///< the same for standard error

  friend bool operator==(const FailureDetails&, const FailureDetails&) = default;
};

}  // namespace swarmsmith
