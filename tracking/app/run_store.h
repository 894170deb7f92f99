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

/// The control software that ran on the robots.
struct RanControl {
  CandidateId candidate;
  Mission mission;  ///< the mission for which it was designed
  RanMachine machine;
};

/// Finds the candidate that a log names, or the winner of the design that it names, in a store.
/// Exit code 4 if there is none; 3 if the store cannot be read.
OrRefusal<RanControl> control_of(const std::string& store, const RunLog& log);

/// Refuses control software for another mission than the log's; exit code 4.
OrRefusal<void> check_mission(const RanControl& control, const RunLog& log,
                              const std::string& store);

/// Refuses a source of filmed runs that has the name of a simulator's profile, built in or of the
/// store (which need not exist): their scores would look like simulated ones. Exit code 2.
OrRefusal<void> check_source(const RunLog& log, const std::string& store);

/// Opens the store for writing; exit code 3 if that fails. Waits for a moment if the store is
/// locked, because another command may hold it only briefly; a running campaign holds it longer.
OrRefusal<std::unique_ptr<StoreAtRest>> open_store(const std::string& store,
                                                   StoreAtRest::IfMissing if_missing);

/// A stored run, and the decisions of people on it.
struct KeptRun {
  std::string store;  ///< file of the store
  RealRunId id;
  RealRunRows rows;
  std::vector<VerdictOverride> overrides;  ///< oldest first

  /// The verdict that counts.
  std::string verdict() const;
};
/// Reads a run by its name, such as r7; exit code 4 if it does not exist. `option` is the value of
/// `--store`; if it is empty, SWARMSMITH_STORE names the store.
OrRefusal<KeptRun> kept_run(const std::string& option, const std::string& word);
/// The name of the store, found in the same way; exit code 2 if there is none.
OrRefusal<std::string> named_store(const std::string& option);

}  // namespace swarmsmith
