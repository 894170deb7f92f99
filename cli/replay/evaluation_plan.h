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

/// The words of `evaluate`: only `plan_evaluations` reads them.
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

/// One machine, and what it is simulated in.
struct EvaluationJob {
  CandidateId candidate;  ///< none: given as text or file
  Controller controller;
  Flavour flavour;
  Profile profile;
  bool keeps_profile = false;  ///< the store that gets the scores must keep it, too
  Mission mission;
  std::string name;                 ///< of a machine of a file; may be empty
  std::vector<std::int64_t> seeds;  ///< at least one
  std::vector<Instance> instances;  ///< by seed
};

/// Everything that the command line says, read and checked.
struct EvaluationPlan {
  std::vector<EvaluationJob> jobs;  ///< at least one; by design
  std::string store;                ///< that their scores go to; empty: none
  std::string machine;              ///< what a picture calls it; empty for a text
};

/// Reads the store, files and words. NotFound without a place: there is no such candidate or
/// design. BadInput: a word or a file that it names is wrong. All others are of the store.
Expected<EvaluationPlan> plan_evaluations(const EvaluateArguments& arguments, Output& output);

/// The seed of evaluations outside of the races when none is named: the first number of the stream
/// "score" of the campaign's seed on which the store has no race, test or audit. The same store
/// gives the same seed.
Expected<std::int64_t> fresh_seed(StoreReader& store, std::uint64_t campaign_seed);

}  // namespace swarmsmith::cli
