#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "storage/internal/candidate_code.h"
#include "storage/internal/sqlite.h"
#include "storage/rows.h"

namespace swarmsmith {

/// Puts rows into the tables, with one prepared statement a kind. The caller holds a transaction.
/// Any row may come twice: what is already there stays, except where a row holds absolute values
/// (totals, states, workers, commands), which replace the older ones.
class RowWriter {
 public:
  explicit RowWriter(sqlite::Connection& connection);

  /// Throws SqliteError; then the transaction must be rolled back and forget() be called.
  void write(const Row& row);

  /// Drops what was remembered of rows that a rollback has taken away.
  void forget();

 private:
  void put(const CandidateRow& row);
  void put(const PairRow& row);
  void put(const EvaluationRow& row);
  void put(const UnusedRow& row);
  void put(const IterationRow& row);
  void put(const RaceStepRow& row);
  void put(const EliminationRow& row);
  void put(const EliteRow& row);
  void put(const CandidateTotalsRow& row);
  void put(const DesignStateRow& row);
  void put(const CampaignStateRow& row);
  void put(const WorkerRow& row);
  void put(const ConflictRow& row);
  void put(const FailureRow& row);
  void put(const EventRow& row);
  void put(const AttemptRow& row);
  void put(const CommandRow& row);
  void put(const ForgivenRow& row);

  /// The number of a source, made when it is new.
  std::int64_t source_id(const std::string& name);

  sqlite::Connection& connection_;
  sqlite::Statement candidate_, known_candidate_, phrase_, pair_, evaluation_, unused_, iteration_,
      race_step_, elimination_, elite_, totals_, design_state_, campaign_state_, worker_, conflict_,
      failure_, event_, attempt_, command_, forgiven_, new_source_, find_source_;
  std::unordered_map<std::string, std::int64_t> sources_;
  PhraseBook phrases_;
  bool phrases_are_loaded_ = false;
};

/// Throws std::invalid_argument when a number of the row is NaN or infinite: SQLite would store a
/// NaN as NULL, and no score is either.
void require_finite(const Row& row);

}  // namespace swarmsmith
