#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "base/rng.h"
#include "sim/control/flavour.h"
#include "sim/control/machine.h"
#include "sim/control/machine_text.h"

namespace swarmsmith {

struct NamedDrawing {
  std::string name;
  Machine machine;
};

/// Of a table whose last column is the machine's text, in the flavour of the published program.
inline std::vector<NamedDrawing> machines_of(const std::string& table) {
  std::vector<NamedDrawing> machines;
  std::ifstream stream(SWARMSMITH_TEST_DATA "/argos/" + table);
  std::string line;
  while (std::getline(stream, line)) {
    const std::size_t at = line.find("--nstates");
    if (at == std::string::npos) continue;
    const auto machine = parse_machine(line.substr(at), watermelon_argos3());
    if (machine) machines.push_back({line.substr(0, line.find(',')), *machine});
  }
  return machines;
}

inline Condition random_condition(Rng& rng) {
  const double part = static_cast<double>(rng.uniform_int(0, 100)) / 100;
  const auto count = static_cast<int>(rng.uniform_int(1, 10));
  const double eta = static_cast<double>(rng.uniform_int(0, 2000)) / 100;
  switch (rng.uniform_int(0, 6)) {
    case 0:
      return BlackFloor{part};
    case 1:
      return GrayFloor{part};
    case 2:
      return WhiteFloor{part};
    case 3:
      return NeighbourCount{eta, count};
    case 4:
      return InvertedNeighbourCount{eta, count};
    case 5:
      return FixedProbability{part};
    default:
      return ColorDetection{part, static_cast<ColorLabel>(rng.uniform_int(0, 3))};
  }
}

inline Behaviour random_behaviour(Rng& rng) {
  const double alpha = static_cast<double>(rng.uniform_int(100, 500)) / 100;
  switch (rng.uniform_int(0, 3)) {
    case 0:
      return Exploration{static_cast<int>(rng.uniform_int(1, 100))};
    case 1:
      return Stop{};
    case 2:
      return Attraction{alpha};
    default:
      return Repulsion{alpha};
  }
}

/// Up to four transitions a state, as the search space has them.
inline Machine random_machine(Rng& rng, int states) {
  Machine machine;
  for (int i = 0; i < states; ++i) {
    State state{.behaviour = random_behaviour(rng), .transitions = {}};
    const auto transitions = states == 1 ? 0 : rng.uniform_int(1, watermelon().most_transitions);
    for (int j = 0; j < transitions; ++j) {
      const auto other = static_cast<int>(rng.uniform_int(0, states - 2));
      state.transitions.push_back({random_condition(rng), other < i ? other : other + 1});
    }
    machine.states.push_back(std::move(state));
  }
  return machine;
}

/// Four states with four transitions each of the longest names; `targets` has the number of the
/// other state that each goes to.
inline Machine fullest_machine(const std::vector<std::vector<int>>& targets) {
  Machine machine;
  for (const auto& row : targets) {
    State state{.behaviour = Exploration{100}, .transitions = {}};
    for (const int target : row)
      state.transitions.push_back({InvertedNeighbourCount{19.66, 10}, target});
    machine.states.push_back(std::move(state));
  }
  return machine;
}

inline std::vector<NamedDrawing> fullest_machines() {
  return {{"spread", fullest_machine({{1, 2, 3, 1}, {0, 2, 3, 2}, {0, 1, 3, 3}, {0, 1, 2, 0}})},
          {"pairs", fullest_machine({{1, 1, 1, 1}, {0, 0, 0, 0}, {3, 3, 3, 3}, {2, 2, 2, 2}})},
          {"star", fullest_machine({{1, 1, 2, 3}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}})},
          {"across", fullest_machine({{2, 2, 2, 2}, {3, 3, 3, 3}, {0, 0, 1, 3}, {1, 1, 0, 2}})}};
}

}  // namespace swarmsmith
