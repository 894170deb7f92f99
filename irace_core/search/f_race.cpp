#include "irace_core/search/f_race.h"

#include <algorithm>
#include <string>
#include <utility>

#include "base/plain_text.h"

namespace swarmsmith {
namespace {

/// The runs that irace plans for a configuration of a first race: up to the first test, and on to
/// the next one.
std::int64_t first_test_cost(const Scenario& scenario) {
  // irace facts, 3.3, with i = 1 and without elites.
  return std::max(scenario.mu, scenario.first_test * scenario.block_size) +
         scenario.each_test * scenario.block_size;
}

std::int64_t f_race_budget(const Scenario& scenario) {
  return scenario.min_experiments.value_or(scenario.max_experiments);
}

Expected<void> check_f_race(const Scenario& scenario, const FRaceOptions& options) {
  if (auto checked = check(scenario); !checked) return checked;
  // Both need elites, which a single race does not have.
  if (scenario.max_time > 0)
    return bad_input("is for irace alone: the budget of f-race is max_experiments", "max_time");
  if (uses_capping(scenario))
    return bad_input("is for irace alone: f-race has no elites whose times are bounds", "capping");
  if (options.configurations == 0) return {};
  const std::int64_t budget = f_race_budget(scenario);
  const std::int64_t least = options.configurations * first_test_cost(scenario);
  if (budget >= least) return {};
  return bad_input("`configurations` is " + std::to_string(options.configurations) +
                       ", and a budget of " + counted(budget, "experiment") +
                       " is too small for so many: it must be at least " + std::to_string(least),
                   "max_experiments");
}

/// The search is a single race: a further one would sample around the best, like iterated racing.
class FRace final : public IteratedRace {
 public:
  explicit FRace(IteratedRace race) : IteratedRace(std::move(race)) {}
  Expected<void> extend(std::int64_t) override { return Unexpected(no_extension()); }
  Expected<std::int64_t> least_extension() const override { return Unexpected(no_extension()); }

 private:
  static Error no_extension() {
    return {ErrorKind::BadInput, std::string(FRaceOptions::kWords.no_extension), ""};
  }
};

}  // namespace

Scenario f_race_scenario(Scenario scenario, const FRaceOptions& options) {
  // docs/methods.md, `f-race`: no public program has the number of the paper. With a twentieth of
  // the budget, the first five tasks use a quarter of it.
  constexpr std::int64_t kShare = 20;
  constexpr std::int64_t kLeast = 2;
  const std::int64_t budget = f_race_budget(scenario);
  // More could not be run up to the first test and the next one.
  const std::int64_t most = std::max(kLeast, budget / first_test_cost(scenario));
  // One iteration of irace without elites is an F-race: it ends with one survivor or with its
  // budget. R's irace takes the same steps with these options (docs/methods.md).
  scenario.nb_iterations = 1;
  scenario.nb_configurations = options.configurations > 0
                                   ? options.configurations
                                   : std::clamp(budget / kShare, kLeast, most);
  // irace's limit of 1024 configurations (irace facts, 3.3) would cut the race of a large budget.
  scenario.max_configurations_per_race =
      std::max(scenario.max_configurations_per_race, scenario.nb_configurations);
  scenario.elitist = false;
  scenario.elitist_limit = 0;
  scenario.soft_restart = false;
  scenario.postselection = false;
  scenario.min_nb_survival = 1;
  return scenario;
}

std::vector<SearchFault> FRaceOptions::faults() const {
  // A race of one configuration has nothing to compare.
  if (configurations != 1) return {};
  return {{{"configurations"}, "`configurations` must be 0 (automatic) or at least 2, not 1"}};
}

Expected<std::unique_ptr<Search>> FRaceOptions::start_race(ParameterSpace space,
                                                           const Scenario& scenario,
                                                           std::vector<Configuration> initial,
                                                           Repair repair) const {
  if (auto checked = check_f_race(scenario, *this); !checked) return Unexpected(checked.error());
  auto race = IteratedRace::start(std::move(space), f_race_scenario(scenario, *this),
                                  std::move(initial), std::move(repair));
  if (!race) return Unexpected(race.error());
  return std::make_unique<FRace>(std::move(*race));
}

StageTexts FRaceOptions::texts(const SearchPoint& point) const {
  StageTexts texts = usual_texts(kWords, point, "one race");
  texts.stage = texts.name + (point.alive > 0 ? ": " + std::to_string(point.alive) + " left" : "");
  return texts;
}

}  // namespace swarmsmith
