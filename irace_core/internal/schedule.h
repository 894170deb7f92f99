#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "base/expected.h"
#include "irace_core/scenario.h"

namespace swarmsmith::irace {

/// floor(2 + log2 d): default number of iterations and of survivors for d variable parameters.
std::int64_t default_count(int variable_parameters);

/// How many configurations a race with `budget` experiments gets (irace facts, 3.3), without the
/// shortage rules.
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

/// The smallest budget that works (irace facts, 3.4); the largest number there is when it is beyond
/// that.
struct MinimumBudgetQuestion {
  bool elitist = true;
  std::int64_t iterations;
  std::int64_t min_survival;
  std::int64_t mu;
  std::int64_t pairs_between_tests;
  std::int64_t new_pairs;
};
std::int64_t minimum_budget(const MinimumBudgetQuestion& question);

/// What comes next: a race ...
struct RacePlan {
  std::int64_t iteration;
  std::int64_t iterations;  ///< as many as are planned now
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
  /// The budget that the scenario asks for, raised by its min_experiments; 0 with max_time.
  std::int64_t total_budget() const;

  /// With max_time, before the first race: plans fewer iterations and smaller races until
  /// `remaining` experiments are enough. Whether anything was changed; an error when not even one
  /// iteration fits.
  Expected<bool> shrink_to(std::int64_t remaining);
  /// What to do when there is no first race, behind the reason; often nothing.
  std::string advice_for_first_race(std::int64_t remaining) const;
  /// No more than so many new pairs in a race from now on: a deterministic run has no others.
  void limit_new_pairs(std::int64_t unused);

  /// After the end: `remaining` experiments are there now, and races after number `last_iteration`
  /// (of a post-selection, perhaps). A limit of iterations that was set rises by as many as they
  /// are for: one, or what nb_experiments_per_iteration makes of them.
  void extend(std::int64_t last_iteration, std::int64_t remaining);

  /// The plan of the next race, given the remaining budget and what was made so far: the elites
  /// (before the first race those of the time estimate), and how many pairs were seen. Each call
  /// that returns a race counts as an iteration; one that returns the end leaves no trace (an
  /// extension plans as if it had not been made).
  std::variant<RacePlan, NoMoreRaces> next(std::int64_t remaining, std::int64_t elites,
                                           std::int64_t old_pairs);

 private:
  std::variant<RacePlan, NoMoreRaces> plan(std::int64_t remaining, std::int64_t elites,
                                           std::int64_t old_pairs);
  std::int64_t iteration_budget(std::int64_t remaining) const;
  /// How many configurations, elites included; fewer than those that survive for too few.
  std::int64_t race_size_for(std::int64_t budget, std::int64_t elites, std::int64_t old_pairs);
  /// Rule 3.5.7: what a race certainly needs.
  std::int64_t needed(std::int64_t size, std::int64_t elites) const;

  Scenario scenario_;
  std::int64_t pairs_before_test_;
  std::int64_t pairs_between_tests_;
  std::int64_t mu_;
  std::int64_t new_pairs_;  ///< a shortage sets it to 0 for good
  std::int64_t iterations_;
  std::int64_t min_survival_;
  std::int64_t iteration_ = 1;
  bool raced_ = false;
};

}  // namespace swarmsmith::irace
