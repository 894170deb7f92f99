#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "console/output.h"

namespace swarmsmith::cli {

/// Counts on the error stream, once something has taken longer than people like to wait (two
/// seconds): on a terminal in one line that goes away again, elsewhere a line now and then.
class Counter {
 public:
  /// Says "VERB 3 of 11 NOUN". `output` must outlive the object.
  Counter(Output& output, std::string verb, std::string noun);

  /// `of` is 0 while nobody knows how many there are; the line goes away when all are done.
  void tell(std::int64_t done, std::int64_t of);

 private:
  Output* output_;
  std::string verb_;
  std::string noun_;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace swarmsmith::cli
