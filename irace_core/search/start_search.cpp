#include "irace_core/search/start_search.h"

#include <string>
#include <type_traits>
#include <utility>

#include "irace_core/ablation.h"
#include "irace_core/search/search_loop.h"

namespace swarmsmith {
namespace {

/// Checks that no option is set that only races have.
Expected<void> check_for_races_alone(const Scenario& scenario, const std::string& name) {
  const auto refuse = [&](const char* option) {
    return bad_input("works only with irace and f-race, not with " + name, option);
  };
  // Rounds have neither bounds nor calls of a targetEvaluator, and need a list of pairs that can
  // grow, which the list of a deterministic target cannot (docs/methods.md, "What does not go
  // together").
  if (scenario.max_time > 0) return refuse("max_time");
  if (uses_capping(scenario) || scenario.bound_max > 0) return refuse("bound_max");
  if (scenario.target_evaluator) return refuse("target_evaluator");
  if (scenario.deterministic) return refuse("deterministic");
  return {};
}

/// Starts a search that is not a race.
template <class Kind>
Expected<std::unique_ptr<Search>> start_rounds(const Kind& kind, ParameterSpace space,
                                               const Scenario& scenario,
                                               std::vector<Configuration> initial, Repair repair,
                                               std::optional<search::Neighbourhood> neighbourhood) {
  const std::string name(Kind::kWords.name);
  if (auto checked = check(scenario); !checked) return Unexpected(checked.error());
  if (auto checked = check_for_races_alone(scenario, name); !checked)
    return Unexpected(checked.error());
  if (repair && !Kind::kWords.takes_repairs) {
    return bad_input("is for irace, f-race and random: the search " + name +
                         " continues from what it made itself, not from what was repaired",
                     "repair_configuration");
  }
  for (const Configuration& given : initial) {
    if (auto checked = space.check(given); !checked) return Unexpected(checked.error());
  }
  // IteratedRace does this itself, with a warning; strategies get only configurations that may be
  // run.
  std::erase_if(initial, [&](const Configuration& given) { return space.is_forbidden(given); });
  // Strategies keep a pointer to the space.
  auto shared = std::make_unique<ParameterSpace>(std::move(space));
  auto strategy = kind.start({.space = *shared,
                              .scenario = scenario,
                              .initial = std::move(initial),
                              .repair = std::move(repair),
                              .neighbourhood = std::move(neighbourhood)});
  if (!strategy) return Unexpected(strategy.error());
  return search::SearchLoop::start(std::move(shared), scenario, std::move(*strategy));
}

}  // namespace

Expected<std::unique_ptr<Search>> start_search(ParameterSpace space, const Scenario& scenario,
                                               const SearchOptions& options,
                                               std::vector<Configuration> initial, Repair repair,
                                               std::optional<search::Neighbourhood> neighbourhood) {
  // An ablation takes the place of a search, whatever the options of searches say.
  if (scenario.ablation) return start_ablation(std::move(space), scenario, initial);
  return std::visit(
      [&](const auto& kind) {
        // Races make their own search; others are strategies in rounds (see search_parts.h).
        if constexpr (requires { &std::decay_t<decltype(kind)>::start_race; }) {
          return kind.start_race(std::move(space), scenario, std::move(initial), std::move(repair));
        } else {
          return start_rounds(kind, std::move(space), scenario, std::move(initial),
                              std::move(repair), std::move(neighbourhood));
        }
      },
      options);
}

}  // namespace swarmsmith
