#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "base/expected.h"
#include "irace_core/scenario.h"

namespace swarmsmith::irace {

/// floor(2 + log2 d): default number of iterations and of survivors for d variable parameters.
std::int64_t default_count(int variable_parameters);

/// The number of configurations of a race with `budget` experiments (irace facts, 3.3), without the
/// rules for a shortage of budget.
struct RaceSizeQuestion {
  std::int64_t budget;
  std::int64_t iteration;
  std::int64_t mu;
  std::int64_t pairs_between_tests;  ///< T_e = each_test * block size
  std::int64_t elites = 0;
  std::int64_t old_pairs = 0;
  std::int64_t new_pairs = 0;
  std::int64_t most = 1024;
};
std::int64_t race_size(const RaceSizeQuestion& question);

/// The smallest budget that works (irace facts, 3.4); if it is too large for the type, the largest
/// number of the type.
struct MinimumBudgetQuestion {
  bool elitist = true;
  std::int64_t iterations;
  std::int64_t min_survival;
  std::int64_t mu;
  std::int64_t pairs_between_tests;
  std::int64_t new_pairs;
};
std::int64_t minimum_budget(const MinimumBudgetQuestion& question);

/// The next part of the run: a race ...
struct RacePlan {
  std::int64_t iteration;
  std::int64_t iterations;  ///< as planned now
  std::int64_t budget;
  std::int64_t configurations;  ///< elites included
  std::int64_t new_pairs;       ///< 0 in the first race, and without elitism
};

/// ... or the end, with the reason in words.
struct NoMoreRaces {
  std::string reason;
};

/// Plans the races of a run, one after the other (irace facts, 3.1 to 3.5).
class Schedule {
 public:
  Schedule(const Scenario& scenario, int variable_parameters);

  std::int64_t iterations() const { return iterations_; }
  std::int64_t min_survival() const { return min_survival_; }
  std::int64_t pairs_before_test() const { return pairs_before_test_; }      ///< T_f
  std::int64_t pairs_between_tests() const { return pairs_between_tests_; }  ///< T_e
  std::int64_t minimum_budget() const;
  /// max_experiments, or, if min_experiments is set, the larger of it and minimum_budget(); 0 with
  /// max_time.
  std::int64_t total_budget() const;

  /// With max_time, before the first race: plans fewer iterations and smaller races until
  /// `remaining` experiments are enough. Returns whether anything was changed; an error if not even
  /// one iteration fits.
  Expected<bool> shrink_to(std::int64_t remaining);
  /// Advice that is added to the reason when there is no first race; often empty.
  std::string advice_for_first_race(std::int64_t remaining) const;
  /// Limits the new pairs of each later race to `unused`: a deterministic run has no others.
  void limit_new_pairs(std::int64_t unused);

  /// Continues a finished run: `remaining` experiments are available now, and the races are
  /// numbered after `last_iteration` (possibly a post-selection race). A limit of iterations that
  /// the user set increases by the number of iterations that the experiments allow: one, or more
  /// with nb_experiments_per_iteration.
  void extend(std::int64_t last_iteration, std::int64_t remaining);

  /// The plan of the next race, given the remaining budget, the number of elites (before the first
  /// race, those of the time estimate) and the number of pairs used so far. A call that returns a
  /// race counts as an iteration; a call that returns the end changes nothing, so that an extension
  /// plans as if it had not been made.
  std::variant<RacePlan, NoMoreRaces> next(std::int64_t remaining, std::int64_t elites,
                                           std::int64_t old_pairs);

 private:
  std::variant<RacePlan, NoMoreRaces> plan(std::int64_t remaining, std::int64_t elites,
                                           std::int64_t old_pairs);
  std::int64_t iteration_budget(std::int64_t remaining) const;
  /// The number of configurations, elites included; at most the number of survivors if the budget
  /// is too small.
  std::int64_t race_size_for(std::int64_t budget, std::int64_t elites, std::int64_t old_pairs);
  /// Rule 3.5.7: the number of experiments that a race certainly needs.
  std::int64_t needed(std::int64_t size, std::int64_t elites) const;

  Scenario scenario_;
  std::int64_t pairs_before_test_;
  std::int64_t pairs_between_tests_;
  std::int64_t mu_;
  std::int64_t new_pairs_;  ///< a shortage of budget sets it to 0 permanently
  std::int64_t iterations_;
  std::int64_t min_survival_;
  std::int64_t iteration_ = 1;
  bool raced_ = false;
};

}  // namespace swarmsmith::irace
