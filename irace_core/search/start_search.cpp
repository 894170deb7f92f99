#include "irace_core/search/start_search.h"

#include <algorithm>
#include <string>
#include <utility>

#include "irace_core/ablation.h"
#include "irace_core/search/cma_es.h"
#include "irace_core/search/evolution.h"
#include "irace_core/search/random_search.h"
#include "irace_core/search/search_loop.h"

namespace swarmsmith {
namespace {

/// Options of races alone.
Expected<void> check_for_races_alone(const Scenario& scenario, SearchKind kind) {
  const auto refuse = [&](const char* option) {
    return bad_input("works only with irace and f-race, not with " + std::string(name_of(kind)),
                     option);
  };
  if (scenario.max_time > 0) return refuse("max_time");
  if (uses_capping(scenario) || scenario.bound_max > 0) return refuse("bound_max");
  if (scenario.target_evaluator) return refuse("target_evaluator");
  if (scenario.deterministic) return refuse("deterministic");
  return {};
}

/// What irace plans for a configuration of a first race: until the first test, and on to the next.
std::int64_t first_test_cost(const Scenario& scenario) {
  return std::max(scenario.mu, scenario.first_test * scenario.block_size) +
         scenario.each_test * scenario.block_size;
}

std::int64_t f_race_budget(const Scenario& scenario) {
  return scenario.min_experiments.value_or(scenario.max_experiments);
}

Expected<void> check_f_race(const Scenario& scenario, const FRaceOptions& options) {
  if (auto checked = check(scenario); !checked) return checked;
  // Both need elites, which one race has not.
  if (scenario.max_time > 0)
    return bad_input("is for irace alone: the budget of f-race is max_experiments", "max_time");
  if (uses_capping(scenario))
    return bad_input("is for irace alone: f-race has no elites whose times are bounds", "capping");
  if (options.configurations == 0) return {};
  const std::int64_t budget = f_race_budget(scenario);
  const std::int64_t least = options.configurations * first_test_cost(scenario);
  if (budget >= least) return {};
  return bad_input("`configurations` is " + std::to_string(options.configurations) +
                       ", and a budget of " + std::to_string(budget) +
                       " experiments is too small for so many: it must be at least " +
                       std::to_string(least),
                   "max_experiments");
}

/// One race is all of it: a further one would draw around the best, as iterated racing does.
class FRace final : public IteratedRace {
 public:
  explicit FRace(IteratedRace race) : IteratedRace(std::move(race)) {}
  Expected<void> extend(std::int64_t) override { return Unexpected(no_extension()); }
  Expected<std::int64_t> least_extension() const override { return Unexpected(no_extension()); }

 private:
  static Error no_extension() {
    return {ErrorKind::BadInput, std::string(words_of(SearchKind::FRace).no_extension), ""};
  }
};

}  // namespace

Scenario f_race_scenario(Scenario scenario, const FRaceOptions& options) {
  constexpr std::int64_t kShare = 20;
  constexpr std::int64_t kLeast = 2;
  const std::int64_t budget = f_race_budget(scenario);
  const std::int64_t most = std::max(kLeast, budget / first_test_cost(scenario));
  scenario.nb_iterations = 1;
  scenario.nb_configurations = options.configurations > 0
                                   ? options.configurations
                                   : std::clamp(budget / kShare, kLeast, most);
  scenario.max_configurations_per_race =
      std::max(scenario.max_configurations_per_race, scenario.nb_configurations);
  scenario.elitist = false;
  scenario.elitist_limit = 0;
  scenario.soft_restart = false;
  scenario.postselection = false;
  scenario.min_nb_survival = 1;
  return scenario;
}

Expected<std::unique_ptr<Search>> start_search(ParameterSpace space, const Scenario& scenario,
                                               const SearchOptions& options,
                                               std::vector<Configuration> initial, Repair repair,
                                               std::optional<search::Neighbourhood> neighbourhood) {
  if (scenario.ablation) return start_ablation(std::move(space), scenario, initial);
  if (options.kind == SearchKind::Irace || options.kind == SearchKind::FRace) {
    const bool is_one = options.kind == SearchKind::FRace;
    if (is_one) {
      if (auto checked = check_f_race(scenario, options.f_race); !checked)
        return Unexpected(checked.error());
    }
    auto race = IteratedRace::start(std::move(space),
                                    is_one ? f_race_scenario(scenario, options.f_race) : scenario,
                                    std::move(initial), std::move(repair));
    if (!race) return Unexpected(race.error());
    if (is_one) return std::make_unique<FRace>(std::move(*race));
    return std::make_unique<IteratedRace>(std::move(*race));
  }
  if (auto checked = check(scenario); !checked) return Unexpected(checked.error());
  if (auto checked = check_for_races_alone(scenario, options.kind); !checked)
    return Unexpected(checked.error());
  if (repair && options.kind != SearchKind::Random) {
    return bad_input("is for irace, f-race and random: the search " +
                         std::string(name_of(options.kind)) +
                         " goes on from what it made itself, not from what was repaired",
                     "repair_configuration");
  }
  for (const Configuration& given : initial) {
    if (auto checked = space.check(given); !checked) return Unexpected(checked.error());
  }
  std::erase_if(initial, [&](const Configuration& given) { return space.is_forbidden(given); });
  // Strategies point to it.
  auto shared = std::make_unique<ParameterSpace>(std::move(space));
  Expected<std::unique_ptr<search::Strategy>> strategy =
      bad_input("is no search that is made of rounds");
  switch (options.kind) {
    case SearchKind::Random:
      strategy = search::make_random_search(*shared, scenario, options.random, std::move(initial),
                                            std::move(repair));
      break;
    case SearchKind::Evolution:
      strategy = search::make_evolution(*shared, scenario, options.evolution, std::move(initial));
      break;
    case SearchKind::CmaEs:
      strategy = search::make_cma_es(*shared, scenario, options.cma_es, initial);
      break;
    case SearchKind::Annealing: {
      if (!neighbourhood) {
        Rng rng = Rng(scenario.seed).split("start");
        auto start = initial.empty() ? search::draw_uniform(*shared, {}, rng)
                                     : Expected<Configuration>(initial.front());
        if (!start) return Unexpected(start.error());
        neighbourhood = search::one_parameter_neighbourhood(*shared, std::move(*start));
      }
      strategy =
          search::make_annealing(*shared, scenario, options.annealing, std::move(*neighbourhood));
      break;
    }
    case SearchKind::Irace:
    case SearchKind::FRace:
      break;
  }
  if (!strategy) return Unexpected(strategy.error());
  return search::SearchLoop::start(std::move(shared), scenario, std::move(*strategy));
}

}  // namespace swarmsmith
