#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "irace_core/configuration.h"

namespace swarmsmith {

/// A configuration that was made. Ids start at 1 and grow.
struct ConfigurationSampled {
  std::int64_t id = 0;
  std::int64_t parent = 0;     ///< the elite whose model it was drawn from; 0 for none
  std::int64_t iteration = 0;  ///< 0 for those that were given, forbidden ones included
  Configuration configuration;
};

/// A race begins; the configurations that it sampled follow.
struct IterationStarted {
  std::int64_t iteration = 0;
  std::int64_t n_iterations = 0;      ///< as planned now; not a limit unless it was asked for
  std::int64_t remaining = 0;         ///< experiments of the whole design that are left
  std::int64_t budget = 0;            ///< of them for this iteration
  std::int64_t n_configurations = 0;  ///< in the race, elites included
  std::int64_t new_pairs = 0;         ///< pairs that come first since they are new
  std::vector<std::int64_t> elites;   ///< that the race starts with, best first
  bool soft_restart = false;
  bool postselection = false;      ///< the last race; all who take part are its elites
  std::uint64_t model_digest = 0;  ///< of the models that were sampled from; 0 in the first race
};

enum class EliminationReason {
  Test,       ///< worse by the statistical test
  Rejection,  ///< an infinite cost
  Capping,    ///< slower than the elites
};

/// A configuration that left the race.
struct Elimination {
  std::int64_t configuration = 0;
  double rank_sum = 0;  ///< when it was dropped; by t-tests the rank of its mean; 0: a rejection
  EliminationReason reason = EliminationReason::Test;

  friend bool operator==(const Elimination&, const Elimination&) = default;
};

/// One task of a race: one pair, tried by all who are alive and have not seen it. Of other searches
/// (irace_core/search.h) a part of a round, with the marker x; `pair` is the last one of it.
struct RaceStep {
  std::int64_t iteration = 0;
  std::int64_t task = 0;  ///< from 1 in each race
  std::int64_t pair = 0;
  /// x no test, = none dropped, - some dropped, ! only protected elites would have been, c
  /// capping alone dropped some, . none had to be run, : only elites had to be (capping)
  char marker = 'x';
  std::int64_t alive_before = 0;
  std::int64_t alive_after = 0;
  std::int64_t best = 0;
  double mean_best = 0;               ///< cost over the tasks so far
  std::int64_t experiments_used = 0;  ///< in the whole design so far
  std::optional<double> statistic;    ///< Friedman's S, Wilcoxon's V for two, or the largest |t|
  std::optional<double> p_value;      ///< of t-tests the smallest, adjusted
  std::optional<double> kendall_w;
  std::optional<double> spearman_rho;
  std::optional<double> qvar;
  /// Where the bounds of the task's runs come from: the elites' time when capping, or bound_max.
  std::optional<double> bound;
  /// (configuration, pair) of what was run, in order; those of a race are all on `pair`.
  std::vector<std::pair<std::int64_t, std::int64_t>> evaluated;
  std::vector<Elimination> eliminations;
  std::uint64_t digest = 0;  ///< of alive set, rank sums, statistic and generators
};

/// A survivor that the next race starts with.
struct Elite {
  double rank = 0;
  std::int64_t configuration = 0;
  double mean = 0;     ///< cost over all its pairs
  std::int64_t n = 0;  ///< how many pairs

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

/// How many experiments the time that is left is good for (max_time; irace facts, 16): after each
/// batch of the first estimate, and after each race.
struct TimeEstimated {
  std::int64_t runs = 0;       ///< experiments so far
  double used = 0;             ///< their time
  double mean_time = 0;        ///< of an experiment, rounded up to bound_digits
  std::int64_t remaining = 0;  ///< experiments
  double bound_max = 0;        ///< from here on
  /// (configuration, pair) of the batch, in order; empty after races.
  std::vector<std::pair<std::int64_t, std::int64_t>> evaluated;
};

/// Something that a person should know: an option was changed, a given configuration is forbidden.
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
