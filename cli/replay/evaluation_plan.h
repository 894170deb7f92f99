#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/expected.h"
#include "cli/arguments/store_argument.h"
#include "cli/replay/machine_argument.h"
#include "console/output.h"
#include "sim/control/flavour.h"
#include "sim/control/machine.h"
#include "sim/engine/profile.h"
#include "sim/mission/mission.h"

namespace swarmsmith::cli {

/// The arguments of `evaluate`, to be read by `plan_evaluations`.
struct EvaluateArguments {
  std::string machine;
  std::string flavour;
  std::string turn_clock;
  std::string profile;
  std::string mission;
  std::string campaign;
  std::vector<std::string> designs;
  std::string seeds;
  std::string starts;
  std::string patches;
  bool no_store = false;
  StoreArgument store;
};

/// One machine, and its simulation settings.
struct EvaluationJob {
  CandidateId candidate;  ///< empty: given as text or file
  Controller controller;
  Flavour flavour;
  Profile profile;
  bool keeps_profile = false;  ///< the store that gets the scores must keep the profile, too
  Mission mission;
  std::string name;                 ///< of a machine in a file; may be empty
  std::vector<std::int64_t> seeds;  ///< at least one
  std::vector<Instance> instances;  ///< one per seed
};

/// The evaluations that the command line asks for, checked.
struct EvaluationPlan {
  std::vector<EvaluationJob> jobs;  ///< at least one; by design
  std::string store;                ///< gets the scores; empty: no store
  std::string machine;              ///< its name in a picture; empty for a text
};

/// Reads the arguments, and the store and files that they name. NotFound without a place: there is
/// no such candidate or design. BadInput: an argument, or a file that it names, is wrong. All other
/// errors come from the store.
Expected<EvaluationPlan> plan_evaluations(const EvaluateArguments& arguments, Output& output);

/// The default seed of evaluations outside of the races: the first number of the stream "score" of
/// the campaign's seed that the store does not use for a race, test or audit. The same store gives
/// the same seed.
Expected<std::int64_t> fresh_seed(StoreReader& store, std::uint64_t campaign_seed);

}  // namespace swarmsmith::cli
