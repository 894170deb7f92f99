#include "irace_core/search/start_search.h"

#include <algorithm>
#include <string>
#include <utility>

#include "irace_core/search/cma_es.h"
#include "irace_core/search/evolution.h"
#include "irace_core/search/random_search.h"
#include "irace_core/search/search_loop.h"

namespace swarmsmith {
namespace {

/// Only races know of these.
Expected<void> check_for_races_alone(const Scenario& scenario, SearchKind kind) {
  const std::string search = " the search " + std::string(name_of(kind));
  const auto refuse = [&](const char* what, const char* where) {
    return bad_input(what + search + " knows nothing of it, only irace and f-race do", where);
  };
  if (scenario.max_time > 0) return refuse("is a budget of time:", "max_time");
  if (uses_capping(scenario) || scenario.bound_max > 0)
    return refuse("bounds the time of runs:", "bound_max");
  if (scenario.target_evaluator) return refuse("needs a targetEvaluator:", "target_evaluator");
  if (scenario.deterministic) return refuse("allows an instance once:", "deterministic");
  return {};
}

}  // namespace

Scenario f_race_scenario(Scenario scenario, const FRaceOptions& options) {
  constexpr std::int64_t kShare = 20;
  scenario.nb_iterations = 1;
  scenario.nb_configurations = options.configurations > 0
                                   ? options.configurations
                                   : std::max<std::int64_t>(2, scenario.max_experiments / kShare);
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
  if (options.kind == SearchKind::Irace || options.kind == SearchKind::FRace) {
    auto race = IteratedRace::start(
        std::move(space),
        options.kind == SearchKind::FRace ? f_race_scenario(scenario, options.f_race) : scenario,
        std::move(initial), std::move(repair));
    if (!race) return Unexpected(race.error());
    return std::make_unique<IteratedRace>(std::move(*race));
  }
  if (auto checked = check(scenario); !checked) return Unexpected(checked.error());
  if (auto checked = check_for_races_alone(scenario, options.kind); !checked)
    return Unexpected(checked.error());
  for (const Configuration& given : initial) {
    if (auto checked = space.check(given); !checked) return Unexpected(checked.error());
  }
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
      if (repair) return bad_input("cannot be used with the search cma-es", "repair");
      strategy = search::make_cma_es(*shared, scenario, options.cma_es, initial);
      break;
    case SearchKind::Annealing: {
      if (!neighbourhood) {
        Rng rng = Rng(scenario.seed).split("start");
        auto start = initial.empty() ? search::draw_uniform(*shared, repair, rng)
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
