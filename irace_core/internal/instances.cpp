#include "irace_core/internal/instances.h"

#include <numeric>

#include "base/assert.h"

namespace swarmsmith::irace {

InstanceLog::InstanceLog(const Scenario& scenario, Rng rng)
    : instances_(scenario.n_instances),
      block_size_(scenario.block_size),
      shuffle_(scenario.sample_instances),
      deterministic_(scenario.deterministic),
      rng_(rng) {}

void InstanceLog::append(std::int64_t pairs) {
  constexpr std::int64_t kLargestSeed = 2147483647;
  SWARMSMITH_ASSERT(instances_ >= 1 && instances_ % block_size_ == 0,
                    "a scenario's instances are whole blocks");
  if (deterministic_ && !pairs_.empty()) return;
  const std::int64_t repetitions = deterministic_ ? 1 : (pairs + instances_ - 1) / instances_;
  std::vector<std::int64_t> blocks(static_cast<std::size_t>(instances_ / block_size_));
  for (std::int64_t i = 0; i < repetitions; ++i) {
    std::iota(blocks.begin(), blocks.end(), std::int64_t{0});
    if (shuffle_) rng_.shuffle(std::span(blocks));
    for (const std::int64_t block : blocks) {
      for (std::int64_t k = 1; k <= block_size_; ++k) {
        pairs_.push_back({block * block_size_ + k, rng_.uniform_int(1, kLargestSeed)});
      }
    }
  }
}

void InstanceLog::extend_to(std::int64_t pairs) {
  if (size() < pairs) append(pairs - size());
}

}  // namespace swarmsmith::irace
