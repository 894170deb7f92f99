#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "irace_core/configuration.h"

namespace swarmsmith {

/// A new configuration. Ids start at 1 and increase.
struct ConfigurationSampled {
  std::int64_t id = 0;
  std::int64_t parent = 0;     ///< the elite whose model it was drawn from; 0 for none
  std::int64_t iteration = 0;  ///< 0 for configurations that the user gave, forbidden ones included
  Configuration configuration;
};

/// A race begins; the events of the configurations sampled for it follow.
struct IterationStarted {
  std::int64_t iteration = 0;
  std::int64_t n_iterations = 0;      ///< as planned now; a limit only if the user set one
  std::int64_t remaining = 0;         ///< experiments left in the whole design
  std::int64_t budget = 0;            ///< experiments of `remaining` that this iteration may use
  std::int64_t n_configurations = 0;  ///< in the race, elites included
  std::int64_t new_pairs = 0;         ///< new pairs, which come first in the race
  std::vector<std::int64_t> elites;   ///< the elites with which the race starts, best first
  bool soft_restart = false;
  bool postselection = false;      ///< the last race; all its configurations are elites
  std::uint64_t model_digest = 0;  ///< of the models used for sampling; 0 in the first race
};

enum class EliminationReason {
  Test,       ///< worse according to the statistical test
  Rejection,  ///< an infinite cost
  Capping,    ///< slower than the elites
};

/// A configuration that was dropped from the race.
struct Elimination {
  std::int64_t configuration = 0;
  /// At the time of the drop; with t-tests the rank of its mean; 0 for a rejection.
  double rank_sum = 0;
  EliminationReason reason = EliminationReason::Test;

  friend bool operator==(const Elimination&, const Elimination&) = default;
};

/// One task of a race: one pair, on which all alive configurations without a result are run. In
/// other searches (irace_core/search.h): a part of a round, with the marker x; `pair` is its last
/// pair.
struct RaceStep {
  std::int64_t iteration = 0;
  std::int64_t task = 0;  ///< from 1 in each race
  std::int64_t pair = 0;
  /// 'x' no test, '=' none dropped, '-' some dropped, '!' only protected elites would have been
  /// dropped, 'c' some dropped by capping alone, '.' no run was needed, ':' only elites had to be
  /// run (with capping).
  char marker = 'x';
  std::int64_t alive_before = 0;
  std::int64_t alive_after = 0;
  std::int64_t best = 0;
  double mean_best = 0;               ///< cost, over the tasks so far
  std::int64_t experiments_used = 0;  ///< in the whole design, so far
  /// Friedman's S, Wilcoxon's V if there are two, or the largest |t|
  std::optional<double> statistic;
  std::optional<double> p_value;  ///< with t-tests the smallest one, adjusted
  std::optional<double> kendall_w;
  std::optional<double> spearman_rho;
  std::optional<double> qvar;
  /// The value from which the bounds of the task's runs are computed: the elites' time with
  /// capping, otherwise bound_max.
  std::optional<double> bound;
  /// (configuration, pair) of each run, in order; in a race they are all on `pair`.
  std::vector<std::pair<std::int64_t, std::int64_t>> evaluated;
  std::vector<Elimination> eliminations;
  std::uint64_t digest = 0;  ///< of the alive set, rank sums, statistic and generators
};

/// A survivor with which the next race starts.
struct Elite {
  double rank = 0;
  std::int64_t configuration = 0;
  double mean = 0;     ///< of the costs over all its pairs
  std::int64_t n = 0;  ///< number of pairs

  friend bool operator==(const Elite&, const Elite&) = default;
};

/// A race is over and its elites are chosen.
struct IterationEnded {
  std::int64_t iteration = 0;
  std::int64_t used = 0;
  std::int64_t remaining = 0;
  std::string reason;         ///< why the race stopped
  std::vector<Elite> elites;  ///< best first
};

/// Estimate of how many experiments fit in the remaining time (max_time; irace facts, 16). Reported
/// after each batch of the first estimate, and after each race.
struct TimeEstimated {
  std::int64_t runs = 0;       ///< experiments so far
  double used = 0;             ///< time of all experiments so far
  double mean_time = 0;        ///< of one experiment, rounded up to bound_digits
  std::int64_t remaining = 0;  ///< experiments that fit in the remaining time
  double bound_max = 0;        ///< the maximum time of a run from now on
  /// (configuration, pair) of the batch, in order; empty after races.
  std::vector<std::pair<std::int64_t, std::int64_t>> evaluated;
};

/// Something the user should know: an option was changed, a given configuration is forbidden.
struct RaceWarning {
  std::string text;
};

/// The last event of a design.
struct RaceFinished {
  std::string reason;
  std::vector<Elite> elites;  ///< best first; empty after a failure
};

using RaceEvent = std::variant<ConfigurationSampled, IterationStarted, RaceStep, IterationEnded,
                               TimeEstimated, RaceWarning, RaceFinished>;

}  // namespace swarmsmith
