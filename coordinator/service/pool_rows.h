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

/// Rows for the stores of all campaigns: workers, and events that are of no campaign. The row of a
/// worker comes before every row that names the worker, in whatever campaign. A row that is
/// somebody else's doing needs room in the budget of that principal: without it, it is counted and
/// left out, or, of a worker, comes later.
class PoolRows {
 public:
  /// Both must outlive it.
  PoolRows(const Scheduler& scheduler, Budgets& budgets)
      : scheduler_(scheduler), budgets_(budgets) {}

  void put(Row row) { rows_.push_back(std::move(row)); }
  /// The row of a worker comes later when there is no room for it: before anything that names the
  /// worker, or as it is then. Of one that left without having done anything it never comes.
  void put_worker(const WorkerRow& row, TimePoint now);
  /// Before the rows of the workers that it lets work again.
  void put_forgiven(const std::string& principal);
  /// Rows of workers for which there was no room; at most once a second.
  void write_late_workers(TimePoint now);

  /// Whether a row of this size that names the worker may be written; its own row then comes first.
  bool may_name(WorkerNumber worker, std::string_view kind, std::size_t bytes, TimePoint now);
  /// The same of an event, which may name one.
  bool may_note(const Noted& noted, TimePoint now);
  /// The worker's row comes now, unless it has.
  void name_worker(WorkerNumber worker);

  /// What was put since `clear`.
  const std::vector<Row>& rows() const { return rows_; }
  void clear() { rows_.clear(); }

 private:
  /// Whether a row that is the principal's doing may be written; else it is counted.
  bool may_write(const std::string& principal, std::string_view kind, std::size_t bytes,
                 TimePoint now);
  void write_worker(const WorkerRow& row);
  const Principal* principal_of_worker(WorkerNumber worker) const;

  const Scheduler& scheduler_;
  Budgets& budgets_;
  std::vector<Row> rows_;
  std::unordered_set<WorkerNumber> written_;  ///< those whose row is in the stores
  std::map<WorkerNumber, WorkerRow> late_;    ///< rows for which there was no room
  /// Principals, and which of their processes, or none for all.
  std::set<std::pair<std::string, std::string>> told_in_quarantine_;
  TimePoint wrote_late_;
};

}  // namespace swarmsmith
