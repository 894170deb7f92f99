#include "irace_core/internal/postselection.h"

#include <algorithm>
#include <numeric>

#include "base/assert.h"

namespace swarmsmith::irace {
namespace {

/// Limit on the candidates that need runs (irace facts, 14); irace tries all subsets of this many.
constexpr std::size_t kMostConsidered = 16;

std::int64_t sum_of_smallest(std::span<const std::int64_t> needs, std::size_t count) {
  std::vector<std::int64_t> sorted(needs.begin(), needs.end());
  std::sort(sorted.begin(), sorted.end());
  return std::accumulate(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count),
                         std::int64_t{0});
}

}  // namespace

std::vector<std::size_t> largest_set_that_fits(std::span<const std::int64_t> needs,
                                               std::int64_t budget) {
  // The largest size that fits is the size at which the cheapest ones fit.
  std::size_t size = needs.size();
  while (size > 0 && sum_of_smallest(needs, size) > budget)
    --size;
  // Greedily in order: each position is taken if the cheapest completion after it still fits.
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < needs.size() && chosen.size() < size; ++i) {
    const std::size_t open = size - chosen.size() - 1;
    const auto behind = needs.subspan(i + 1);
    if (behind.size() < open || needs[i] + sum_of_smallest(behind, open) > budget) continue;
    chosen.push_back(i);
    budget -= needs[i];
  }
  SWARMSMITH_ASSERT(chosen.size() == size, "the set can be completed within the budget");
  return chosen;
}

std::vector<std::size_t> choose_for_postselection(
    std::span<const PostselectionCandidate> candidates, std::int64_t remaining, std::int64_t step) {
  std::vector<std::size_t> complete;
  std::vector<std::size_t> considered;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].missing > remaining) continue;
    if (candidates[i].missing == 0) complete.push_back(i);
    const bool asks = step > 0 || candidates[i].missing > 0;
    if (asks && considered.size() < kMostConsidered) considered.push_back(i);
  }
  if (step > 0) {  // 14.1: new pairs are available
    const auto q = static_cast<std::size_t>(remaining / step);
    if (q > 1 && complete.size() >= q) {
      complete.resize(q);
      return complete;
    }
  }
  std::vector<std::int64_t> needs;
  needs.reserve(considered.size());
  for (const std::size_t i : considered)
    needs.push_back(candidates[i].missing + step);
  // In 14.2, candidates that miss no pair cost nothing.
  std::vector<std::size_t> chosen = step > 0 ? std::vector<std::size_t>{} : complete;
  for (const std::size_t i : largest_set_that_fits(needs, remaining))
    chosen.push_back(considered[i]);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace swarmsmith::irace
