#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "console/output.h"

namespace swarmsmith {

/// Shows a count on the error stream once work takes longer than two seconds: on a terminal one
/// line that disappears at the end, elsewhere a line now and then.
class Counter {
 public:
  /// Says "VERB 3 of 11 NOUN". `output` must outlive the object.
  Counter(Output& output, std::string verb, std::string noun);

  /// `of` is 0 while the total is unknown; the line disappears when all are done.
  void tell(std::int64_t done, std::int64_t of);

 private:
  Output* output_;
  std::string verb_;
  std::string noun_;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace swarmsmith
