#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "storage/internal/candidate_code.h"
#include "storage/internal/columns.h"
#include "storage/internal/row_sums.h"
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
  /// An evaluation that gives way to another one. The same.
  void remove(const EvaluationKey& key);
  /// Before the commit: the sums over the rows (RowSums), where the store has them. Rows of these
  /// tables that were written by others in this transaction are counted. The same.
  void write_sums(std::initializer_list<RowSums::Table> others = {});

  void committed() { committed_ = sums_; }
  /// Drops what was remembered of rows that a rollback has taken away.
  void forget();
  /// Of the rows that are committed.
  const std::optional<RowSums>& sums() const { return committed_; }

 private:
  using Table = RowSums::Table;

  /// Runs an INSERT OR IGNORE of these cells, in the order of the sum's.
  template <class... Cells>
  void insert(Table table, sqlite::Statement& statement, const Cells&... cells) {
    statement.run(cells...);
    if (sums_ && connection_.changes() > 0) sums_->add(table, RowHash::of(cells...));
  }
  template <std::size_t N, class... Cells>
  void insert(Table table, sqlite::Statement& statement, const TableColumns<N>& /*columns*/,
              const Cells&... cells) {
    static_assert(sizeof...(Cells) == N, "a cell for each column");
    insert(table, statement, cells...);
  }
  /// Takes the row of a key from the sum, before it is replaced.
  template <class... Key>
  void take_away(Table table, sqlite::Statement& cells, const Key&... key) {
    if (!sums_) return;
    cells.bind(key...);
    if (cells.step()) sums_->remove(table, hash_of(cells));
    cells.reset();
  }
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
  sqlite::Statement candidate_, known_candidate_, phrase_, pair_, evaluation_, used_, unused_,
      iteration_, race_step_, elimination_, elite_, totals_, design_state_, campaign_state_,
      worker_, conflict_, failure_, event_, attempt_, command_, forgiven_, new_source_,
      find_source_;
  /// Cells of one row, as its sum has them.
  sqlite::Statement evaluation_cells_, used_cells_, totals_cells_, design_cells_, campaign_cells_,
      command_cells_;
  std::optional<RowSums> sums_;  ///< none: the store has none
  std::optional<RowSums> committed_;
  /// Hashes of the totals of candidates that are racing: each step replaces them.
  std::unordered_map<std::int64_t, std::uint64_t> totals_hashes_;
  std::unordered_map<std::string, std::int64_t> sources_;
  PhraseBook phrases_;
  bool phrases_are_loaded_ = false;
};

/// Throws std::invalid_argument when a number of the row is NaN or infinite: SQLite would store a
/// NaN as NULL, and no score is either.
void require_finite(const Row& row);

}  // namespace swarmsmith
