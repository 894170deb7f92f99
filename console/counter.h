#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "console/output.h"

namespace swarmsmith {

/// Shows a count on the error stream if the work takes longer than two seconds: on a terminal as
/// one line that disappears at the end, otherwise as a line from time to time.
class Counter {
 public:
  /// Prints "VERB 3 of 11 NOUN". `output` must outlive the object.
  Counter(Output& output, std::string verb, std::string noun);

  /// `of` is 0 while the total is not known. The line disappears when everything is done.
  void tell(std::int64_t done, std::int64_t of);

 private:
  Output* output_;
  std::string verb_;
  std::string noun_;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace swarmsmith
