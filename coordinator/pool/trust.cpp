// Trust in workers: authority over a task, trials of new workers, audits, strikes, quarantine.

#include "coordinator/pool/trust.h"

#include <algorithm>
#include <set>
#include <utility>

#include "base/assert.h"
#include "base/plain_text.h"
#include "storage/answer.h"

namespace swarmsmith {
namespace {

/// Failing at one of this many evaluations is more than bad luck.
constexpr std::int64_t kOneOf = 20;
/// How many first results of a principal the referee evaluates again before any result counts.
constexpr std::int64_t kTrial = 2;
/// The most tasks that a worker of an unknown principal may hold: enough for its trial.
constexpr std::size_t kRoomOnTrial = 64;
/// A principal's n-th result is audited with probability this / n, or the usual rate if higher.
constexpr double kDenseAtFirst = 4;
/// Strangers that were given this many tasks and have delivered no result must wait while others
/// work, because races wait for the tasks that they take. Each further task adds a second.
constexpr std::int64_t kMostAstray = 32;
constexpr std::int64_t kMostSecondsToWait = 300;
/// Audits are left out if they would wait for the referee longer than this.
constexpr double kMostBacklogUs = 2e6;

}  // namespace

Trust::Trust(TaskBook& book, WorkerRegistry& workers)
    : book_(&book), workers_(&workers), signer_(book.options.lease_secret) {
  for (const Quarantine& each : book.options.quarantined) {
    Principal& principal = principals_.at(each.principal);
    const Principal::Cause cause{.reason = each.reason, .since = each.since};
    if (!each.identity.empty()) principal.liars.emplace(each.identity, cause);
    // Quarantine lasts across restarts (decision 23). The third process puts the whole principal
    // there.
    if (!each.identity.empty() && principal.liars.size() < Principal::kMostLiars) continue;
    principal.quarantined = true;
    principal.cause = cause;
  }
}

const Principal::Cause* Trust::cause_against(const Principal& principal,
                                             const std::string& identity) const {
  if (principal.quarantined) return &principal.cause;
  const auto liar = principal.liars.find(hexadecimal(identity));
  return liar == principal.liars.end() ? nullptr : &liar->second;
}

std::deque<StoredWord> Trust::know(std::uint32_t campaign, std::span<const StoredScore> known,
                                   const StoredTrust& trust) {
  const std::int64_t every =
      book_->options.evaluates_programs ? 0 : book_->options.campaigns[campaign].audit_every;
  std::deque<StoredWord> unaudited;
  for (const StoredScore& score : known) {
    const PackedKey key = pack(score.key, campaign);
    book_->done.insert(key, score.status, score.measured);
    const auto name = trust.principals.find(score.worker);
    // Not counted: results of workers without a principal in the store, and results that were made
    // again.
    if (name == trust.principals.end() || trust.audited.contains(score.key)) continue;
    ++principals_.at(name->second)
          .standing(static_cast<WorkerNumber>(score.worker))
          .unchecked_of(campaign);
    if (every == 0 || score.status != EvaluationStatus::Ok) continue;
    // The draw depends on key and secret alone, so audits that a crash prevented are found again.
    if (!is_drawn(key, 1.0 / static_cast<double>(every))) continue;
    unaudited.push_back({score.key,
                         {.what = Said::What::Score,
                          .worker = static_cast<WorkerNumber>(score.worker),
                          .principal = name->second,
                          .measured = score.measured,
                          .taken = true}});
  }
  return unaudited;
}

/// It has a lease of this process, or a signature of one: so requested results can be told from
/// invented ones without remembering all past leases, even after a crash.
bool Trust::may_answer(const WorkerEntry& entry, const Result& result) {
  const bool lingered = book_->leases.loads().settle(entry.number, result.key);
  TaskRecord* record = book_->leases.find(result.key);
  // Signed for another machine under the same key, before a crash (decision 19).
  if (result.signature != 0 && record != nullptr && !signer_.is_of(result.signature, record->task))
    return false;
  if (lingered || (record != nullptr && record->lease_of(entry.number) != nullptr)) return true;
  return signer_.is_ours(result.signature, result.key, result.attempt, entry.principal->name);
}

bool Trust::is_on_trial(const WorkerEntry& entry, std::uint32_t campaign) const {
  const bool audits =
      !book_->options.evaluates_programs && book_->options.campaigns[campaign].audit_every > 0;
  // Workers that this process started are trusted from the beginning.
  if (!audits || entry.principal->local) return false;
  const Principal::Standing* standing = entry.principal->find_standing(entry.number);
  // Decision 19, "Newcomers are on trial".
  return standing == nullptr || standing->confirmed < kTrial;
}

void Trust::on_score(WorkerEntry& entry, TaskRecord& record, const Result& result, TimePoint now) {
  const bool is_claim = result.rejected && !book_->options.evaluates_programs;
  if (is_claim) {
    // No row will be written for this statement.
    book_->act(SendAcknowledged{entry.peer, entry.hello.incarnation, {result.key}});
    return claim(entry, record, Said::What::NoScore);
  }
  if (is_on_trial(entry, record.task.campaign)) {
    return hold_back(entry, record, result, now);
  }
  take(entry, record, result, now);
}

/// The result waits for the referee's ruling on it, or on other results of its principal. Meanwhile
/// the task is parked: another stranger's result would have to wait too, and a proven worker is not
/// needed for a task that is being ruled on.
void Trust::hold_back(WorkerEntry& entry, TaskRecord& record, const Result& result, TimePoint now) {
  Principal& principal = *entry.principal;
  const Case* known = cases_.find(result.key);
  const bool is_said = known != nullptr && std::ranges::any_of(known->said, [&](const Said& said) {
                         return said.principal == principal.name;
                       });
  if (record.lease_of(entry.number) != nullptr) book_->leases.requeue(record, entry.number);
  if (!record.lease) book_->leases.park(record);
  if (is_said) return;
  principal.waiting.try_emplace(result.key, Principal::Waiting{entry.number, result});
  try_waiting(principal, entry.number, now);
}

/// Passes as many of its results to the referee as its trial needs.
void Trust::try_waiting(Principal& principal, WorkerNumber worker, TimePoint now) {
  const WorkerNumber judged = principal.judged_as(worker);
  Principal::Standing& standing = principal.standing(worker);
  while (standing.confirmed + standing.on_trial < kTrial) {
    const auto next = std::ranges::find_if(principal.waiting, [&](const auto& each) {
      return principal.judged_as(each.second.worker) == judged;
    });
    if (next == principal.waiting.end()) break;
    const Principal::Waiting one = std::move(principal.waiting.extract(next).mapped());
    const TaskRecord* record = book_->leases.find(one.result.key);
    // Another worker was faster: the result is compared when it is sent again.
    if (record == nullptr) continue;
    ++standing.on_trial;
    cases_.open(record->task,
                Said{.what = Said::What::Score,
                     .worker = one.worker,
                     .principal = principal.name,
                     .measured = one.result.measured,
                     .attempt = one.result.attempt,
                     .on_trial = true},
                false);
  }
  if (standing.confirmed >= kTrial) take_waiting(principal, worker, now);
}

/// The worker is known now, so its waiting results count.
void Trust::take_waiting(Principal& principal, WorkerNumber worker, TimePoint now) {
  std::vector<std::pair<PackedKey, Principal::Waiting>> taken;
  for (auto at = principal.waiting.begin(); at != principal.waiting.end();) {
    if (principal.judged_as(at->second.worker) != principal.judged_as(worker)) {
      ++at;
      continue;
    }
    taken.emplace_back(at->first, std::move(at->second));
    at = principal.waiting.erase(at);
  }
  for (const auto& [key, one] : taken) {
    TaskRecord* record = book_->leases.find(key);
    WorkerEntry* entry = workers_->of_number(one.worker);
    if (record == nullptr) continue;
    if (entry != nullptr) {
      take(*entry, *record, one.result, now);
    } else {
      book_->leases.unpark(*record);
    }
  }
  update_room(principal);
}

/// A later process draws the same numbers, because only the secret and the key matter: it can find
/// the audits that this process did not finish. Workers cannot predict the selection.
bool Trust::is_drawn(PackedKey key, double share) const {
  return static_cast<double>(signer_.draw(key)) < share * 0x1p64;
}

void Trust::audit(const TaskRecord& record, const WorkerEntry& entry, const Result& result) {
  const std::int64_t every = book_->policy_of(record).audit_every;
  if (every == 0 || book_->options.evaluates_programs || result.rejected) return;
  // If the referee already has a case for this evaluation, another result costs nothing.
  const bool has_word = cases_.knows(result.key);
  const double backlog_us = referee_us_ * static_cast<double>(cases_.size());
  if (!has_word && cases_.audits() > 0 && backlog_us > kMostBacklogUs) return;
  const Principal& principal = *entry.principal;
  const Principal::Standing* standing = principal.find_standing(entry.number);
  const std::int64_t taken = standing == nullptr ? 0 : standing->taken;
  // 4/n for the n-th result (docs/protocol.md, "Trust"): who lies early is found early, and the sum
  // over n results grows only with their logarithm.
  const double dense = principal.local ? 0 : kDenseAtFirst / static_cast<double>(taken + 1);
  const double share = std::max(1.0 / static_cast<double>(every), dense);
  if (!has_word && !is_drawn(result.key, share)) return;
  cases_.open(record.task,
              Said{.what = Said::What::Score,
                   .worker = entry.number,
                   .principal = entry.principal->name,
                   .measured = result.measured,
                   .taken = true},
              true);
}

void Trust::update_room(Principal& principal) {
  for (const WorkerNumber number : principal.workers) {
    WorkerEntry* entry = workers_->of_number(number);
    SWARMSMITH_ASSERT(entry != nullptr, "a removed worker is removed from its principal, too");
    set_credit(*entry, entry->credit);
  }
}

void Trust::go_astray(Principal& principal, std::size_t leases, TimePoint now) {
  if (leases == 0 || principal.is_proven()) return;
  // A worker does not wait if it is the only one, because it delays no other.
  principal.astray += static_cast<std::int64_t>(leases);
  if (principal.astray < kMostAstray || proven_present() == 0) return;
  principal.waits_until =
      now + std::chrono::seconds(std::min(principal.astray, kMostSecondsToWait));
  update_room(principal);
}

void Trust::set_credit(WorkerEntry& entry, std::uint32_t credit) {
  entry.credit = std::min(credit, book_->options.max_credit);
  entry.asked |= credit > 0;
  const Principal& principal = *entry.principal;
  std::size_t most = entry.credit;
  // A liar must not occupy the referee: no more tasks until it has decided (docs/protocol.md, "Who
  // is blamed").
  if (principal.claims >= Principal::kMostClaims) most = 0;
  const bool is_new = !book_->options.evaluates_programs && !principal.is_proven();
  if (is_new) most = std::min(most, book_->now < principal.waits_until ? 0 : kRoomOnTrial);
  SWARMSMITH_ASSERT(most <= entry.credit, "a worker never gets more than it asked for");
  const auto slots = static_cast<std::size_t>(entry.usable() ? entry.hello.slots : 0);
  book_->leases.loads().set_capacity(entry.number, slots, slots > 0 ? most : 0);
}

void Trust::strike(Principal& principal, WorkerNumber worker, TimePoint now) {
  if (book_->options.quarantine_after == 0) return;
  // A share, and not only a number, because even a good worker fails now and then in a long
  // campaign (orchestration facts, 5 "Poison workers").
  Principal::Standing& standing = principal.standing(worker);
  ++standing.strikes;
  const std::int64_t tried = standing.taken + standing.strikes;
  const bool often =
      standing.strikes >= book_->options.quarantine_after && standing.strikes * kOneOf >= tried;
  if (often) quarantine(principal, worker, "fails at evaluations that succeed elsewhere", now);
}

/// For each campaign, the number of the convicted worker's evaluations that were not audited.
/// Without a key, a worker that has left may have been the same program under another id, so its
/// evaluations count too; workers that are connected are judged separately.
std::vector<std::int64_t> Trust::unchecked_beside(const Principal& principal,
                                                  WorkerNumber worker) const {
  std::set<WorkerNumber> others;
  for (const WorkerNumber number : principal.workers) {
    const bool is_other = principal.judged_as(number) != principal.judged_as(worker);
    if (is_other && workers_->of_number(number)->usable()) others.insert(number);
  }
  std::vector<std::int64_t> sum;
  for (const auto& [judged, standing] : principal.standings) {
    if (others.contains(judged)) continue;
    sum.resize(std::max(sum.size(), standing.unchecked.size()));
    for (std::size_t i = 0; i < standing.unchecked.size(); ++i)
      sum[i] += standing.unchecked[i];
  }
  return sum;
}

/// Its statement is wrong, so its earlier results that were not audited cannot be trusted either.
void Trust::convict(Principal& principal, WorkerNumber worker, const std::string& evidence,
                    TimePoint now) {
  if (principal.quarantined) return;
  quarantine(principal, worker, evidence, now);
  const std::vector<std::int64_t> all_unchecked = unchecked_beside(principal, worker);
  for (std::uint32_t campaign = 0; campaign < all_unchecked.size(); ++campaign) {
    const std::int64_t unchecked = all_unchecked[campaign];
    if (unchecked == 0 || book_->is_stopped(campaign)) continue;
    book_->stop(campaign,
                "scores in the store are not reliable: " + evidence + ", and " +
                    counted(unchecked, "result") + " of " + principal.name +
                    (unchecked == 1 ? " is" : " are") +
                    " stored without a check. `swarmsmith recover STORE --without-key \"" +
                    key_of_principal(principal.name) +
                    "\" -o NEW.db` makes a store without its results, and the campaign continues "
                    "from there with --store NEW.db",
                true);
  }
}

void Trust::quarantine(Principal& principal, WorkerNumber worker, const std::string& reason,
                       TimePoint now) {
  if (principal.quarantined) return;
  if (principal.is_blamed_by_process()) return quarantine_process(principal, worker, reason, now);
  const Principal::Standing& standing = principal.standing(worker);
  book_->note("error", "workers in quarantine",
              {{"who", principal.name},
               {"reason", reason},
               {"results in the store", standing.taken},
               {"made again", standing.confirmed}});
  quarantine_all(principal, reason, now);
}

void Trust::quarantine_all(Principal& principal, const std::string& reason, TimePoint now) {
  principal.quarantined = true;
  principal.cause = {.reason = reason, .at = now};
  ++book_->counters.quarantined;
  const std::string sentence = sentence_of_quarantine(principal, principal.cause);
  for (const WorkerNumber number : principal.workers) {
    WorkerEntry& entry = *workers_->of_number(number);
    if (!entry.quarantined) isolate(entry, sentence, now);
  }
  drop_waiting(principal);
  if (workers_->trusted() == 0) book_->note("error", "no trusted worker is left", {});
}

void Trust::quarantine_process(Principal& principal, WorkerNumber worker, const std::string& reason,
                               TimePoint now) {
  WorkerEntry* entry = workers_->of_number(worker);
  // For a worker of an earlier coordinator process, only the number is known, and it counts.
  const std::string id =
      entry != nullptr ? hexadecimal(entry->hello.identity) : "worker " + std::to_string(worker);
  const auto [liar, is_new] =
      principal.liars.emplace(id, Principal::Cause{.reason = reason, .at = now});
  if (!is_new) return;
  const Principal::Standing& standing = principal.standing(worker);
  book_->note("error", "workers in quarantine",
              {{"who", principal.name},
               {"reason", reason},
               {"worker", worker},
               {"results in the store", standing.taken},
               {"made again", standing.confirmed}},
              std::nullopt, nullptr, worker);
  if (principal.liars.size() >= Principal::kMostLiars) {
    // Otherwise a worker that keeps coming back under new ids would occupy the referee.
    const std::string all = std::to_string(principal.liars.size()) +
                            " of its processes are, the last one because " + reason;
    book_->note("error", "workers in quarantine", {{"who", principal.name}, {"reason", all}});
    return quarantine_all(principal, all, now);
  }
  ++book_->counters.quarantined;
  if (entry != nullptr && !entry->quarantined)
    isolate(*entry, sentence_of_quarantine(principal, liar->second), now);
  drop_waiting(principal, worker);
  if (workers_->trusted() == 0) book_->note("error", "no trusted worker is left", {});
}

/// Quarantines the worker, and ends its leases.
void Trust::isolate(WorkerEntry& entry, const std::string& sentence, TimePoint now) {
  const WorkerNumber number = entry.number;
  const std::list<PackedKey>& leases = book_->leases.leases_of(number);
  const std::vector<PackedKey> keys(leases.rbegin(), leases.rend());
  for (const PackedKey key : keys) {
    TaskRecord& record = *book_->leases.find(key);
    book_->note_attempt(record, number, AttemptOutcome::Returned, now);
    if (book_->leases.requeue(record, number)) ++book_->counters.requeued;
  }
  SWARMSMITH_ASSERT(book_->leases.leases_of(number).empty(),
                    "a worker in quarantine holds no leases");
  workers_->quarantine(entry);
  set_credit(entry, 0);
  book_->act(WorkerChanged{row_of(entry, WorkerState::Quarantined)});
  if (entry.connected) book_->act(SendNotice{entry.peer, entry.hello.incarnation, sentence});
}

/// Drops the results of the worker (none: of all workers) that wait, as if they had not been sent.
void Trust::drop_waiting(Principal& principal, std::optional<WorkerNumber> worker) {
  std::erase_if(principal.waiting, [&](const auto& each) {
    const auto& [key, one] = each;
    if (worker && one.worker != *worker) return false;
    TaskRecord* record = book_->leases.find(key);
    if (record != nullptr && !cases_.knows(key)) book_->leases.unpark(*record);
    return true;
  });
}

std::vector<std::string> Trust::forgive(std::string_view word, const std::string& by,
                                        TimePoint now) {
  book_->now = now;
  std::vector<std::string> names;
  // A key that is quarantined at all addresses is forgiven at all of them.
  const std::string key = key_of_principal(std::string(word));
  const Principal* whole = principals_.find(key);
  const bool is_whole = whole != nullptr && whole->quarantined;
  for (auto& [name, principal] : principals_.all()) {
    if (!principal.quarantined && principal.liars.empty()) continue;
    const bool is_host = std::ranges::any_of(principal.workers, [&](WorkerNumber number) {
      return workers_->of_number(number)->hello.host == word;
    });
    const bool is_of_key = is_whole && key_of_principal(name) == key;
    if (!is_host && !is_of_key && !is_named(name, word)) continue;
    names.push_back(name);
    principal.quarantined = false;
    principal.cause = {};
    principal.liars.clear();
    // Its earlier results prove nothing now.
    principal.taken = 0;
    for (auto& [worker, standing] : principal.standings) {
      standing.taken = 0;
      standing.confirmed = 0;
      standing.strikes = 0;
    }
    // The store needs this row before those of the workers, whose states change now.
    book_->act(Forgiven{name});
    book_->note("info", "workers forgiven", {{"who", name}, {"by", by}});
    for (const WorkerNumber number : principal.workers) {
      WorkerEntry& entry = *workers_->of_number(number);
      if (!entry.quarantined) continue;
      workers_->release(entry);
      const auto state = entry.connected ? WorkerState::Connected : WorkerState::Left;
      book_->act(WorkerChanged{row_of(entry, state)});
      if (entry.connected) {
        book_->act(
            SendNotice{entry.peer, entry.hello.incarnation,
                       "a person let this worker work again: it is no longer in quarantine"});
      }
    }
    update_room(principal);
  }
  return names;
}

std::string sentence_of_quarantine(const Principal& principal, const Principal::Cause& cause) {
  const bool is_all = principal.quarantined;
  std::string text = is_all ? "workers of " + principal.name + " are" : "this worker is";
  text += " in quarantine";
  if (!cause.since.empty()) text += " since " + cause.since;
  if (!cause.reason.empty()) text += ": " + cause.reason;
  return text + ". `swarmsmith forgive STORE \"" + principal.name +
         "\"`, where the coordinator runs, lets it work again";
}

void Trust::take(WorkerEntry& entry, TaskRecord& record, const Result& result, TimePoint now) {
  SWARMSMITH_ASSERT(!entry.quarantined, "a worker in quarantine gives no results");
  const std::uint32_t campaign = record.task.campaign;
  ++entry.done;
  audit(record, entry, result);
  Principal& principal = *entry.principal;
  Principal::Standing& standing = principal.standing(entry.number);
  ++standing.unchecked_of(campaign);
  ++standing.taken;
  if (++principal.taken == 1) update_room(principal);
  // Only for programs, which have no referee: a result shows that the other worker failed alone.
  const bool failed_elsewhere =
      book_->options.evaluates_programs && record.avoid != 0 && record.avoid != entry.number;
  if (failed_elsewhere) {
    if (const WorkerEntry* other = workers_->of_number(record.avoid))
      strike(*other->principal, other->number, now);
  }
  book_->learn(campaign, result.measured.wall_us);
  book_->note_second_copy(record, entry.number, now);
  const Lease* lease = record.lease_of(entry.number);
  CampaignMeters& meters = book_->leases.meters(campaign);
  meters.evaluation.observe(
      std::chrono::microseconds(std::max<std::int64_t>(result.measured.wall_us, 0)));
  if (lease != nullptr) meters.round_trip.observe(now - lease->granted);
  Measured measured = result.measured;
  if (result.rejected) measured.score = 0;
  book_->accept(
      {.key = record.task.key,
       .campaign = campaign,
       .status = result.rejected ? EvaluationStatus::Rejected : EvaluationStatus::Ok,
       .measured = measured,
       .worker = entry.number,
       .attempt = lease != nullptr ? lease->attempt : std::max<std::int64_t>(record.attempts, 1)});
}

/// The number of proven principals with a usable worker.
std::size_t Trust::proven_present() const {
  return static_cast<std::size_t>(std::ranges::count_if(principals_.all(), [&](const auto& each) {
    return each.second.is_proven() && std::ranges::any_of(each.second.workers, [&](auto number) {
             const auto at = workers_->all().find(number);
             return at != workers_->all().end() && at->second.usable();
           });
  }));
}

void Trust::forget(std::uint32_t campaign) {
  const auto is_of = [&](PackedKey key) { return campaign_of(key) == campaign; };
  std::erase_if(disputed_, [&](const auto& each) {
    if (!is_of(each.first)) return false;
    for (const Dispute& dispute : each.second)
      let_go(dispute.other);
    return true;
  });
  for (const Case& one : cases_.forget(campaign)) {
    for (const Said& said : one.said)
      let_go(said);
  }
  for (auto& [name, principal] : principals_.all()) {
    std::erase_if(principal.waiting, [&](const auto& each) { return is_of(each.first); });
    std::set<WorkerNumber> waiting;
    for (const auto& [key, one] : principal.waiting)
      waiting.insert(principal.judged_as(one.worker));
    for (const WorkerNumber worker : waiting)
      try_waiting(principal, worker, book_->now);
  }
}

}  // namespace swarmsmith
