#include "coordinator/results/score_ledger.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/assert.h"
#include "base/text/csv.h"
#include "storage/stored_enums.h"

namespace swarmsmith {
namespace {

// Tests first: if both have a score for the same place, the test counts, because the first one
// stays. Real runs have no pair, and are not in this ledger.
std::string select_scores() {
  return "SELECT candidate, purpose, pair, instance, seed, source, score, state_digest"
         " FROM v_evaluations WHERE purpose IN " +
         words_in_sql(is_score_of_winner) +
         " AND pair IS NOT NULL ORDER BY purpose = 'score', candidate, pair";
}

std::int64_t integer_at(const StoreReader::Cell& cell) {
  return integer_in(cell.text).value_or(0);
}

}  // namespace

Expected<ScoreLedger> ScoreLedger::read(StoreReader& store) {
  ScoreLedger ledger;
  const auto take = [&](const std::vector<StoreReader::Cell>& row) {
    const CandidateId candidate{integer_at(row[0])};
    const DesignId design = design_of(candidate);
    const Purpose purpose = purpose_of_word(row[1].text).value_or(Purpose::Score);
    const LedgerScore known{
        .key = {candidate, purpose, integer_at(row[2])},
        .instance = integer_at(row[3]),
        .measured = {.score = number_in(row[6].text).value_or(0),
                     .state_digest = static_cast<std::uint64_t>(integer_at(row[7]))}};
    const std::string& source = row[5].text;
    const std::int64_t seed = integer_at(row[4]);
    if (purpose == Purpose::Score) {
      ledger.pairs_.emplace(Pair{design, source, seed, known.instance}, known.key.pair);
      std::int64_t& last = ledger.last_pair_[design];
      last = std::max(last, known.key.pair);
    }
    // Its pair is taken all the same: other candidates of the design may have a score on it.
    if (row[6].type == StoreReader::Cell::Type::Null) return;  // rejected: no score
    ledger.scores_.emplace(Place{candidate, source, seed, known.instance}, known);
  };
  constexpr std::int64_t kAll = std::numeric_limits<std::int64_t>::max();
  const auto end = store.query(
      select_scores(), {.rows = kAll, .seconds = 600, .bytes = kAll}, [](const auto&) {}, take);
  if (!end) return Unexpected(end.error());
  if (end->truncated) {
    return unexpected(ErrorKind::Unavailable, "the store's scores took longer than 600 s to read");
  }
  return ledger;
}

ScoreLedger::Scores::const_iterator ScoreLedger::at(const ScorePlace& place) const {
  constexpr std::int64_t kFirst = std::numeric_limits<std::int64_t>::min();
  // Places are sorted by their instances last, so this is the first one with the seed.
  const auto found = scores_.lower_bound(
      Place{place.candidate, place.source, place.seed, place.instance.value_or(kFirst)});
  if (found == scores_.end()) return found;
  const auto& [candidate, source, seed, instance] = found->first;
  const bool same = candidate == place.candidate && source == place.source && seed == place.seed &&
                    place.instance.value_or(instance) == instance;
  return same ? found : scores_.end();
}

const LedgerScore* ScoreLedger::find(const ScorePlace& place) const {
  const auto found = at(place);
  return found == scores_.end() ? nullptr : &found->second;
}

ScoreLedger::Pair ScoreLedger::pair_of(const ScorePlace& place) {
  return {design_of(place.candidate), place.source, place.seed, place.instance.value_or(1)};
}

Expected<void> ScoreLedger::check_room(const std::vector<ScorePlace>& places) const {
  std::map<DesignId, std::set<Pair>> fresh;
  for (const ScorePlace& place : places) {
    Pair pair = pair_of(place);
    if (find(place) != nullptr || pairs_.contains(pair)) continue;
    fresh[design_of(place.candidate)].insert(std::move(pair));
  }
  for (const auto& [design, pairs] : fresh) {
    const auto last = last_pair_.find(design);
    const std::int64_t pairs_now = last == last_pair_.end() ? 0 : last->second;
    const std::int64_t needed = pairs_now + std::ssize(pairs);
    if (needed < kPairsPerCandidate) continue;
    return bad_input(
        fmt::format("{} would have scores on {} pairs (of source, instance and seed); "
                    "a design can have at most {}",
                    to_string(design), needed, kPairsPerCandidate - 1));
  }
  return {};
}

EvaluationKey ScoreLedger::add(const ScorePlace& place, const Measured& measured,
                               std::vector<Row>& rows) {
  const DesignId design = design_of(place.candidate);
  const std::int64_t instance = place.instance.value_or(1);
  const auto [pair, is_new] = pairs_.emplace(pair_of(place), 0);
  if (is_new) {
    pair->second = ++last_pair_[design];
    SWARMSMITH_ASSERT(pair->second < kPairsPerCandidate,
                      "a pair has a number within its design; check_room comes first");
    rows.emplace_back(PairRow{.design = design,
                              .purpose = Purpose::Score,
                              .number = pair->second,
                              .instance = instance,
                              .seed = place.seed});
  }
  const EvaluationKey key{place.candidate, Purpose::Score, pair->second};
  scores_.insert_or_assign(Place{place.candidate, place.source, place.seed, instance},
                           LedgerScore{key, instance, measured});
  return key;
}

void ScoreLedger::replace(const ScorePlace& place, double score) {
  const auto found = at(place);
  SWARMSMITH_ASSERT(found != scores_.end(), "only a known score can be replaced");
  LedgerScore changed = found->second;
  changed.measured = {.score = score};
  scores_.insert_or_assign(found->first, changed);
}

}  // namespace swarmsmith
