#pragma once

#include <gtest/gtest.h>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "base/rng.h"
#include "irace_core/search/start_search.h"

namespace swarmsmith {

/// `count` weights from -5 to 5 with four decimals.
inline ParameterSpace weights_space(int count, int digits = 4) {
  std::vector<Parameter> parameters;
  for (int i = 0; i < count; ++i)
    parameters.push_back(
        {"w" + std::to_string(i), "--w" + std::to_string(i) + " ", Real{-5.0, 5.0}, {}});
  return ParameterSpace::make(std::move(parameters), {}, digits).value();
}

/// A choice, and a number that only one of its values has.
inline ParameterSpace mixed_space() {
  std::vector<Parameter> parameters;
  parameters.push_back({"mode", "--mode ", Categorical{{"a", "b", "c"}}, {}});
  parameters.push_back(
      {"level", "--level ", Integer{1.0, 20.0},
       Expression::call(Operation::Equal, {Expression::parameter("mode"), Expression::text("b")})});
  parameters.push_back({"rate", "--rate ", Real{0.0, 1.0}, {}});
  return ParameterSpace::make(std::move(parameters), {}, 2).value();
}

using Cost = std::function<double(const Configuration&, const Experiment&)>;

/// Squared distance to (1, 1, ...) with noise of the pair.
inline double noisy_sphere(const Configuration& configuration, const Experiment& experiment) {
  double sum = 0;
  for (std::size_t i = 0; i < configuration.size(); ++i)
    sum += (configuration[i] - 1) * (configuration[i] - 1);
  Rng rng(static_cast<std::uint64_t>(experiment.seed * 1000 + experiment.configuration));
  return sum + rng.normal();
}

struct Played {
  std::vector<RaceEvent> events;
  std::int64_t asked = 0;
  std::vector<Elite> elites;
};

inline void play_on(Search& search, const Cost& cost, Played& played) {
  const auto take = [&] {
    for (RaceEvent& event : search.take_events())
      played.events.push_back(std::move(event));
  };
  take();
  while (!search.finished()) {
    std::vector<Measurement> costs;
    for (const Experiment& wanted : search.wanted()) {
      costs.push_back({cost(search.configuration(wanted.configuration), wanted), 0});
      ++played.asked;
    }
    ASSERT_FALSE(costs.empty()) << "a search that is not over wants something";
    search.tell(costs);
    take();
  }
  played.elites.assign(search.elites().begin(), search.elites().end());
}

inline Played play(Search& search, const Cost& cost) {
  Played played;
  play_on(search, cost, played);
  return played;
}

inline std::unique_ptr<Search> started(ParameterSpace space, SearchOptions options,
                                       std::int64_t budget, std::uint64_t seed = 1) {
  Scenario scenario;
  scenario.max_experiments = budget;
  scenario.n_instances = 1;
  scenario.seed = seed;
  auto search = start_search(std::move(space), scenario, options);
  EXPECT_TRUE(search) << to_string(search.error());
  return std::move(search.value());
}

template <class Event>
std::vector<Event> only(const std::vector<RaceEvent>& events) {
  std::vector<Event> found;
  for (const RaceEvent& event : events) {
    if (const auto* one = std::get_if<Event>(&event)) found.push_back(*one);
  }
  return found;
}

inline SearchOptions options_of(SearchKind kind) {
  return search_of(kind);
}

}  // namespace swarmsmith
