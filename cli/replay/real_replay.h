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

/// A real run beside simulations of the same machine: on the same mission with the same patches,
/// and from the real starts if a simulated swarm can start from all of them.

/// One of the runs that are shown.
struct ShownRun {
  std::string source;     ///< "real", or the simulator's profile
  std::int64_t seed = 0;  ///< for a simulation
  double score = 0;
  std::vector<std::vector<Pose>> robots;  ///< the poses of each robot, from the start
  std::vector<std::string> labels;        ///< one per robot
  std::vector<std::vector<Pose>> objects;
  Instance instance;
};

struct RealReplay {
  RealRunRows rows;
  std::string verdict;  ///< the valid one: a person's override, else the verdict of the scoring
  FilmedRun filmed;
  double score = 0;            ///< of the stored cycles, computed again
  bool starts_as_real = true;  ///< whether the simulations start from the real starts
  std::vector<ShownRun> runs;  ///< the real run comes first
};

/// Simulates nothing if there are no seeds. NotFound if there is no such run; BadInput if the run
/// has no candidate, or if this program cannot simulate its candidate.
Expected<RealReplay> replay_real_run(std::unique_ptr<StoreReader> store, RealRunId id,
                                     const std::vector<std::int64_t>& seeds);

/// The simulation that is shown beside a real run for a seed. NotFound and BadInput as above.
Expected<StoredRun> simulation_beside(std::unique_ptr<StoreReader> store, RealRunId id,
                                      std::int64_t seed);

/// All runs side by side, as SVG.
std::string picture_of(const RealReplay& replay, RealRunId id, double width_mm);

/// All runs as one table: run, source, seed, the columns of a trajectory (docs/trajectories.md),
/// and how each pose was obtained.
std::string table_of(const RealReplay& replay, RealRunId id);

}  // namespace swarmsmith::cli
