#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "coordinator/launchers/launch_options.h"
#include "irace_core/scenario.h"
#include "irace_core/search/options.h"
#include "programs/target.h"
#include "sim/control/controller.h"
#include "sim/control/flavour.h"
#include "sim/engine/profile.h"
#include "sim/files/mission_file.h"

namespace swarmsmith {

/// A mission and how its designs are judged. With a target, only the mission's name and the
/// instances for its programs matter.
struct CampaignMission : MissionEntry {
  InstanceTexts instances;

  friend bool operator==(const CampaignMission&, const CampaignMission&) = default;
};

/// A parameter's range that differs from the flavour's own.
struct RangeOverride {
  std::string module;     ///< "exploration"
  std::string parameter;  ///< "tau"
  double lower = 0;
  double upper = 0;

  friend bool operator==(const RangeOverride&, const RangeOverride&) = default;
};

/// As a baseline: a random machine from the method's space, a new one for each repetition.
inline constexpr std::string_view kRandomMachine = "random";

struct Method;
struct Campaign;
/// The number of designs of the method on each mission: the campaign's repetitions, or one for a
/// baseline with a given machine, since all repetitions would be the same.
std::int64_t repetitions_of(const Campaign& campaign, const Method& method);

/// A way to design: the modules of a flavour that may be used, and the maximum size of machines.
struct Method {
  std::string name;
  std::string flavour = "watermelon";
  const Flavour* own_flavour = nullptr;      ///< from a file, see kept_flavour; null: built in
  TurnClock turn_clock = TurnClock::Cycles;  ///< the flavour's own unless the file sets another
  std::int64_t max_states = 4;
  std::int64_t max_transitions = 4;
  std::vector<std::string> behaviours;  ///< names; by default, all of the flavour's
  std::vector<std::string> conditions;
  std::vector<RangeOverride> ranges;
  Architecture architecture = Architecture::Machine;  ///< the kind of control software
  std::int64_t max_subtrees = kMaxSubtrees;           ///< for trees
  NetworkInputs inputs = NetworkInputs::Rvr;          ///< for networks
  double most_weight = kMostWeight;                   ///< for networks
  SearchOptions search;                               ///< the search that is used
  /// Instead of a race, a machine for comparison, which is tested like the winners of races: a text
  /// of the grammar, or kRandomMachine; empty: a race.
  std::string baseline;
  /// Text of an irace parameter file; empty for machines of a flavour. Only with a target.
  std::string parameters;
  /// Text of an irace file with the initial configurations; empty for none.
  std::string configurations;

  friend bool operator==(const Method&, const Method&) = default;
};

/// The method's flavour, with the flavour's own turn clock. Fails for an unknown name.
inline Expected<const Flavour*> flavour_of(const Method& method) {
  return find_flavour(method.flavour, method.own_flavour);
}

/// The largest budget of a design; limited because lists of pairs grow with the budget.
inline constexpr std::int64_t kLargestBudget = 100'000'000;

/// The contents of a campaign file, checked and complete.
struct Campaign {
  std::string name = "campaign";
  std::uint64_t seed = 1;
  std::int64_t repetitions = 1;
  std::vector<CampaignMission> missions;
  std::vector<Method> methods;
  /// Race options; the number of instances and the seed are set for each design.
  Scenario race;
  std::int64_t digits = 2;  ///< decimals of the real parameters
  Profile profile;
  std::optional<Target> target;  ///< programs that evaluate instead of the simulator; there is no
                                 ///< profile then
  /// Absolute path of a program that repairs sampled configurations (irace's repairConfiguration);
  /// empty for none.
  std::string repair;
  std::int64_t test_nb_elites = 1;     ///< number of elites that are tested after the last race
  bool test_iteration_elites = false;  ///< whether to test the elites of every iteration too
  /// Profiles under which the tests are repeated, besides `profile`; the names are unique and
  /// differ from its name. The names are the sources of the scores.
  std::vector<Profile> test_profiles;
  /// No race: only the configurations of `Method::configurations` are tested. Only with a target.
  bool only_test = false;

  // Outside the digest: changing these values neither prevents a resume nor changes the answer.
  std::filesystem::path store;
  std::optional<std::int64_t> local_workers;  ///< processes; none: as many slots as cores
  LaunchOptions launch;                       ///< how workers are started, except `local_workers`
  std::string bind;                           ///< empty: a free port on loopback
  std::string dashboard_bind{};               ///< address of the dashboard's pages; empty: the
                                              ///< command's default
  double task_timeout_s = 30;
  std::int64_t retries = 2;
  bool stop_on_failure = false;    ///< otherwise a final failure is a rejection
  std::int64_t audit_every = 200;  ///< one of this many evaluations is checked; 0: none
};

}  // namespace swarmsmith
