// What becomes of outcomes: rows for the stores, tickets, and acknowledgements when all is on disk.

#include <algorithm>
#include <iterator>

#include "base/assert.h"
#include "coordinator/service/coordinator.h"
#include "proto/wire.h"

namespace swarmsmith {
namespace {

constexpr Duration kWriteLate = std::chrono::seconds(1);

}  // namespace

void Coordinator::put_row(const Row& row) {
  pool_rows_.push_back(row);
}

void Coordinator::put_rows(std::vector<EventRow> rows) {
  std::ranges::move(rows, std::back_inserter(pool_rows_));
}

bool Coordinator::may_write(const std::string& principal, std::string_view kind, std::size_t bytes,
                            TimePoint now) {
  const Principal* known = scheduler_.principals().find(principal);
  if (known != nullptr && known->local) return true;
  const Source source{principal, known == nullptr || known->is_stranger()};
  if (budgets_.may_write(source, bytes, now)) return true;
  budgets_.leave_out(kind);
  return false;
}

const Principal* Coordinator::principal_of_worker(WorkerNumber worker) const {
  const auto at = scheduler_.workers().all().find(worker);
  return at == scheduler_.workers().all().end() ? nullptr : at->second.principal;
}

bool Coordinator::may_name(WorkerNumber worker, std::string_view kind, std::size_t bytes,
                           TimePoint now) {
  if (worker == 0) return true;
  const Principal* principal = principal_of_worker(worker);
  if (!may_write(principal != nullptr ? principal->name : "", kind, bytes, now)) return false;
  name_worker(worker);
  return true;
}

void Coordinator::name_worker(WorkerNumber worker) {
  if (worker == 0 || written_.contains(worker)) return;
  if (const auto late = late_.find(worker); late != late_.end()) {
    return write_worker(WorkerRow(late->second));
  }
  const auto at = scheduler_.workers().all().find(worker);
  if (at == scheduler_.workers().all().end()) return;
  write_worker(
      row_of(at->second, at->second.connected ? WorkerState::Connected : WorkerState::Left));
}

void Coordinator::put_event(Noted& noted, TimePoint now) {
  if (!noted.source.empty() && !may_write(noted.source, noted.row.kind, bytes_of(noted.row), now)) {
    return;
  }
  name_worker(noted.worker);
  if (!noted.campaign) return put_row(noted.row);
  campaigns_[*noted.campaign].own_rows.emplace_back(std::move(noted.row));
}

/// The row of a worker comes later when there is no room for it: before anything that names the
/// worker, or as it is then. Of one that left without having done anything it never comes.
void Coordinator::put_worker(const WorkerRow& row, TimePoint now) {
  const Principal* principal = scheduler_.principals().find(row.principal);
  const bool is_local = principal != nullptr && principal->local;
  const bool is_new = !written_.contains(row.id);
  const bool is_quarantined = row.state == WorkerState::Quarantined;
  // One such row of a principal tells a later process.
  if (is_quarantined && told_in_quarantine_.insert(row.principal).second) return write_worker(row);
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

void Coordinator::write_worker(const WorkerRow& row) {
  put_row(row);
  written_.insert(row.id);
  late_.erase(row.id);
}

void Coordinator::write_late_workers(TimePoint now) {
  if (late_.empty() || now - wrote_late_ < kWriteLate) return;
  wrote_late_ = now;
  for (const auto& [number, row] : std::exchange(late_, {})) {
    // Forgotten meanwhile: it did nothing.
    if (principal_of_worker(number) != nullptr) put_worker(row, now);
  }
}

void Coordinator::append(std::uint32_t index) {
  Campaign& campaign = campaigns_[index];
  std::vector<Row> rows = campaign.source->take_rows();
  note_if_all_is_paused(campaign);
  rows.insert(rows.end(), std::make_move_iterator(campaign.own_rows.begin()),
              std::make_move_iterator(campaign.own_rows.end()));
  campaign.own_rows.clear();
  rows.insert(rows.end(), pool_rows_.begin(), pool_rows_.end());
  std::vector<SendFrame> replies = std::exchange(campaign.replies, {});
  if (rows.empty()) {
    for (SendFrame& reply : replies)
      actions_.emplace_back(std::move(reply));
    return;
  }
  Unit unit{.replies = std::move(replies)};
  for (const Row& row : rows) {
    if (const auto* evaluation = std::get_if<EvaluationRow>(&row)) {
      unit.keys.push_back(pack(evaluation->key, index));
    }
  }
  campaign.unappended.push_back(std::move(unit));
  actions_.emplace_back(AppendRows{index, std::move(rows), pool_rows_.size()});
}

void Coordinator::on_appended(std::uint32_t index, std::uint64_t ticket) {
  Campaign& campaign = campaigns_[index];
  SWARMSMITH_ASSERT(!campaign.unappended.empty(), "a ticket belongs to rows that were given out");
  SWARMSMITH_ASSERT(campaign.appended.empty() || campaign.appended.back().ticket < ticket,
                    "tickets count up");
  campaign.appended.push_back(std::move(campaign.unappended.front()));
  campaign.appended.back().ticket = ticket;
  campaign.unappended.pop_front();
}

void Coordinator::on_committed(std::uint32_t index, std::uint64_t ticket) {
  std::deque<Unit>& appended = campaigns_[index].appended;
  std::map<WorkerNumber, std::vector<PackedKey>> keys;
  while (!appended.empty() && appended.front().ticket <= ticket) {
    for (const PackedKey key : appended.front().keys) {
      const auto at = waiting_.find(key);
      if (at == waiting_.end()) continue;
      keys[at->second.first].push_back(key);
      for (const WorkerNumber other : at->second.others)
        keys[other].push_back(key);
      waiting_.erase(at);
    }
    std::ranges::move(appended.front().replies, std::back_inserter(actions_));
    appended.pop_front();
  }
  acknowledge(keys);
}

/// On disk already: acknowledged now. Else with the first copy.
void Coordinator::repeat(const OutcomeRepeated& action) {
  const auto at = waiting_.find(action.key);
  if (at == waiting_.end()) {
    acknowledge({{action.worker, {action.key}}});
    return;
  }
  Waiting& waiting = at->second;
  if (waiting.first == action.worker || std::ranges::count(waiting.others, action.worker) > 0) {
    return;
  }
  waiting.others.push_back(action.worker);
}

void Coordinator::acknowledge(const std::map<WorkerNumber, std::vector<PackedKey>>& keys) {
  for (const auto& [number, all] : keys) {
    const WorkerEntry* worker = scheduler_.connected_worker(number);
    if (worker == nullptr) continue;
    for (std::size_t at = 0; at < all.size(); at += kMaxItemsPerMessage) {
      const std::span<const PackedKey> some(
          all.data() + at, std::min<std::size_t>(kMaxItemsPerMessage, all.size() - at));
      send(worker->peer, acknowledgement_of(some, worker->hello.incarnation));
    }
  }
}

bool Coordinator::settled() const {
  return waiting_.empty() && std::ranges::all_of(campaigns_, [](const Campaign& campaign) {
           return campaign.unappended.empty() && campaign.appended.empty();
         });
}

}  // namespace swarmsmith
