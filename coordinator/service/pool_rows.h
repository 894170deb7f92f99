#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "coordinator/pool/budgets.h"
#include "coordinator/pool/scheduler.h"
#include "storage/rows.h"

namespace swarmsmith {

/// Rows for the stores of all campaigns: workers, and events that belong to no campaign. A worker's
/// row comes before every row of any campaign that names the worker. A row that a principal causes
/// needs room in the principal's budget; without room it is counted and left out, or, if it is a
/// worker's row, written later.
class PoolRows {
 public:
  /// Both must outlive it.
  PoolRows(const Scheduler& scheduler, Budgets& budgets)
      : scheduler_(scheduler), budgets_(budgets) {}

  void put(Row row) { rows_.push_back(std::move(row)); }
  /// If the budget has no room for a worker's row, it is written later, with the worker's state at
  /// that time: before a row that names the worker, or when there is room. A worker that left
  /// without having done anything never gets a row.
  void put_worker(const WorkerRow& row, TimePoint now);
  /// To be called before the rows of the workers that may work again.
  void put_forgiven(const std::string& principal);
  /// Writes rows of workers for which there was no room earlier; at most once a second.
  void write_late_workers(TimePoint now);

  /// Whether a row of this size that names the worker may be written; puts the worker's row first.
  bool may_name(WorkerNumber worker, std::string_view kind, std::size_t bytes, TimePoint now);
  /// The same for an event, which may name a worker.
  bool may_note(const Noted& noted, TimePoint now);
  /// Puts the worker's row now, if it has not been put yet.
  void name_worker(WorkerNumber worker);

  /// The rows that were put since `clear`.
  const std::vector<Row>& rows() const { return rows_; }
  void clear() { rows_.clear(); }

 private:
  /// Whether a row caused by the principal may be written; if not, it is counted.
  bool may_write(const std::string& principal, std::string_view kind, std::size_t bytes,
                 TimePoint now);
  void write_worker(const WorkerRow& row);
  const Principal* principal_of_worker(WorkerNumber worker) const;

  const Scheduler& scheduler_;
  Budgets& budgets_;
  std::vector<Row> rows_;
  std::unordered_set<WorkerNumber> written_;  ///< workers whose row is in the stores
  std::map<WorkerNumber, WorkerRow> late_;    ///< rows for which there was no room
  /// Principals, each with the identity of a quarantined process, or an empty one for all.
  std::set<std::pair<std::string, std::string>> told_in_quarantine_;
  TimePoint wrote_late_;
};

}  // namespace swarmsmith
