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

/// A mission and how its designs are judged; with a target only its name counts, and what its
/// programs are given.
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

/// As a baseline: a machine drawn from the method's space, another one in each repetition.
inline constexpr std::string_view kRandomMachine = "random";

struct Method;
struct Campaign;
/// Designs of the method on each mission: one of a machine that is given, whatever the campaign's
/// repetitions are, since all would be the same.
std::int64_t repetitions_of(const Campaign& campaign, const Method& method);

/// A way to design: the flavour's modules that may be used, and how large machines may grow.
struct Method {
  std::string name;
  std::string flavour = "watermelon";
  const Flavour* own_flavour = nullptr;      ///< of a file, see kept_flavour; null: built in
  TurnClock turn_clock = TurnClock::Cycles;  ///< the flavour's own unless the file has another
  std::int64_t max_states = 4;
  std::int64_t max_transitions = 4;
  std::vector<std::string> behaviours;  ///< names; all of the flavour's when the file has none
  std::vector<std::string> conditions;
  std::vector<RangeOverride> ranges;
  Architecture architecture = Architecture::Machine;  ///< what is searched
  std::int64_t max_subtrees = kMaxSubtrees;           ///< of trees
  NetworkInputs inputs = NetworkInputs::Rvr;          ///< of networks
  double most_weight = kMostWeight;                   ///< of networks
  SearchOptions search;                               ///< how it is searched
  /// No race, but a machine to compare with, tested as the winners of races are: a text of the
  /// grammar, or kRandomMachine; empty: a race.
  std::string baseline;
  /// Text of an irace parameter file; empty for a flavour's machines. Only with a target.
  std::string parameters;
  /// Text of an irace configurations file: the first configurations; empty for none.
  std::string configurations;

  friend bool operator==(const Method&, const Method&) = default;
};

/// The method's flavour, but for the turn clock. Fails for a name that this program does not know.
inline Expected<const Flavour*> flavour_of(const Method& method) {
  return find_flavour(method.flavour, method.own_flavour);
}

/// Of a design: lists of pairs are as long as a part of it.
inline constexpr std::int64_t kLargestBudget = 100'000'000;

/// A campaign file, checked and complete.
struct Campaign {
  std::string name = "campaign";
  std::uint64_t seed = 1;
  std::int64_t repetitions = 1;
  std::vector<CampaignMission> missions;
  std::vector<Method> methods;
  /// Race options; number of instances and seed are set per design.
  Scenario race;
  std::int64_t digits = 2;  ///< decimals of the real parameters
  Profile profile;
  std::optional<Target> target;  ///< evaluates in place of the simulator, and its profile
  /// Program that repairs sampled configurations (irace's repairConfiguration), absolute; empty for
  /// none.
  std::string repair;
  std::int64_t test_nb_elites = 1;     ///< how many elites are tested after the last race
  bool test_iteration_elites = false;  ///< those of every iteration too
  /// Under which the tests are run again, besides `profile`; other names than its, each once. Their
  /// names are the scores' sources.
  std::vector<Profile> test_profiles;
  /// No race: what is tested are the configurations of `Method::configurations`. Only with a
  /// target.
  bool only_test = false;

  // Outside the digest: other values neither stop a resume nor change the answer.
  std::filesystem::path store;
  std::optional<std::int64_t> local_workers;  ///< processes; none: as many slots as cores
  LaunchOptions launch;                       ///< who starts workers, but for `local_workers`
  std::string bind;                           ///< empty: a free port on loopback
  std::string dashboard_bind{};               ///< of the pages; empty: as the command has it
  double task_timeout_s = 30;
  std::int64_t retries = 2;
  bool stop_on_failure = false;    ///< else an evaluation that fails for good is a rejection
  std::int64_t audit_every = 200;  ///< one evaluation of so many is made twice; 0: none
};

}  // namespace swarmsmith
