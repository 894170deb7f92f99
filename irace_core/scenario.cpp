#include "irace_core/scenario.h"

#include <algorithm>
#include <span>
#include <string>

#include "irace_core/expression.h"
#include "irace_core/internal/capping.h"

namespace swarmsmith {
namespace {

struct Range {
  const char* option;
  double value;
  double least;
  double most;
};

constexpr double kMost = 2147483647;  // irace's numbers have 32 bits
constexpr double kMany = 1e6;         // for numbers that are multiplied with each other

Expected<void> check_ranges(std::span<const Range> ranges) {
  for (const Range& range : ranges) {
    if (range.value >= range.least && range.value <= range.most) continue;
    // The negated comparison is also true for NaN.
    const bool too_little = !(range.value >= range.least);
    return bad_input("must be " + exact_text(too_little ? range.least : range.most) +
                         (too_little ? " or more" : " or less") + ", and is " +
                         exact_text(range.value),
                     range.option);
  }
  return {};
}

Expected<void> check_numbers(const Scenario& s) {
  const auto number = [](std::int64_t value) { return static_cast<double>(value); };
  const Range ranges[] = {
      {"max_experiments", number(s.max_experiments), 0, kMost},
      {"min_experiments", number(s.min_experiments.value_or(0)), 0, kMost},
      {"n_instances", number(s.n_instances), 1, kMost},
      {"first_test", number(s.first_test), 1, kMany},
      {"each_test", number(s.each_test), 1, kMany},
      {"block_size", number(s.block_size), 1, kMany},
      {"nb_iterations", number(s.nb_iterations), 0, kMany},
      {"min_nb_survival", number(s.min_nb_survival), 0, kMany},
      {"nb_configurations", number(s.nb_configurations), 0, kMost},
      {"nb_experiments_per_iteration", number(s.nb_experiments_per_iteration), 0, kMost},
      {"mu", number(s.mu), 0, kMost},
      {"elitist_new_instances", number(s.elitist_new_instances), 0, kMany},
      {"elitist_limit", number(s.elitist_limit), 0, kMost},
      {"max_configurations_per_race", number(s.max_configurations_per_race), 2, kMost},
      {"soft_restart_threshold", s.soft_restart_threshold, 0, 1},
      {"max_time", s.max_time, 0, 1e15},
      {"min_measurable_time", s.min_measurable_time, 0, 1},
      {"parallel", number(s.parallel), 0, kMost},
      {"bound_max", s.bound_max, 0, 1e15},
      {"bound_digits", number(s.bound_digits), 0, 15},
      {"bound_par", s.bound_par, 1, kMost},
  };
  return check_ranges(ranges);
}

Expected<void> check_budget(const Scenario& s) {
  const bool counts = s.max_experiments > 0 || s.min_experiments.value_or(0) > 0;
  if (!counts && s.max_time == 0) {
    return bad_input("must be 1 or more (or give max_time), and is 0", "max_experiments");
  }
  // irace facts, 16: exactly one of the two budgets, and a time needs elitism.
  if (s.max_time == 0) return {};
  if (counts) {
    return bad_input(
        "the budget is either a number of experiments or a time: give one of max_experiments (or "
        "min_experiments) and max_time",
        "max_time");
  }
  if (!s.elitist) return bad_input("needs elitist to be on", "max_time");
  if (!(s.budget_estimation > 0 && s.budget_estimation < 1)) {
    return bad_input("must lie between 0 and 1, and is " + exact_text(s.budget_estimation),
                     "budget_estimation");
  }
  return {};
}

Expected<void> check_blocks(const Scenario& s) {
  // irace facts, 22.
  if (s.first_test % s.each_test != 0) {
    return bad_input("must be a multiple of each_test, which is " + std::to_string(s.each_test) +
                         ", and is " + std::to_string(s.first_test),
                     "first_test");
  }
  if (s.n_instances % s.block_size != 0) {
    return bad_input("must divide the number of instances, which is " +
                         std::to_string(s.n_instances) + ", and is " + std::to_string(s.block_size),
                     "block_size");
  }
  // A smaller mu is raised to T_f (irace facts, 3.1), which consists of whole blocks.
  const std::int64_t pairs = s.first_test * s.block_size;
  if (s.mu > pairs && s.mu % s.block_size != 0) {
    return bad_input("must be a multiple of block_size, which is " + std::to_string(s.block_size) +
                         ", and is " + std::to_string(s.mu),
                     "mu");
  }
  // irace facts, 4: nothing is appended to the list of a deterministic target, so the first test
  // would never come.
  if (s.deterministic && pairs > s.n_instances) {
    return bad_input("uses each instance once, so that a first test after " +
                         std::to_string(pairs) + " needs as many instances; there are " +
                         std::to_string(s.n_instances) +
                         ": give more instances or a smaller first_test",
                     "deterministic");
  }
  return {};
}

}  // namespace

Expected<void> check(const Scenario& scenario) {
  if (auto checked = check_numbers(scenario); !checked) return checked;
  if (auto checked = check_budget(scenario); !checked) return checked;
  if (auto checked = check_blocks(scenario); !checked) return checked;
  if (!(scenario.confidence > 0 && scenario.confidence < 1)) {
    return bad_input("must lie between 0 and 1, and is " + exact_text(scenario.confidence),
                     "confidence");
  }
  // irace facts, 22. Only a demand for capping is an error: its default depends on the same
  // conditions (see uses_capping()).
  if (scenario.capping.value_or(false)) {
    if (!scenario.elitist) return bad_input("needs elitist to be on", "capping");
    if (scenario.bound_max == 0) {
      return bad_input("needs a bound_max above 0, which bounds the first runs", "capping");
    }
  }
  return {};
}

/// irace facts, 17: the default. An explicit choice has priority.
bool uses_capping(const Scenario& scenario) {
  return scenario.capping.value_or(scenario.elitist && scenario.max_time > 0 &&
                                   scenario.bound_max > 0);
}

double capped_cost(const Scenario& scenario, double bound_max, double cost, double time,
                   double bound) {
  // Races raise times in the same way before they look at bounds (irace facts, 18.2).
  return irace::capped_cost(cost, std::max(time, scenario.min_measurable_time), bound,
                            {.bound_max = bound_max,
                             .bound_digits = scenario.bound_digits,
                             .bound_par = scenario.bound_par,
                             .bound_as_timeout = scenario.bound_as_timeout,
                             .min_measurable_time = scenario.min_measurable_time});
}

/// irace facts, 10: with capping the default is the t-test.
TestType test_type_of(const Scenario& scenario) {
  return scenario.test_type.value_or(uses_capping(scenario) ? TestType::TTest : TestType::FTest);
}

}  // namespace swarmsmith
