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
  EvaluationKey key;  ///< a test's, or a later score's
  std::int64_t instance = 0;
  Measured measured{};  ///< digest 0: not made by this simulator
};

/// On what a score was made. No seed (0): a run that no seed describes, such as one of robots; then
/// the instance tells such runs apart, from 1.
struct ScorePlace {
  CandidateId candidate;
  std::string source;                    ///< a profile's name, `real`, ...
  std::optional<std::int64_t> instance;  ///< nothing: whichever the seed was used with
  std::int64_t seed = 0;
};

/// The scores that a store holds outside of the races, and the pairs for new ones. A pair of
/// purpose Score has a number within its design and stands for one (source, instance, seed), so
/// that candidates of a design meet on the same pairs.
class ScoreLedger {
 public:
  ScoreLedger() = default;
  static Expected<ScoreLedger> read(StoreReader& store);

  /// What is known there, tests included; null for nothing. With a seed and no instance: the first.
  const LedgerScore* find(const ScorePlace& place) const;

  /// The key of a score that is not known there, and is from now on. A new pair is added to `rows`.
  /// Instance 1 when the place has none.
  EvaluationKey add(const ScorePlace& place, const Measured& measured, std::vector<Row>& rows);

  /// The score that `find` gives, which must be there, gives way to another, made elsewhere.
  void replace(const ScorePlace& place, double score);

 private:
  using Place = std::tuple<CandidateId, std::string, std::int64_t, std::int64_t>;  // seed, instance
  using Pair = std::tuple<DesignId, std::string, std::int64_t, std::int64_t>;

  using Scores = std::map<Place, LedgerScore>;

  Scores::const_iterator at(const ScorePlace& place) const;

  Scores scores_;
  std::map<Pair, std::int64_t> pairs_;
  std::map<DesignId, std::int64_t> last_pair_;
};

}  // namespace swarmsmith
