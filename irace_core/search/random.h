#pragma once

#include <cstdint>
#include <memory>

#include "irace_core/search/generations.h"
#include "irace_core/search/search_parts.h"
#include "irace_core/search/strategy.h"

namespace swarmsmith {

/// Uniform draws in chunks of a thousand, all run on the same pairs; the best of all are run again
/// on further pairs, and the best mean there wins. Draw n is from the stream "random" of the seed
/// with index n, so that a smaller budget tries a prefix.
struct RandomOptions {
  static constexpr SearchWords kWords{.name = "random",
                                      .round = "part",
                                      .at_work = "searching",
                                      .where = "final stage",
                                      .candidate = "configuration",
                                      .takes_repairs = true};

  std::int64_t runs = 10;         ///< of each configuration, all on the same pairs
  std::int64_t finalists = 0;     ///< the best, which are run again; automatic: budget / 1000
  std::int64_t final_runs = 100;  ///< of each finalist, on further pairs

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visitor) {
    visitor(SearchField{"runs", 1, kMostRuns}, self.runs);
    visitor(SearchField{"finalists", 0, kMostRuns}, self.finalists);
    visitor(SearchField{"final_runs", 1, kMostRuns}, self.final_runs);
  }
  /// Errors: a budget that is too small, with the least that works.
  Expected<std::unique_ptr<search::Strategy>> start(search::Start from) const;
  SearchPoint planned(SearchPoint point) const;
  StageTexts texts(const SearchPoint& point) const;
  friend bool operator==(const RandomOptions&, const RandomOptions&) = default;
};

namespace search {

/// How random search spends its budget; the errors are those of its start.
Expected<GenerationPlan> plan_random_search(std::int64_t budget, const RandomOptions& options);

/// A configuration drawn uniformly, repaired, and not forbidden; an error after 100 draws in vain.
Expected<Configuration> draw_uniform(const ParameterSpace& space, const Repair& repair, Rng& rng);

}  // namespace search
}  // namespace swarmsmith
