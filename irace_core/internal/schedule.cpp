#include "irace_core/internal/schedule.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "base/assert.h"
#include "base/plain_text.h"

namespace swarmsmith::irace {

std::int64_t default_count(int variable_parameters) {
  SWARMSMITH_ASSERT(variable_parameters >= 1, "something varies");
  // floor(log2 d) is the position of the highest bit.
  return 1 + static_cast<std::int64_t>(std::bit_width(static_cast<unsigned>(variable_parameters)));
}

/// The formula of Lopez-Ibanez et al. (2016), budget / (mu + T_e * min(5, iteration)): later races
/// have fewer configurations and run each of them on more pairs. irace facts, 3.3, has two more
/// terms, for elites.
std::int64_t race_size(const RaceSizeQuestion& q) {
  const std::int64_t te = q.pairs_between_tests;
  SWARMSMITH_ASSERT(te >= 1, "the interval between tests is at least 1");
  // A new configuration must be run on all new and past pairs before it can beat an elite (irace
  // facts, 9.4), up to the next test.
  const std::int64_t pairs = (q.old_pairs + q.new_pairs + te - 1) / te * te;
  const std::int64_t cost = std::max(q.mu + te * std::min<std::int64_t>(5, q.iteration), pairs);
  SWARMSMITH_ASSERT(cost > 0, "a configuration costs experiments");
  // `elites * old_pairs`: the runs that elites do not need again. This is too large if an elite
  // misses a pair, but schedules of R's irace depend on it (irace facts, 25.6).
  return std::min(q.most, (q.budget + q.elites * q.old_pairs) / cost);
}

/// irace facts, 3.4: each iteration can race one configuration more than survive.
std::int64_t minimum_budget(const MinimumBudgetQuestion& q) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  const std::int64_t te = q.pairs_between_tests;
  const std::int64_t step = std::max(te, q.new_pairs);
  std::int64_t each = q.mu + 5 * te;
  if (q.elitist) {
    each = q.iterations > 5 ? q.mu + te + (q.iterations - 5) * q.new_pairs + 5 * step
                            : q.mu + te + (q.iterations - 1) * step;
  }
  SWARMSMITH_ASSERT(each > 0, "a configuration costs experiments");
  const std::int64_t base = (q.min_survival + 1) * q.iterations;
  // The product of large options could overflow.
  return base > kMost / each ? kMost : base * each;
}

/// irace facts, 3.1.
Schedule::Schedule(const Scenario& scenario, int variable_parameters)
    : scenario_(scenario),
      pairs_before_test_(scenario.first_test * scenario.block_size),
      pairs_between_tests_(scenario.each_test * scenario.block_size),
      mu_(std::max(scenario.mu, pairs_before_test_)),
      new_pairs_(scenario.elitist ? scenario.elitist_new_instances * scenario.block_size : 0),
      iterations_(scenario.nb_iterations > 0 ? scenario.nb_iterations
                                             : default_count(variable_parameters)),
      min_survival_(scenario.min_nb_survival > 0 ? scenario.min_nb_survival
                                                 : default_count(variable_parameters)) {}

std::int64_t Schedule::minimum_budget() const {
  return irace::minimum_budget({.elitist = scenario_.elitist,
                                .iterations = iterations_,
                                .min_survival = min_survival_,
                                .mu = mu_,
                                .pairs_between_tests = pairs_between_tests_,
                                .new_pairs = new_pairs_});
}

/// irace facts, 3.4, `minExperiments`.
std::int64_t Schedule::total_budget() const {
  if (scenario_.max_time > 0) return 0;
  if (!scenario_.min_experiments) return scenario_.max_experiments;
  return std::max(*scenario_.min_experiments, minimum_budget());
}

/// irace facts, 3.4, the rule for `maxTime`.
Expected<bool> Schedule::shrink_to(std::int64_t remaining) {
  bool changed = false;
  for (; minimum_budget() > remaining; changed = true) {
    if (iterations_ == 1) {
      return bad_input("the remaining time is enough for about " +
                           counted(remaining, "experiment") +
                           ", and a single iteration needs at least " +
                           std::to_string(minimum_budget()) + ": give more time",
                       "max_time");
    }
    --iterations_;
    const std::int64_t few = 2 * min_survival_;
    scenario_.nb_configurations =
        scenario_.nb_configurations > 0 ? std::min(few, scenario_.nb_configurations) : few;
  }
  return changed;
}

std::string Schedule::advice_for_first_race(std::int64_t remaining) const {
  const std::int64_t wanted = scenario_.nb_configurations;
  // plan() leaves the budget to later iterations until the number fits. Their shares are larger,
  // and so are their costs of a configuration: any of them may allow most.
  std::int64_t most = 0;
  Schedule later = *this;
  for (; later.iteration_ <= later.iterations_; ++later.iteration_) {
    most = std::max(most, later.race_size_for(later.iteration_budget(remaining), 0, 0));
    if (scenario_.nb_experiments_per_iteration > 0) break;  // each has the same budget
  }
  if (wanted <= most) return {};
  return " (nb_configurations is " + std::to_string(wanted) + ", and " + std::to_string(remaining) +
         " experiments allow " + std::to_string(most) +
         "): give a larger budget, or ask for fewer configurations";
}

void Schedule::limit_new_pairs(std::int64_t unused) {
  new_pairs_ = std::min(new_pairs_, std::max<std::int64_t>(0, unused));
}

