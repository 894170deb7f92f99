#pragma once

#include <chrono>

namespace swarmsmith {

/// Monotonic time, for leases, heartbeats and rates. Wall-clock time is only shown to users.
using TimePoint = std::chrono::time_point<std::chrono::steady_clock, std::chrono::nanoseconds>;
using Duration = std::chrono::nanoseconds;

inline Duration duration_of(double seconds) {
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
}
inline double seconds_of(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// A clock that is passed as an argument, so that tests can control it.
class Clock {
 public:
  virtual ~Clock() = default;
  virtual TimePoint now() const = 0;
};

class SystemClock final : public Clock {
 public:
  TimePoint now() const override {
    return std::chrono::time_point_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now());
  }
};

}  // namespace swarmsmith
