#include "coordinator/pool/scheduler.h"

#include "base/assert.h"

namespace swarmsmith {

Scheduler::Scheduler(SchedulerOptions options)
    : options_(std::move(options)),
      workers_(options_.first_worker),
      signer_(options_.lease_secret),
      closed_(options_.campaigns.size()),
      estimates_us_(options_.campaigns.size()) {
  SWARMSMITH_ASSERT(!options_.campaigns.empty() && options_.campaigns.size() <= kMaxCampaigns,
                    "a coordinator has some campaigns, and not too many for its keys");
  for (const std::string& name : options_.quarantined)
    principals_.at(name).quarantined = true;
}

std::deque<StoredWord> Scheduler::know(std::uint32_t campaign, std::span<const StoredScore> known,
                                       const StoredTrust& trust) {
  const std::int64_t every =
      options_.evaluates_programs ? 0 : options_.campaigns[campaign].audit_every;
  std::deque<StoredWord> unaudited;
  for (const StoredScore& score : known) {
    const PackedKey key = pack(score.key, campaign);
    done_.insert(key, score.status, score.score, score.state_digest);
    const auto name = trust.principals.find(score.worker);
    if (name == trust.principals.end() || trust.audited.contains(score.key)) continue;
    ++principals_.at(name->second).unchecked_of(campaign);
    if (every == 0 || score.status != EvaluationStatus::Ok) continue;
    if (!is_drawn(key, 1.0 / static_cast<double>(every))) continue;
    unaudited.push_back({score.key,
                         {.what = Said::What::Score,
                          .worker = static_cast<WorkerNumber>(score.worker),
                          .principal = name->second,
                          .score = score.score,
                          .state_digest = score.state_digest,
                          .taken = true}});
  }
  return unaudited;
}

void Scheduler::add(std::vector<Task> tasks) {
  for (Task& task : tasks) {
    if (TaskRecord* record = leases_.find(key_of(task)); record != nullptr) {
      SWARMSMITH_ASSERT(record->task.ahead && !task.ahead, "a task is wanted once");
      leases_.promote(*record, latest_);
      continue;
    }
    // Look-ahead whose outcome was told after it became wanted and before this was said.
    if (done_.find(key_of(task)) != nullptr) continue;
    leases_.add(std::move(task), latest_);
  }
}

void Scheduler::drop(std::span<const PackedKey> keys) {
  for (const PackedKey key : keys) {
    const TaskRecord* record = leases_.find(key);
    if (record != nullptr && record->task.ahead && !record->lease) leases_.remove(key);
  }
}

std::vector<SchedulerAction> Scheduler::take_actions() {
  return std::exchange(actions_, {});
}

const WorkerEntry* Scheduler::connected_worker(WorkerNumber number) {
  const WorkerEntry* entry = workers_.of_number(number);
  return entry != nullptr && entry->connected ? entry : nullptr;
}

void Scheduler::note(const char* severity, const char* kind,
                     std::initializer_list<EventField> fields,
                     std::optional<std::uint32_t> campaign, const Principal* source,
                     WorkerNumber worker) {
  actions_.emplace_back(Noted{campaign, pool_event(severity, kind, fields),
                              source != nullptr ? source->name : "", worker});
}

void Scheduler::stop(std::uint32_t campaign, const std::string& reason, bool distrusted) {
  if (!stopped_.insert(campaign).second) return;
  // What a program wrote may be long; it is in the table of failures.
  note("error", "campaign stopped", {{"reason", reason.substr(0, reason.find('\n'))}}, campaign);
  actions_.emplace_back(StopCampaign{campaign, reason, distrusted});
}

void Scheduler::forget(std::uint32_t campaign) {
  stopped_.insert(campaign);
  leases_.remove_all(campaign);
  const auto is_of = [&](PackedKey key) { return campaign_of(key) == campaign; };
  std::erase_if(disputed_, [&](const auto& each) { return is_of(each.first); });
  for (const Case& one : cases_.forget(campaign)) {
    for (const Said& said : one.said)
      let_go(said);
  }
  for (auto& [name, principal] : principals_.all()) {
    std::erase_if(principal.waiting, [&](const auto& each) { return is_of(each.first); });
    try_waiting(principal, latest_);
  }
}

}  // namespace swarmsmith
