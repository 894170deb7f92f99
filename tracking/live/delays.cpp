#include "tracking/live/delays.h"

#include <algorithm>
#include <cmath>

namespace swarmsmith {
namespace {

constexpr double kSteps = 1000;  ///< number of steps per factor of e
constexpr double kLeast_s = 1e-6;
constexpr std::size_t kLatest = 100;

}  // namespace

void LiveDelays::add(double delay_s) {
  latest_.push_back(delay_s);
  if (latest_.size() > kLatest) latest_.pop_front();
  ++counts_[std::llround(kSteps * std::log(std::max(delay_s, kLeast_s)))];
  ++all_;
}

double LiveDelays::latest_most_s() const {
  return latest_.empty() ? 0 : *std::ranges::max_element(latest_);
}

double LiveDelays::quantile_s(double share) const {
  auto left = static_cast<std::int64_t>(share * static_cast<double>(all_ - 1));
  for (const auto& [steps, count] : counts_) {
    left -= count;
    if (left < 0) return std::exp(static_cast<double>(steps) / kSteps);
  }
  return 0;
}

}  // namespace swarmsmith
