#include "base/log_limiter.h"

namespace swarmsmith {
namespace {

constexpr Duration kSecond = std::chrono::seconds(1);

}  // namespace

bool LogLimiter::admit(std::string_view event, TimePoint now) {
  auto at = seconds_.find(event);
  if (at == seconds_.end()) at = seconds_.emplace(event, Second{.begin = now}).first;
  Second& second = at->second;
  if (now - second.begin >= kSecond) {
    second.begin = now;
    second.written = 0;
  }
  if (second.written < kMostASecond) {
    ++second.written;
    return true;
  }
  ++second.left_out;
  return false;
}

std::vector<LogLimiter::LeftOut> LogLimiter::take_left_out(TimePoint now, bool all) {
  std::vector<LeftOut> taken;
  for (auto at = seconds_.begin(); at != seconds_.end();) {
    Second& second = at->second;
    const bool over = now - second.begin >= kSecond;
    if ((over || all) && second.left_out > 0) {
      taken.push_back({at->first, second.left_out});
      second.left_out = 0;
    }
    // There are few names of events at a time, but not always the same ones.
    at = over ? seconds_.erase(at) : std::next(at);
  }
  return taken;
}

}  // namespace swarmsmith
