#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "coordinator/campaign/campaign.h"
#include "irace_core/scenario.h"

namespace swarmsmith {

/// Whether any method races: for other searches, [race] has no meaning except the budget.
bool has_races(const Campaign& campaign);

/// The keys of [race] whose values are numbers in the scenario: a single list, so that reading,
/// writing and the digest use the same keys. Names are irace's names in snake_case.

struct IntegerOption {
  std::string_view key;
  std::int64_t Scenario::*member;
  std::int64_t least;
};

inline constexpr std::int64_t kLargestOption = 1'000'000'000'000;

inline constexpr std::array<IntegerOption, 14> kIntegerOptions = {{
    {"max_experiments", &Scenario::max_experiments, 1},
    {"first_test", &Scenario::first_test, 1},
    {"each_test", &Scenario::each_test, 1},
    {"block_size", &Scenario::block_size, 1},
    {"nb_iterations", &Scenario::nb_iterations, 0},
    {"min_nb_survival", &Scenario::min_nb_survival, 0},
    {"nb_configurations", &Scenario::nb_configurations, 0},
    {"nb_experiments_per_iteration", &Scenario::nb_experiments_per_iteration, 0},
    {"mu", &Scenario::mu, 1},
    {"elitist_new_instances", &Scenario::elitist_new_instances, 0},
    {"elitist_limit", &Scenario::elitist_limit, 0},
    {"max_configurations_per_race", &Scenario::max_configurations_per_race, 2},
    {"parallel", &Scenario::parallel, 0},
    {"bound_digits", &Scenario::bound_digits, 0},
}};

struct RealOption {
  std::string_view key;
  double Scenario::*member;
  double least;
  double most;
};

inline constexpr double kLargestTime = 1e15;

inline constexpr std::array<RealOption, 7> kRealOptions = {{
    {"confidence", &Scenario::confidence, 0, 1},
    {"soft_restart_threshold", &Scenario::soft_restart_threshold, 0, 1},
    {"max_time", &Scenario::max_time, 0, kLargestTime},
    {"budget_estimation", &Scenario::budget_estimation, 0, 1},
    {"min_measurable_time", &Scenario::min_measurable_time, 0, 1},
    {"bound_max", &Scenario::bound_max, 0, kLargestTime},
    {"bound_par", &Scenario::bound_par, 1, 1e6},
}};

struct FlagOption {
  std::string_view key;
  bool Scenario::*member;
};

inline constexpr std::array<FlagOption, 7> kFlagOptions = {{
    {"elitist", &Scenario::elitist},
    {"sample_instances", &Scenario::sample_instances},
    {"deterministic", &Scenario::deterministic},
    {"soft_restart", &Scenario::soft_restart},
    {"postselection", &Scenario::postselection},
    {"capping_after_first_test", &Scenario::capping_after_first_test},
    {"bound_as_timeout", &Scenario::bound_as_timeout},
}};

/// Values of enumerations by irace's names, in the order of the enumerators.
inline const std::vector<std::string> kTestTypes = {"F-test", "t-test", "t-test-bonferroni",
                                                    "t-test-holm"};
inline const std::vector<std::string> kCappingTypes = {"median", "mean", "worst", "best"};
inline const std::vector<std::string> kBoundTypes = {"candidate", "instance"};
inline const std::vector<std::string> kAblationTypes = {"full", "racing"};

}  // namespace swarmsmith
