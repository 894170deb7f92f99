#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>

#include "base/clock.h"

namespace swarmsmith {

/// The parameters of a token bucket: size of a burst, and rate per second.
struct Rate {
  double burst = 0;
  double per_second = 0;
};

/// Admits amounts that stay within a rate (a token bucket). Pure.
class RateLimit {
 public:
  explicit RateLimit(Rate rate) : rate_(rate), left_(rate.burst) {}

  bool has(double amount, TimePoint now) {
    const std::chrono::duration<double> since = now - when_;
    if (since.count() > 0) {
      left_ += since.count() * rate_.per_second;
      when_ = now;
    }
    if (left_ > rate_.burst) left_ = rate_.burst;
    return left_ >= amount;
  }
  bool take(double amount, TimePoint now) {
    if (!has(amount, now)) return false;
    left_ -= amount;
    return true;
  }
  /// Whether the bucket is full again.
  bool is_full(TimePoint now) const {
    RateLimit then = *this;
    return then.has(rate_.burst, now);
  }

 private:
  Rate rate_;
  double left_;
  TimePoint when_;
};

/// A rate limit for each of many names, which unknown peers may choose. When there are too many,
/// names without recent use are forgotten first, then all.
class RateLimits {
 public:
  explicit RateLimits(Rate rate) : rate_(rate) {}

  RateLimit& of(std::string_view name, TimePoint now) {
    if (limits_.size() >= kMostNames) {
      std::erase_if(limits_, [&](const auto& entry) { return entry.second.is_full(now); });
      if (limits_.size() >= kMostNames) limits_.clear();
    }
    return limits_.try_emplace(std::string(name), rate_).first->second;
  }

 private:
  static constexpr std::size_t kMostNames = 10'000;

  Rate rate_;
  std::unordered_map<std::string, RateLimit> limits_;
};

}  // namespace swarmsmith
