#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include "irace_core/scenario.h"

namespace swarmsmith {

/// The keys of [race] that are a number of the scenario, so that reading, writing and the digest
/// know the same ones. Names are irace's in snake_case.

struct IntegerOption {
  std::string_view key;
  std::int64_t Scenario::*member;
  std::int64_t least;
};

inline constexpr std::int64_t kLargestOption = 1'000'000'000'000;

inline constexpr std::array<IntegerOption, 11> kIntegerOptions = {{
    {"max_experiments", &Scenario::max_experiments, 1},
    {"first_test", &Scenario::first_test, 1},
    {"each_test", &Scenario::each_test, 1},
    {"nb_iterations", &Scenario::nb_iterations, 0},
    {"min_nb_survival", &Scenario::min_nb_survival, 0},
    {"nb_configurations", &Scenario::nb_configurations, 0},
    {"nb_experiments_per_iteration", &Scenario::nb_experiments_per_iteration, 0},
    {"mu", &Scenario::mu, 1},
    {"elitist_new_instances", &Scenario::elitist_new_instances, 0},
    {"elitist_limit", &Scenario::elitist_limit, 0},
    {"max_configurations_per_race", &Scenario::max_configurations_per_race, 2},
}};

struct RealOption {
  std::string_view key;
  double Scenario::*member;
};

/// All within [0, 1].
inline constexpr std::array<RealOption, 2> kRealOptions = {{
    {"confidence", &Scenario::confidence},
    {"soft_restart_threshold", &Scenario::soft_restart_threshold},
}};

struct FlagOption {
  std::string_view key;
  bool Scenario::*member;
};

inline constexpr std::array<FlagOption, 2> kFlagOptions = {{
    {"sample_instances", &Scenario::sample_instances},
    {"soft_restart", &Scenario::soft_restart},
}};

}  // namespace swarmsmith
