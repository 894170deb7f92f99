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

/// Adds scores that were simulated outside of the races to a store that no campaign is writing.
class ScoreKeeper {
 public:
  /// Locks the store from now on, so that no scores are computed that cannot be stored. Conflict if
  /// a campaign is writing it.
  static Expected<ScoreKeeper> open(const std::string& store);

  /// BadInput if a design would have too many scores. To be called before anything is computed.
  Expected<void> check_room(const std::vector<ScorePlace>& places) const {
    return ledger_.check_room(places);
  }

  /// Stores the profile of the scores that follow. Without it, the store could not know the
  /// profile.
  void keep_profile(const Profile& profile);

  /// The result of storing a score.
  struct Kept {
    enum class How { New, Known, Conflict } how = How::New;
    EvaluationKey key;
    double stored = 0;  ///< the score that the store already has
  };

  /// Collects a score. If the store already has a score for the same evaluation, the bits must be
  /// equal; a different score is stored as a conflict beside it. There must be room for it.
  Kept keep(const ScorePlace& place, Measured result);

  /// Writes the scores collected since the last commit, all or nothing.
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
