#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "cli/arguments/thing_id.h"
#include "cli/replay/design_worlds.h"
#include "sim/control/controller.h"
#include "sim/control/flavour.h"
#include "sim/engine/simulate.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// An evaluation of a store with everything that it is a function of.
struct StoredRun {
  std::string id;         ///< of the evaluation, e81200007; empty when the store has none of it
  std::string candidate;  ///< c812
  std::int64_t seed = 0;
  bool rejected = false;
  std::optional<SimulationResult> outcome;  ///< none: rejected, or not in the store
  Controller controller;
  Flavour flavour;
  Profile profile;
  Mission mission;
  Instance instance;
  int engine_version = 0;   ///< that made the stored outcome; 0 when the store does not say
  std::int64_t worker = 0;  ///< that gave it; 0 when the store does not say
  std::string host;         ///< of the worker, as it says
  std::string who;          ///< answers for the worker: its key and address

  SimulationSetup setup() const { return {controller, flavour, profile, mission, instance, seed}; }
  /// "; given by worker 3 on lab7 (lab@10.0.0.7)", empty when unknown.
  std::string given_by() const;
};

/// Whether a simulation gave what the store holds, bit for bit. The store keeps -0 as 0.
bool same_bits(const SimulationResult& stored, const SimulationResult& result);

/// The evaluations of a store, to be simulated again.
class StoredRuns {
 public:
  /// Fails when the campaign file that the store keeps cannot be read by this version.
  static Expected<StoredRuns> open(std::unique_ptr<StoreReader> store);
  /// The same of a store that outlives it.
  static Expected<StoredRuns> open(StoreReader& store);

  /// NotFound when the store has no such evaluation; BadInput when it cannot be simulated: it was
  /// filmed or imported, its pair is gone, or its profile is none of this program.
  Expected<StoredRun> evaluation(const ThingId& id);
  /// A candidate on any seed; what the store holds of that pair comes with it.
  Expected<StoredRun> candidate(const ThingId& id, std::int64_t seed);
  /// Ids of `count` simulated evaluations that have a score, evenly spaced through all of them in
  /// the order of candidates; all when there are fewer.
  Expected<std::vector<std::string>> sample(std::int64_t count);

  /// Which evaluations of campaigns, simulated for the race or its tests, are wanted.
  struct Wanted {
    bool rejections = false;  ///< all
    bool tests = false;       ///< all of winners
    /// So many others that have a score, from each key and address in turn, which ones a matter of
    /// `seed`.
    std::int64_t scores = 0;
    std::int64_t seed = 1;
  };
  /// Ids, first those of rejections. Empty where no campaign of the store simulates.
  Expected<std::vector<std::string>> chosen(const Wanted& wanted);
  /// Whether the store has anything that can be simulated; not when programs score all of it.
  bool has_machines() const;

 private:
  StoredRuns(StoreReader& store, DesignWorlds worlds)
      : store_(&store), worlds_(std::move(worlds)) {}

  /// The design's world, or why there is none.
  Expected<DesignWorld> world_of(DesignId design);
  Expected<std::vector<std::string>> ids_of(const std::string& sql);
  /// See Wanted::scores; `given` is the FROM and WHERE of the evaluations.
  Expected<std::vector<std::string>> drawn(const std::string& given, const Wanted& wanted);
  /// SQL that is true of evaluations of campaigns that simulate; empty when none does.
  std::string of_campaigns() const;

  StoreReader* store_;
  std::unique_ptr<StoreReader> owned_;  ///< the store, or nothing
  DesignWorlds worlds_;
  std::optional<DesignWorld> world_;  ///< the last one
};

/// Why nothing of a store can be evaluated again.
Error programs_scored(const std::string& where);

/// The stored version (0: not known) differs from this program's version of the mission: a sentence
/// that says so, else empty.
std::string other_engine(int stored_version, int version = kEngineVersion);

}  // namespace swarmsmith::cli
