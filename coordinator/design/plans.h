#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "coordinator/campaign/campaign.h"
#include "coordinator/campaign/candidate_text.h"
#include "irace_core/search/start_search.h"
#include "storage/rows.h"

namespace swarmsmith {

/// The tests of the elites after the race, outside its budget.
struct TestPlan {
  std::int64_t count = 0;  ///< pairs
  /// Pair n is test instance n; otherwise a fresh seed on a training instance, in turn.
  bool on_test_instances = false;
  std::int64_t elites = 1;       ///< number of elites of the last iteration that are tested
  bool every_iteration = false;  ///< test the same number of elites of every other iteration too
  /// Names of further profiles under which the tests are repeated; each name is a source.
  std::vector<std::string> profiles{};
};

/// One design, ready to run.
struct DesignPlan {
  DesignRow row;
  std::uint32_t mission = 0;  ///< index into the campaign's missions
  std::uint32_t method = 0;   ///< index into the campaign's methods
  ParameterSpace space;
  Scenario scenario;  ///< with the design's seed and budget
  SearchOptions search;
  /// For annealing; none if it changes one parameter at a time.
  std::optional<search::Neighbourhood> neighbourhood;
  std::function<CandidateText(const Configuration&)> describe;
  TestPlan tests;
  std::string source;                    ///< the simulator profile's name; "command" for programs
  std::vector<Configuration> initial{};  ///< the configurations with which the first race begins
  Repair repair{};                       ///< repairs sampled configurations; empty for none
  bool only_test = false;                ///< no race: the initial configurations are tested
  /// The "cancel" and "extend" commands for this design, by number, as stored; see CommandLog.
  std::vector<CommandRow> commands{};
};

/// The plans of all designs of a campaign, sorted by id. Fails if a method's space cannot be built.
Expected<std::vector<DesignPlan>> plans_of(const Campaign& campaign);

}  // namespace swarmsmith
