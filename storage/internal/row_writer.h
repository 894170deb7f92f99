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

/// Writes rows into the tables, with one prepared statement for each type. The caller holds a
/// transaction. Any row may be written twice: an existing row stays, except that rows which hold
/// totals rather than increments (totals, states, workers, commands) replace older ones.
class RowWriter {
 public:
  explicit RowWriter(sqlite::Connection& connection);

  /// Throws SqliteError; the transaction must then be rolled back, and forget() called.
  void write(const Row& row);
  /// Removes an evaluation that another one replaces. Throws in the same way.
  void remove(const EvaluationKey& key);
  /// To be called before the commit: writes the sums over the rows (RowSums), if the store has
  /// them. `others` are tables with rows that other code wrote in this transaction; they are
  /// counted. Throws in the same way.
  void write_sums(std::initializer_list<RowSums::Table> others = {});

  void committed() { committed_ = sums_; }
  /// Drops what was remembered about rows that a rollback has removed.
  void forget();
  /// The sums over the committed rows.
  const std::optional<RowSums>& sums() const { return committed_; }

 private:
  using Table = RowSums::Table;

  /// Runs an INSERT OR IGNORE with these cells, in the order in which the sum covers them.
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
  /// Subtracts the row with this key from the sum, before it is replaced.
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

  /// The number of a source; a new one is added.
  std::int64_t source_id(const std::string& name);

  sqlite::Connection& connection_;
  sqlite::Statement candidate_, known_candidate_, phrase_, pair_, evaluation_, used_, unused_,
      iteration_, race_step_, elimination_, elite_, totals_, design_state_, campaign_state_,
      worker_, conflict_, failure_, event_, attempt_, command_, forgiven_, new_source_,
      find_source_;
  /// Select the cells of one row, in the order in which its sum covers them.
  sqlite::Statement evaluation_cells_, used_cells_, totals_cells_, design_cells_, campaign_cells_,
      command_cells_;
  std::optional<RowSums> sums_;  ///< empty: the store has none
  std::optional<RowSums> committed_;
  /// Hashes of the totals of racing candidates, which each step replaces.
  std::unordered_map<std::int64_t, std::uint64_t> totals_hashes_;
  std::unordered_map<std::string, std::int64_t> sources_;
  PhraseBook phrases_;
  bool phrases_are_loaded_ = false;
};

/// Throws std::invalid_argument when a number of the row is NaN or infinite: SQLite would store a
/// NaN as NULL, and a score is never either of them.
void require_finite(const Row& row);

}  // namespace swarmsmith
