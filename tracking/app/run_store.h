#pragma once

#include <memory>
#include <string>

#include "storage/store.h"
#include "storage/store_at_rest.h"
#include "tracking/app/refusal.h"
#include "tracking/rig/run_log.h"
#include "tracking/robots/robot_logs.h"

namespace swarmsmith::cli {

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
OrRefusal<std::unique_ptr<StoreReader>> read_store(const std::string& store);

/// A run by its word, r7; exit code 4 when there is none.
OrRefusal<RealRunRows> find_run(StoreReader& store, const std::string& word);

}  // namespace swarmsmith::cli