/// irace facts, 3.2: an equal share for each iteration that is still planned, so what one race
/// leaves is shared by the later ones.
std::int64_t Schedule::iteration_budget(std::int64_t remaining) const {
  if (scenario_.nb_experiments_per_iteration > 0) return scenario_.nb_experiments_per_iteration;
  SWARMSMITH_ASSERT(iteration_ <= iterations_, "the current iteration is one of those planned");
  return remaining / (iterations_ - iteration_ + 1);
}

std::int64_t Schedule::race_size_for(std::int64_t budget, std::int64_t elites,
                                     std::int64_t old_pairs) {
  // irace facts, 3.3: the first race and races without elitism have no terms for elites. This also
  // holds for the elites of an estimate of max_time.
  const bool keeps = raced_ && scenario_.elitist;
  RaceSizeQuestion question{.budget = budget,
                            .iteration = iteration_,
                            .mu = mu_,
                            .pairs_between_tests = pairs_between_tests_,
                            .elites = keeps ? elites : 0,
                            .old_pairs = keeps ? old_pairs : 0,
                            .new_pairs = keeps ? new_pairs_ : 0,
                            .most = scenario_.max_configurations_per_race};
  std::int64_t size = race_size(question);
  if (size > min_survival_ || !scenario_.elitist) return size;
  // irace facts, 3.3.1: the experiments for new pairs are used for configurations, in the rest of
  // the run.
  new_pairs_ = 0;
  question.new_pairs = 0;
  size = race_size(question);
  if (size > min_survival_) return size;
  // 3.3.2: the smallest possible race in which at least one test is possible.
  question.iteration = 1;
  question.mu = 1;
  return race_size(question);
}

std::int64_t Schedule::needed(std::int64_t size, std::int64_t elites) const {
  if (!scenario_.elitist) return size * mu_;
  // Elites have results on the past pairs, so they need runs only on the new ones.
  const std::int64_t known = std::min(elites, size);
  return (size - known) * mu_ + known * std::min(new_pairs_, mu_);
}

void Schedule::extend(std::int64_t last_iteration, std::int64_t remaining) {
  iteration_ = std::max(iteration_, last_iteration + 1);
  // docs/irace.md, "More budget, and an early end": a limit that the user set would stop the run at
  // once, so it is raised.
  if (scenario_.nb_iterations == 0) return;  // no limit
  const std::int64_t each = scenario_.nb_experiments_per_iteration;
  const std::int64_t further = each > 0 ? std::max<std::int64_t>(1, remaining / each) : 1;
  iterations_ = std::max(iterations_, iteration_ + further - 1);
}

std::variant<RacePlan, NoMoreRaces> Schedule::next(std::int64_t remaining, std::int64_t elites,
                                                   std::int64_t old_pairs) {
  const std::int64_t new_pairs = new_pairs_;
  const std::int64_t iteration = iteration_;
  const std::int64_t iterations = iterations_;
  auto planned = plan(remaining, elites, old_pairs);
  if (std::holds_alternative<NoMoreRaces>(planned)) {
    new_pairs_ = new_pairs;
    iteration_ = iteration;
    iterations_ = iterations;
  }
  return planned;
}

std::variant<RacePlan, NoMoreRaces> Schedule::plan(std::int64_t remaining, std::int64_t elites,
                                                   std::int64_t old_pairs) {
  for (;; ++iteration_) {
    // The rules of irace facts, 3.5, in their order; the caller applies 3.5.2.
    if (remaining <= 0) return NoMoreRaces{"budget exhausted"};
    if (iteration_ > iterations_) {
      if (scenario_.nb_iterations > 0) return NoMoreRaces{"limit of iterations"};
      // irace facts, 3.2: without a limit of the user, the whole remaining budget becomes one more
      // iteration.
      iterations_ = iteration_;
    }
    const std::int64_t budget = iteration_budget(remaining);
    std::int64_t size = race_size_for(budget, elites, old_pairs);
    if (scenario_.nb_configurations > 0) {
      // irace facts, 3.3: a smaller number is used. A larger one waits for a later iteration, whose
      // share is larger.
      if (scenario_.nb_configurations <= size) {
        size = scenario_.nb_configurations;
      } else if (budget < remaining && scenario_.nb_experiments_per_iteration == 0) {
        continue;  // leave the budget to the next iteration
      } else {
        return NoMoreRaces{"not enough budget for the number of configurations asked for"};
      }
    }
    // Rules 3.5.5 to 3.5.7: a race must be able to drop a configuration, to try a new one, and to
    // reach its first test.
    if (size <= min_survival_) {
      return NoMoreRaces{
          "not enough budget to race more than the minimum number of configurations"};
    }
    if (raced_ && size <= elites) return NoMoreRaces{"not enough budget for a new configuration"};
    // With nb_experiments_per_iteration, a budget may be more than the rest, and irace spends it.
    if (needed(size, elites) > std::min(budget, remaining)) {
      return NoMoreRaces{"not enough budget for the first test of a race"};
    }
    // In the first race all pairs are new, so none comes first as a new one (irace facts, 9.1).
    const std::int64_t new_pairs = raced_ ? new_pairs_ : 0;
    raced_ = true;
    SWARMSMITH_ASSERT(iteration_ <= iterations_ && new_pairs >= 0,
                      "a race is one of those planned");
    return RacePlan{iteration_++, iterations_, budget, size, new_pairs};
  }
}

}  // namespace swarmsmith::irace
