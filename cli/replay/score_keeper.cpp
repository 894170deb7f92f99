#include "cli/replay/score_keeper.h"

#include <bit>
#include <utility>

#include "cli/arguments/store_argument.h"
#include "sim/files/profile_file.h"

namespace swarmsmith::cli {

Expected<ScoreKeeper> ScoreKeeper::open(const std::string& store) {
  auto at_rest = open_at_rest(store, StoreAtRest::IfMissing::Refuse);
  if (!at_rest) {
    Error error = at_rest.error();
    error.message += error.kind == ErrorKind::Conflict
                         ? "; wait until it has ended, or add --no-store to print the scores only"
                         : "; --no-store prints the scores only";
    return Unexpected(error);
  }
  const auto reader = StoreReader::open(store);
  if (!reader) return Unexpected(reader.error());
  auto ledger = ScoreLedger::read(**reader);
  if (!ledger) return Unexpected(ledger.error());
  return ScoreKeeper(std::move(*at_rest), std::move(*ledger));
}

ScoreKeeper::Kept ScoreKeeper::keep(const ScorePlace& place, Measured result) {
  result.score += 0.0;  // the store keeps -0 as 0
  const LedgerScore* known = ledger_.find(place);
  if (known == nullptr) {
    const EvaluationKey key = ledger_.add(place, result, rows_);
    rows_.emplace_back(EvaluationRow{.key = key, .measured = result, .source = place.source});
    return {Kept::How::New, key, result.score};
  }
  // An imported score has no state digest to compare.
  const bool same_score = std::bit_cast<std::uint64_t>(known->measured.score + 0.0) ==
                          std::bit_cast<std::uint64_t>(result.score);
  const bool same_state =
      known->measured.state_digest == 0 || known->measured.state_digest == result.state_digest;
  if (same_score && same_state) return {Kept::How::Known, known->key, known->measured.score};
  rows_.emplace_back(ConflictRow{.key = known->key,
                                 .kept_score = known->measured.score,
                                 .other_score = result.score,
                                 .other_state_digest = result.state_digest,
                                 .other_worker = 0});
  return {Kept::How::Conflict, known->key, known->measured.score};
}

void ScoreKeeper::keep_profile(const Profile& profile) {
  profiles_.emplace(profile.name, profile_text(profile));
}

Expected<void> ScoreKeeper::commit() {
  if (rows_.empty()) return {};
  return store_->add({.campaign = {},
                      .designs = {},
                      .removed = {},
                      .rows = std::exchange(rows_, {}),
                      .profiles = profiles_});
}

}  // namespace swarmsmith::cli
