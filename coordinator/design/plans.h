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

/// How the elites are judged after the race, outside of its budget.
struct TestPlan {
  std::int64_t count = 0;  ///< pairs
  /// Pair n is test instance n; else fresh seeds on the training instances in turn.
  bool on_test_instances = false;
  std::int64_t elites = 1;       ///< how many of the last iteration
  bool every_iteration = false;  ///< as many of each other iteration too
  /// Names of further profiles, under which the tests are run again; each is a source.
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
  /// Of annealing; none where it changes one parameter at a time.
  std::optional<search::Neighbourhood> neighbourhood;
  std::function<CandidateText(const Configuration&)> describe;
  TestPlan tests;
  std::string source;                    ///< the simulator profile's name; "command" for programs
  std::vector<Configuration> initial{};  ///< that the first race begins with
  Repair repair{};                       ///< of sampled configurations; empty for none
  bool only_test = false;                ///< no race: the initial configurations are tested
  /// "cancel" and "extend" of this design, by number, as the store has them; see CommandLog.
  std::vector<CommandRow> commands{};
};

/// The designs of a campaign, ready to run, in the order of their ids. Fails when a method's space
/// cannot be built.
Expected<std::vector<DesignPlan>> plans_of(const Campaign& campaign);

}  // namespace swarmsmith
