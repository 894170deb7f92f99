#include <string>
#include <vector>

#include "coordinator/campaign/internal/race_options.h"
#include "coordinator/campaign/internal/read_method.h"

namespace swarmsmith {
namespace {

/// Options of irace that this version knows of and lacks. (Those that say how programs are called,
/// or how many at a time, have no meaning here at all.)
const std::vector<std::string> kNotYet = {"max_time",
                                          "budget_estimation",
                                          "min_measurable_time",
                                          "capping",
                                          "capping_type",
                                          "bound_type",
                                          "bound_max",
                                          "bound_digits",
                                          "bound_par",
                                          "bound_as_timeout",
                                          "postselection",
                                          "deterministic",
                                          "block_size",
                                          "test_nb_elites",
                                          "test_iteration_elites",
                                          "configurations_file",
                                          "repair_configuration"};

/// The tests that irace has, those that are here first.
const std::vector<std::string> kTests = {"F-test"};
const std::vector<std::string> kTestsNotYet = {"t-test", "t-test-holm", "t-test-bonferroni"};

/// All options that are one number or one flag.
void read_numbers(TableReader& race, Scenario& scenario) {
  for (const IntegerOption& option : kIntegerOptions) {
    const bool budget = option.member == &Scenario::max_experiments;
    const auto value =
        race.integer(option.key, {option.least, budget ? kLargestBudget : kLargestOption});
    if (value) scenario.*option.member = *value;
  }
  for (const RealOption& option : kRealOptions) {
    const auto value = race.number(option.key, {0, 1});
    if (value) scenario.*option.member = *value;
  }
  for (const FlagOption& option : kFlagOptions) {
    if (const auto value = race.boolean(option.key)) scenario.*option.member = *value;
  }
  scenario.min_experiments = race.integer("min_experiments", {1, kLargestBudget});
}

}  // namespace

void read_race(TableReader& root, Scenario& scenario, std::int64_t& digits) {
  auto race = root.table("race");
  if (!race) {
    if (!root.has("race")) {
      root.complain("race",
                    "the file has no [race]; it needs at least `max_experiments`, the "
                    "number of experiments that each design may use");
    }
    return;
  }
  read_numbers(*race, scenario);
  digits = race->integer("digits", {1, 15}).value_or(digits);
  race->choice("test_type", kTests, kTestsNotYet);
  if (race->boolean("elitist") == false) {
    race->complain("elitist", "elitist = false is not there yet; races are elitist");
  }
  if (!race->has("max_experiments")) {
    race->complain("max_experiments",
                   "[race] needs `max_experiments`, the number of experiments "
                   "that each design may use");
  }
  race->finish(kNotYet);
  Scenario judged = scenario;
  if (judged.max_experiments == 0) judged.max_experiments = 1;  // was complained about above
  if (const auto checked = check(judged); !checked && race->has(checked.error().where)) {
    race->complain(checked.error().where,
                   "`" + checked.error().where + "` " + checked.error().message);
  }
}

}  // namespace swarmsmith
