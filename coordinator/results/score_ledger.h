#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "base/expected.h"
#include "base/measured.h"
#include "storage/store.h"

namespace swarmsmith {

/// A score that a candidate got outside of its race.
struct LedgerScore {
  EvaluationKey key;  ///< of a test or of a later score
  std::int64_t instance = 0;
  Measured measured{};  ///< digest 0: not computed by this simulator
};

/// The conditions of a score. Seed 0: a run without a seed, such as one with robots; such runs are
/// distinguished by the instance, counted from 1.
struct ScorePlace {
  CandidateId candidate;
  std::string source;                    ///< a profile's name, `real`, ...
  std::optional<std::int64_t> instance;  ///< none: the instance with which the seed was used
  std::int64_t seed = 0;
};

/// The scores in a store that do not come from races, and the pairs for new ones. Each pair with
/// purpose Score has a number within its design and represents one (source, instance, seed), so
/// that all candidates of a design share the same pairs.
class ScoreLedger {
 public:
  ScoreLedger() = default;
  static Expected<ScoreLedger> read(StoreReader& store);

  /// The known score at this place, tests included; null if there is none. With a seed and without
  /// an instance: the first score with this seed.
  const LedgerScore* find(const ScorePlace& place) const;

  /// BadInput if a design would have more pairs with scores at these places than a store can
  /// number.
  Expected<void> check_room(const std::vector<ScorePlace>& places) const;

  /// Adds a score that is not known yet, and returns its key. A new pair is added to `rows`. The
  /// instance is 1 if the place has none. There must be room.
  EvaluationKey add(const ScorePlace& place, const Measured& measured, std::vector<Row>& rows);

  /// Replaces the score that `find` returns, which must exist, by a score measured elsewhere.
  void replace(const ScorePlace& place, double score);

 private:
  using Place = std::tuple<CandidateId, std::string, std::int64_t, std::int64_t>;  // seed, instance
  using Pair = std::tuple<DesignId, std::string, std::int64_t, std::int64_t>;

  using Scores = std::map<Place, LedgerScore>;

  Scores::const_iterator at(const ScorePlace& place) const;
  static Pair pair_of(const ScorePlace& place);

  Scores scores_;
  std::map<Pair, std::int64_t> pairs_;
  std::map<DesignId, std::int64_t> last_pair_;
};

}  // namespace swarmsmith
