// What becomes of outcomes: rows for the stores, tickets, and acknowledgements when all is on disk.

#include <algorithm>
#include <iterator>

#include "base/assert.h"
#include "coordinator/coordinator.h"
#include "proto/wire.h"

namespace swarmsmith {

void Coordinator::put_row(const Row& row) {
  pool_rows_.push_back(row);
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
    std::ranges::move(replies, std::back_inserter(actions_));
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
