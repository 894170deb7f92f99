#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "irace_core/search/search_parts.h"

namespace swarmsmith {

/// A single race of uniform draws (Vanilla).
struct FRaceOptions {
  static constexpr SearchWords kWords{
      .name = "f-race",
      .round = "race",
      .at_work = "racing",
      .where = "race",
      .candidate = "configuration",
      .has_tests = true,
      .no_extension =
          "f-race cannot be extended: its configurations are drawn once, and how many "
          "follows from the whole budget. Run the campaign with the larger budget into "
          "a new store"};

  /// Number of configurations in the race; automatic: budget / 20.
  std::int64_t configurations = 0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visitor) {
    visitor(SearchField{"configurations", 0, kMostRuns}, self.configurations);
  }
  std::vector<SearchFault> faults() const;
  Expected<std::unique_ptr<Search>> start_race(ParameterSpace space, const Scenario& scenario,
                                               std::vector<Configuration> initial,
                                               Repair repair) const;
  StageTexts texts(const SearchPoint& point) const;
  friend bool operator==(const FRaceOptions&, const FRaceOptions&) = default;
};

/// The scenario with the options that make a race an F-race with this number of configurations
/// (Birattari et al., GECCO 2002; docs/methods.md).
Scenario f_race_scenario(Scenario scenario, const FRaceOptions& options);

}  // namespace swarmsmith
