#include "irace_core/search/irace.h"

#include <utility>

namespace swarmsmith {

Expected<std::unique_ptr<Search>> IraceOptions::start_race(ParameterSpace space,
                                                           const Scenario& scenario,
                                                           std::vector<Configuration> initial,
                                                           Repair repair) const {
  auto race =
      IteratedRace::start(std::move(space), scenario, std::move(initial), std::move(repair));
  if (!race) return Unexpected(race.error());
  return std::make_unique<IteratedRace>(std::move(*race));
}

}  // namespace swarmsmith
