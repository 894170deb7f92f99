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

/// An evaluation of a store with all inputs that determine its result.
struct StoredRun {
  std::string id;         ///< of the evaluation, e81200007; empty if the store does not have it
  std::string candidate;  ///< c812
  std::int64_t seed = 0;
  bool rejected = false;
  std::optional<Measured> outcome;  ///< empty: rejected, or not in the store
  Controller controller;
  Flavour flavour;
  Profile profile;
  Mission mission;
  Instance instance;
  int engine_version = 0;  ///< version that made the stored outcome; 0 if the store does not say it
  std::int64_t worker = 0;  ///< the worker that returned it; 0 if the store does not say it
  std::string host;         ///< of the worker, as the worker reported it
  std::string who;          ///< the worker's key and address, which are responsible for it

  SimulationSetup setup() const { return {controller, flavour, profile, mission, instance, seed}; }
  /// "; given by worker 3 on lab7 (lab@10.0.0.7)", empty if the worker is not known.
  std::string given_by() const;
};

/// The evaluations of a store, so that they can be simulated again.
class StoredRuns {
 public:
  /// Fails if this version cannot read the campaign file in the store.
  static Expected<StoredRuns> open(std::unique_ptr<StoreReader> store);
  /// The same for a store that outlives this object.
  static Expected<StoredRuns> open(StoreReader& store);

  /// NotFound if the store has no such evaluation. BadInput if it cannot be simulated: it was
  /// filmed or imported, its pair is missing, or this program does not know its profile.
  Expected<StoredRun> evaluation(const ThingId& id);
  /// A candidate on any seed, with the stored result for that pair if there is one. `profile`: one
  /// of the store's or of this program's; empty: that of the race.
  Expected<StoredRun> candidate(const ThingId& id, std::int64_t seed,
                                const std::string& profile = {});
  /// The ids of `count` simulated evaluations that have a score, evenly spaced in the order of
  /// candidates; all of them if there are fewer.
  Expected<std::vector<std::string>> sample(std::int64_t count);

  /// Selects evaluations of campaigns that were simulated for the race or its tests.
  struct Wanted {
    bool rejections = false;  ///< all rejections
    bool tests = false;       ///< all tests of winners
    /// Number of other evaluations with a score, taken in turn from each key and address; `seed`
    /// decides which ones.
    std::int64_t scores = 0;
    std::int64_t seed = 1;
  };
  /// The ids, rejections first. Empty if no campaign of the store simulates.
  Expected<std::vector<std::string>> chosen(const Wanted& wanted);
  /// Whether the store has anything that can be simulated; false if all scores come from programs.
  bool has_machines() const;

 private:
  StoredRuns(StoreReader& store, DesignWorlds worlds)
      : store_(&store), worlds_(std::move(worlds)) {}

  /// The settings of the design, or the reason why there are none.
  Expected<DesignWorld> world_of(DesignId design);
  Expected<std::vector<std::string>> ids_of(const std::string& sql);
  /// See Wanted::scores. `given` is the FROM and WHERE clause that selects the evaluations.
  Expected<std::vector<std::string>> drawn(const std::string& given, const Wanted& wanted);
  /// SQL condition for evaluations of campaigns that simulate; empty if there is no such campaign.
  std::string of_campaigns() const;

  StoreReader* store_;
  std::unique_ptr<StoreReader> owned_;  ///< the store, or null if it is not owned
  DesignWorlds worlds_;
  std::optional<DesignWorld> world_;  ///< of the design asked for last
};

/// The error for a store in which nothing can be evaluated again.
Error programs_scored(const std::string& where);

/// A sentence if the stored version (0: not known) differs from this program's version of the
/// mission; else empty.
std::string other_engine(int stored_version, int version = kEngineVersion);

}  // namespace swarmsmith::cli
