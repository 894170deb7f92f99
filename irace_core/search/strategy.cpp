#include "irace_core/search/strategy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/assert.h"
#include "base/plain_text.h"

namespace swarmsmith::search {

std::vector<Scored> ranked(std::span<const std::pair<std::int64_t, std::int64_t>> runs,
                           std::span<const double> costs) {
  SWARMSMITH_ASSERT(runs.size() == costs.size(), "there is a cost for each run");
  std::map<std::int64_t, Scored> by_id;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Scored& scored = by_id[runs[i].first];
    scored.id = runs[i].first;
    scored.mean += costs[i];  // a sum until all costs are added, always in the order of the pairs
    ++scored.runs;
  }
  std::vector<Scored> all;
  all.reserve(by_id.size());
  for (auto& [id, scored] : by_id) {
    scored.mean /= static_cast<double>(scored.runs);
    if (!std::isfinite(scored.mean)) scored.mean = std::numeric_limits<double>::infinity();
    all.push_back(scored);
  }
  std::ranges::stable_sort(all, {}, &Scored::mean);
  return all;
}

std::vector<Elite> as_elites(std::span<const Scored> scored) {
  std::vector<Elite> elites;
  elites.reserve(scored.size());
  for (const Scored& one : scored) {
    elites.push_back({.rank = static_cast<double>(elites.size() + 1),
                      .configuration = one.id,
                      .mean = one.mean,
                      .n = one.runs});
  }
  return elites;
}

std::vector<std::pair<std::int64_t, std::int64_t>> all_on(std::span<const std::int64_t> ids,
                                                          std::int64_t first_pair,
                                                          std::int64_t pairs) {
  std::vector<std::pair<std::int64_t, std::int64_t>> runs;
  runs.reserve(ids.size() * static_cast<std::size_t>(pairs));
  std::vector<std::int64_t> sorted(ids.begin(), ids.end());
  std::ranges::sort(sorted);
  for (std::int64_t pair = first_pair; pair < first_pair + pairs; ++pair) {
    for (const std::int64_t id : sorted)
      runs.emplace_back(id, pair);
  }
  return runs;
}

Error too_small(std::int64_t budget, std::int64_t least) {
  return {ErrorKind::BadInput,
          "a budget of " + counted(budget, "experiment") +
              " is too small: with these settings it must be at least " + std::to_string(least),
          "max_experiments"};
}

}  // namespace swarmsmith::search
