#include "irace_core/internal/instances.h"

#include <numeric>

namespace swarmsmith::irace {

void InstanceLog::append(std::int64_t pairs) {
  constexpr std::int64_t kLargestSeed = 2147483647;
  const std::int64_t repetitions = (pairs + instances_ - 1) / instances_;
  std::vector<std::int64_t> order(static_cast<std::size_t>(instances_));
  for (std::int64_t i = 0; i < repetitions; ++i) {
    std::iota(order.begin(), order.end(), std::int64_t{1});
    if (shuffle_) rng_.shuffle(std::span(order));
    for (const std::int64_t instance : order) {
      pairs_.push_back({instance, rng_.uniform_int(1, kLargestSeed)});
    }
  }
}

}  // namespace swarmsmith::irace
