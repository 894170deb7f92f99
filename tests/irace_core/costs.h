#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "base/rng.h"
#include "irace_core/iterated_race.h"

namespace swarmsmith::testing {

using Cost = std::function<double(const Configuration&, const Experiment&)>;

/// Sum over the parameters of how far each is from a hidden target, and noise that depends only on
/// configuration and seed.
inline double synthetic_cost(const Configuration& configuration, const Experiment& experiment) {
  double cost = 0;
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    if (!configuration.is_active(i)) continue;
    const double target = static_cast<double>(i % 3);
    cost += std::fabs(configuration[i] - target) / (1 + target);
  }
  Rng noise(configuration.digest() ^ static_cast<std::uint64_t>(experiment.seed));
  return cost * (0.8 + 0.4 * noise.uniform());
}

/// Answers everything until the race is over; returns all events.
inline std::vector<RaceEvent> run_to_end(IteratedRace& race, const Cost& cost) {
  std::vector<RaceEvent> events = race.take_events();
  while (!race.finished()) {
    std::vector<double> costs;
    for (const Experiment& wanted : race.wanted()) {
      costs.push_back(cost(race.configuration(wanted.configuration), wanted));
    }
    race.tell(costs);
    for (RaceEvent& event : race.take_events())
      events.push_back(std::move(event));
  }
  return events;
}

/// Costs as a race takes them.
inline std::vector<Measurement> measured(const std::vector<double>& costs) {
  std::vector<Measurement> measurements;
  for (const double cost : costs)
    measurements.push_back({cost, 0});
  return measurements;
}

/// All events of one kind.
template <class Event>
std::vector<Event> only(const std::vector<RaceEvent>& events) {
  std::vector<Event> found;
  for (const RaceEvent& event : events) {
    if (const Event* match = std::get_if<Event>(&event)) found.push_back(*match);
  }
  return found;
}

}  // namespace swarmsmith::testing
