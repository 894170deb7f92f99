#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "coordinator/results/score_ledger.h"
#include "sim/engine/simulate.h"
#include "storage/store_at_rest.h"

namespace swarmsmith::cli {

/// Puts scores that were simulated outside of the races into a store that is at rest.
class ScoreKeeper {
 public:
  /// Holds the store's lock from now on, so that no work is done in vain. Conflict when a campaign
  /// is writing it.
  static Expected<ScoreKeeper> open(const std::string& store);

  /// Keeps what the profile is of scores that are kept from now on: the store cannot know it else.
  void keep_profile(const Profile& profile);

  /// What became of a score.
  struct Kept {
    enum class How { New, Known, Conflict } how = How::New;
    EvaluationKey key;
    double stored = 0;  ///< the score that the store holds
  };

  /// Gathers a score. One that the store has already must have the same bits; one with others is
  /// kept as a conflict beside it.
  Kept keep(const ScorePlace& place, const SimulationResult& result, std::int64_t wall_us);

  /// Writes what was gathered since the last time, all or nothing.
  Expected<void> commit();

 private:
  ScoreKeeper(std::unique_ptr<StoreAtRest> store, ScoreLedger ledger)
      : store_(std::move(store)), ledger_(std::move(ledger)) {}

  std::unique_ptr<StoreAtRest> store_;
  ScoreLedger ledger_;
  std::vector<Row> rows_;
  std::map<std::string, std::string> profiles_;
};

}  // namespace swarmsmith::cli
