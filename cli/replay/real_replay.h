#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/expected.h"
#include "cli/replay/stored_runs.h"
#include "coordinator/results/filmed_run.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// A real run beside simulations of the machine that ran: the same mission, the same patches, and
/// the real starts, where all of them are places that a simulated robot can have.

/// One run of those shown.
struct ShownRun {
  std::string source;     ///< "real", or the simulator's profile
  std::int64_t seed = 0;  ///< of a simulation
  double score = 0;
  std::vector<std::vector<Pose>> robots;  ///< each one's poses, from the start on
  std::vector<std::string> labels;        ///< a robot
  std::vector<std::vector<Pose>> objects;
  Instance instance;
};

struct RealReplay {
  RealRunRows rows;
  std::string verdict;  ///< that counts: a person's, else the scoring's
  FilmedRun filmed;
  double score = 0;            ///< of the stored cycles, anew
  bool starts_as_real = true;  ///< of the simulations
  std::vector<ShownRun> runs;  ///< the real one first
};

/// Simulates nothing without seeds. NotFound when there is no such run; BadInput when the run names
/// no candidate, or one that this program cannot simulate.
Expected<RealReplay> replay_real_run(std::unique_ptr<StoreReader> store, RealRunId id,
                                     const std::vector<std::int64_t>& seeds);

/// What is simulated beside a real run with a seed. NotFound and BadInput as above.
Expected<StoredRun> simulation_beside(std::unique_ptr<StoreReader> store, RealRunId id,
                                      std::int64_t seed);

/// All of them side by side, as SVG.
std::string picture_of(const RealReplay& replay, RealRunId id, double width_mm);

/// All of them as one table: run, source, seed, the columns of a trajectory (docs/trajectories.md),
/// and how each pose was obtained.
std::string table_of(const RealReplay& replay, RealRunId id);

}  // namespace swarmsmith::cli
