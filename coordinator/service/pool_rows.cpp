#include "coordinator/service/pool_rows.h"

#include <algorithm>
#include <utility>

namespace swarmsmith {
namespace {

constexpr Duration kWriteLate = std::chrono::seconds(1);

}  // namespace

bool PoolRows::may_write(const std::string& principal, std::string_view kind, std::size_t bytes,
                         TimePoint now) {
  const Principal* known = scheduler_.principals().find(principal);
  if (known != nullptr && known->local) return true;
  const Source source{principal, known == nullptr || known->is_stranger()};
  if (budgets_.may_write(source, bytes, now)) return true;
  budgets_.leave_out(kind);
  return false;
}

const Principal* PoolRows::principal_of_worker(WorkerNumber worker) const {
  const auto at = scheduler_.workers().all().find(worker);
  return at == scheduler_.workers().all().end() ? nullptr : at->second.principal;
}

bool PoolRows::may_name(WorkerNumber worker, std::string_view kind, std::size_t bytes,
                        TimePoint now) {
  if (worker == 0) return true;
  const Principal* principal = principal_of_worker(worker);
  if (!may_write(principal != nullptr ? principal->name : "", kind, bytes, now)) return false;
  name_worker(worker);
  return true;
}

void PoolRows::name_worker(WorkerNumber worker) {
  if (worker == 0 || written_.contains(worker)) return;
  if (const auto late = late_.find(worker); late != late_.end()) {
    return write_worker(WorkerRow(late->second));
  }
  const auto at = scheduler_.workers().all().find(worker);
  if (at == scheduler_.workers().all().end()) return;
  write_worker(
      row_of(at->second, at->second.connected ? WorkerState::Connected : WorkerState::Left));
}

bool PoolRows::may_note(const Noted& noted, TimePoint now) {
  if (!noted.source.empty() && !may_write(noted.source, noted.row.kind, bytes_of(noted.row), now)) {
    return false;
  }
  name_worker(noted.worker);
  return true;
}

void PoolRows::put_worker(const WorkerRow& row, TimePoint now) {
  const Principal* principal = scheduler_.principals().find(row.principal);
  const bool is_local = principal != nullptr && principal->local;
  const bool is_new = !written_.contains(row.id);
  const bool is_quarantined = row.state == WorkerState::Quarantined;
  // A later process needs only one such row for each principal, or for each process that is blamed.
  if (const auto quarantine = quarantine_of(row)) {
    const auto told = std::ranges::count_if(
        told_in_quarantine_, [&](const auto& each) { return each.first == row.principal; });
    const bool is_enough = told >= static_cast<std::ptrdiff_t>(Principal::kMostLiars);
    if (!is_enough &&
        told_in_quarantine_.emplace(quarantine->principal, quarantine->identity).second) {
      return write_worker(row);
    }
  }
  const bool is_here = row.state == WorkerState::Connected || is_quarantined;
  if (!is_local && is_new && !is_here && row.done == 0 && row.failed == 0) {
    late_.erase(row.id);
    budgets_.leave_out("worker");
    return;
  }
  const Source source{row.principal, principal == nullptr || principal->is_stranger()};
  if (is_local || budgets_.may_write(source, is_new ? bytes_of(row) : kChangeBytes, now)) {
    write_worker(row);
  } else {
    late_[row.id] = row;
  }
}

void PoolRows::put_forgiven(const std::string& principal) {
  std::erase_if(told_in_quarantine_, [&](const auto& told) { return told.first == principal; });
  rows_.emplace_back(ForgivenRow{principal});
}

void PoolRows::write_worker(const WorkerRow& row) {
  rows_.emplace_back(row);
  written_.insert(row.id);
  late_.erase(row.id);
}

void PoolRows::write_late_workers(TimePoint now) {
  if (late_.empty() || now - wrote_late_ < kWriteLate) return;
  wrote_late_ = now;
  for (const auto& [number, row] : std::exchange(late_, {})) {
    // Skip a worker that is forgotten by now: it did nothing.
    if (principal_of_worker(number) != nullptr) put_worker(row, now);
  }
}

}  // namespace swarmsmith
