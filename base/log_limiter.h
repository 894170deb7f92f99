#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/clock.h"

namespace swarmsmith {

/// Admits a limited number of lines per event and second, and counts the others. Pure.
class LogLimiter {
 public:
  static constexpr int kMostASecond = 10;

  struct LeftOut {
    std::string event;
    std::int64_t count = 0;
  };

  /// Whether a line of this event may be written now.
  bool admit(std::string_view event, TimePoint now);
  /// The numbers of lines dropped in past seconds, each reported once; with `all` also those of the
  /// current second.
  std::vector<LeftOut> take_left_out(TimePoint now, bool all = false);

 private:
  struct Second {
    TimePoint begin;
    int written = 0;
    std::int64_t left_out = 0;
  };
  std::map<std::string, Second, std::less<>> seconds_;
};

}  // namespace swarmsmith
