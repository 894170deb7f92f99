#pragma once

#include <memory>
#include <string>
#include <vector>

#include "storage/store.h"
#include "storage/store_at_rest.h"
#include "tracking/app/refusal.h"
#include "tracking/rig/run_log.h"
#include "tracking/robots/robot_logs.h"
#include "tracking/scoring/run_findings.h"

namespace swarmsmith {

/// What ran on the robots.
struct RanControl {
  CandidateId candidate;
  Mission mission;  ///< that it was designed for
  RanMachine machine;
};

/// The candidate of a store that a log names, else the winner of its design. Exit code 4 when there
/// is none; 3 when the store cannot be read.
OrRefusal<RanControl> control_of(const std::string& store, const RunLog& log);

/// Opens the store to add to it; exit code 3. A campaign that runs holds it: waits for a moment, as
/// another command may do so, too.
OrRefusal<std::unique_ptr<StoreAtRest>> open_store(const std::string& store,
                                                   StoreAtRest::IfMissing if_missing);

/// A run of a store, and what people said of it.
struct KeptRun {
  std::string store;  ///< its file
  RealRunId id;
  RealRunRows rows;
  std::vector<VerdictOverride> overrides;  ///< oldest first
};
/// By its word, r7; exit code 4 when there is none. `option` is `--store`, else SWARMSMITH_STORE
/// names the store.
OrRefusal<KeptRun> kept_run(const std::string& option, const std::string& word);
/// The same words, checked; exit code 2.
OrRefusal<std::string> named_store(const std::string& option);

}  // namespace swarmsmith
