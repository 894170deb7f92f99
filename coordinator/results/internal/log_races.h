#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "coordinator/results/irace_log.h"

namespace swarmsmith {

bool is_rejected(const LogRun& run);

/// One pair in a race, and the configurations with a score on it.
struct LogStep {
  std::int64_t iteration = 0;
  std::int64_t pair = 0;
  std::int64_t evaluated = 0;
  std::vector<std::int64_t> alive;  ///< configurations, by id
};

/// The races of a log, derived from its runs and elites, because the log has no list of steps.
class LogRaces {
 public:
  using Configurations = std::vector<std::int64_t>;

  explicit LogRaces(const IraceLog& log);

  std::int64_t iterations() const { return iterations_; }
  /// The score that the configuration has on the pair at the end of the iteration.
  std::optional<double> score(std::int64_t configuration, std::int64_t pair,
                              std::int64_t iteration) const;
  /// Sorted, the best first.
  Configurations elites_of(std::int64_t iteration) const;
  /// The elites of the previous iteration and the configurations that ran in this one, by id.
  Configurations racers_of(std::int64_t iteration) const;
  /// In the order of their first runs.
  std::vector<LogStep> steps_of(std::int64_t iteration) const;

  /// Among the configurations alive in step `at`, the one with the largest mean over the race's
  /// pairs up to that step, and this mean; configuration 0 if there is none.
  std::pair<std::int64_t, double> best_of(const std::vector<LogStep>& steps, std::size_t at) const;
  /// Friedman's rank sum over the race's pairs so far, among the alive configurations: ties get
  /// their mean rank.
  double rank_sum(const std::vector<LogStep>& steps, std::size_t at,
                  std::int64_t configuration) const;

 private:
  const IraceLog& log_;
  std::int64_t iterations_ = 0;
  /// By configuration and pair: iteration and score of the first run.
  std::map<std::pair<std::int64_t, std::int64_t>, std::pair<std::int64_t, double>> scores_;
  std::map<std::int64_t, Configurations> elites_;  ///< by iteration
};

}  // namespace swarmsmith
