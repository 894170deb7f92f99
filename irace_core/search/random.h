#pragma once

#include <cstdint>
#include <memory>

#include "irace_core/search/generations.h"
#include "irace_core/search/search_parts.h"
#include "irace_core/search/strategy.h"

namespace swarmsmith {

/// Uniform draws in chunks of a thousand, all run on the same pairs; the best of them are run again
/// on further pairs, and the best mean there wins. Draw n uses the seed's stream "random" with
/// index n, so that a smaller budget tries the first of the same configurations.
struct RandomOptions {
  static constexpr SearchWords kWords{.name = "random",
                                      .round = "part",
                                      .at_work = "searching",
                                      .where = "final stage",
                                      .candidate = "configuration",
                                      .takes_repairs = true};

  std::int64_t runs = 10;  ///< of each configuration, all on the same pairs
  /// Number of best ones that are run again; automatic: budget / 1000.
  std::int64_t finalists = 0;
  std::int64_t final_runs = 100;  ///< of each finalist, on further pairs

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visitor) {
    visitor(SearchField{"runs", 1, kMostRuns}, self.runs);
    visitor(SearchField{"finalists", 0, kMostRuns}, self.finalists);
    visitor(SearchField{"final_runs", 1, kMostRuns}, self.final_runs);
  }
  /// A budget that is too small is an error, which gives the smallest that works.
  Expected<std::unique_ptr<search::Strategy>> start(search::Start from) const;
  SearchPoint planned(SearchPoint point) const;
  StageTexts texts(const SearchPoint& point) const;
  friend bool operator==(const RandomOptions&, const RandomOptions&) = default;
};

namespace search {

/// How random search uses its budget; it gives the same errors as the start of the search.
Expected<GenerationPlan> plan_random_search(std::int64_t budget, const RandomOptions& options);

/// A configuration drawn uniformly, repaired, and not forbidden; an error after 100 forbidden
/// draws.
Expected<Configuration> draw_uniform(const ParameterSpace& space, const Repair& repair, Rng& rng);

}  // namespace search
}  // namespace swarmsmith
