#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "coordinator/campaign/campaign.h"
#include "coordinator/cli/thing_id.h"
#include "sim/control/flavour.h"
#include "sim/control/machine.h"
#include "sim/engine/simulate.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// What the store holds of an evaluation's outcome.
struct StoredOutcome {
  double score = 0;
  std::uint64_t state_digest = 0;
};

/// An evaluation of a store with everything that it is a function of.
struct StoredRun {
  std::string id;         ///< of the evaluation, e81200007; empty when the store has none of it
  std::string candidate;  ///< c812
  std::int64_t seed = 0;
  bool rejected = false;
  int engine_version = 0;  ///< that made the stored outcome; 0 when the store does not say
  std::optional<StoredOutcome> outcome;  ///< none: rejected, or not in the store
  Machine machine;
  Flavour flavour;
  Profile profile;
  Mission mission;
  Instance instance;

  SimulationSetup setup() const { return {machine, flavour, profile, mission, instance, seed}; }
};

/// Whether a simulation gave what the store holds, bit for bit. The store keeps -0 as 0.
bool same_bits(const StoredOutcome& stored, const SimulationResult& result);

/// The evaluations of a store, to be simulated again.
class StoredRuns {
 public:
  /// Fails when a store's only campaign file cannot be read by this version; of several campaigns,
  /// which may be imported ones, each run tells for itself.
  static Expected<StoredRuns> open(std::unique_ptr<StoreReader> store);

  /// NotFound when the store has no such evaluation; BadInput when it cannot be simulated: it was
  /// filmed, its pair is gone, or its profile is none of this program.
  Expected<StoredRun> evaluation(const ThingId& id);
  /// A candidate on any seed; what the store holds of that pair comes with it.
  Expected<StoredRun> candidate(const ThingId& id, std::int64_t seed);
  /// Ids of `count` simulated evaluations that have a score, evenly spaced through all of them in
  /// the order of candidates; all when there are fewer.
  Expected<std::vector<std::string>> sample(std::int64_t count);

 private:
  /// A campaign of the store, read from its file.
  struct Source {
    Expected<Campaign> campaign;
    int engine_version = 0;
  };
  explicit StoredRuns(std::unique_ptr<StoreReader> store) : store_(std::move(store)) {}

  /// What the run is a function of, besides its machine's text and its seed.
  struct Origin {
    std::string machine;
    std::string mission;
    std::string method;
    std::string source;
    DesignId design;
  };
  Expected<const Source*> source_of(DesignId design);
  Expected<void> complete(StoredRun& run, const Origin& origin);

  std::unique_ptr<StoreReader> store_;
  std::map<std::int64_t, Source> sources_;  ///< by the campaign's number, those that were needed
};

/// The stored version differs from this program's: a sentence that says so, else empty.
std::string other_engine(int stored_version);

}  // namespace swarmsmith::cli
