// Cases for the referee, and the consequences of its rulings.

#include <fmt/format.h>
#include <algorithm>
#include <bit>

#include "base/assert.h"
#include "coordinator/pool/trust.h"
#include "storage/answer.h"

namespace swarmsmith {
namespace {

Measured measured_of(const DoneEntry& entry) {
  return {.score = std::bit_cast<double>(entry.score_bits), .state_digest = entry.state_digest};
}

bool is_right(const Said& said, const Ruling& ruling) {
  // A time-out of the referee confirms neither a score nor a rejection.
  if (said.what == Said::What::NoScore) return ruling.kind == Ruling::Kind::Rejected;
  return ruling.kind == Ruling::Kind::Score && same_bits(said.measured, ruling.measured);
}

std::string text_of(const Ruling& ruling) {
  if (ruling.kind != Ruling::Kind::Score) return "that it has no score";
  return fmt::format("{}", ruling.measured.score);
}

std::string text_of(const Said& said) {
  return said.what == Said::What::Score ? fmt::format("{}", said.measured.score) : "no score";
}

/// If the scores are equal but the final states of the runs differ, the text must say so.
std::string text_beside(const Said& said, const Ruling& ruling) {
  const bool is_same = said.what == Said::What::Score && ruling.kind == Ruling::Kind::Score &&
                       said.measured.score == ruling.measured.score;
  return text_of(ruling) + (is_same ? ", with another final state" : "");
}

}  // namespace

/// The lease ends in any case. If there is a second copy, no case is opened, because its result
/// will show the truth. Above kMostClaims none is opened either, because a liar could take the
/// referee's time from all others.
void Trust::claim(WorkerEntry& entry, TaskRecord& record, Said::What what) {
  const Lease* lease = record.lease_of(entry.number);
  if (lease == nullptr) return;
  const Said said{.what = what,
                  .worker = entry.number,
                  .principal = entry.principal->name,
                  .attempt = lease->attempt};
  record.avoid = entry.number;
  book_->leases.requeue(record, entry.number);
  Principal& principal = *entry.principal;
  if (record.lease || principal.claims >= Principal::kMostClaims) return;
  if (++principal.claims == Principal::kMostClaims) update_room(principal);
  book_->leases.park(record);
  cases_.open(record.task, said, false);
}

void Trust::rule_on_stray(TaskRecord& record) {
  // One at a time, so that strangers who take tasks and leave cannot fill the referee's queue.
  if (cases_.without_worker() > 0 || book_->options.evaluates_programs) return;
  record.strays = 0;
  book_->leases.park(record);
  cases_.open(record.task, std::nullopt, false);
}

/// A result may come again, since a worker sends it until it is acknowledged (orchestration facts,
/// 5 "Duplicates").
void Trust::on_repeated(WorkerEntry& entry, const Result& result) {
  ++book_->counters.duplicates;
  const DoneEntry* known = book_->done.find(result.key);
  const auto status = result.rejected ? EvaluationStatus::Rejected : EvaluationStatus::Ok;
  // Two runs of a program may differ, at least in their time: the first one counts.
  const bool is_the_same = known == nullptr || book_->options.evaluates_programs ||
                           DoneTable::same(*known, status, result.measured);
  if (is_the_same || entry.principal->claims >= Principal::kMostClaims) {
    book_->act(OutcomeRepeated{result.key, entry.number});
  } else {
    dispute(entry, *known, result);
  }
}

/// A result with other bits may belong to another task, if the key meant another task before a
/// crash; or the campaign is not deterministic, or a worker lies. This is decided when the campaign
/// has returned the task.
void Trust::dispute(WorkerEntry& entry, const DoneEntry& known, const Result& result) {
  if (++entry.principal->claims == Principal::kMostClaims) update_room(*entry.principal);
  const bool has_score = !DoneTable::same(known, EvaluationStatus::Rejected, {});
  disputed_[result.key].push_back(
      {.kept = {.what = has_score ? Said::What::Score : Said::What::NoScore,
                .measured = measured_of(known),
                .taken = true},
       .other = {.what = result.rejected ? Said::What::NoScore : Said::What::Score,
                 .worker = entry.number,
                 .principal = entry.principal->name,
                 .measured = result.measured},
       .signature = result.signature});
  book_->act(TaskInDispute{campaign_of(result.key), unpack(result.key)});
}

void Trust::ask_referee() {
  std::optional<Task> task = cases_.next();
  if (!task) return;
  const Duration timeout = book_->options.campaigns[task->campaign].task_timeout;
  book_->act(AskReferee{std::move(*task), timeout});
}

void Trust::on_disputed(PackedKey key, const std::optional<Task>& task, TimePoint now) {
  book_->now = now;
  const auto found = disputed_.extract(key);
  if (!found) return;
  const bool is_stopped = book_->is_stopped(campaign_of(key));
  for (const Dispute& dispute : found.mapped()) {
    const Said& other = dispute.other;
    if (is_stopped) {
      let_go(other);
      continue;
    }
    // A campaign that is over needs no results.
    if (task || book_->is_closed(campaign_of(key))) book_->act(OutcomeRepeated{key, other.worker});
    if (!task) {
      let_go(other);
      continue;
    }
    if (dispute.signature != 0 && !signer_.is_of(dispute.signature, *task)) {
      ++book_->counters.unleased;
      let_go(other);
      continue;
    }
    note_conflict(key, dispute);
    cases_.open(*task, dispute.kept, true);
    cases_.open(*task, other, true);
  }
}

void Trust::note_conflict(PackedKey key, const Dispute& dispute) {
  ++book_->counters.conflicts;
  const bool has_score = dispute.kept.what == Said::What::Score;
  book_->act(ConflictFound{campaign_of(key),
                           {.key = unpack(key),
                            .kept_score = has_score ? dispute.kept.measured.score : 0,
                            .other_score = dispute.other.measured.score,
                            .other_state_digest = dispute.other.measured.state_digest,
                            .other_worker = dispute.other.worker}});
  const WorkerEntry* worker = workers_->of_number(dispute.other.worker);
  book_->note("error", "not deterministic",
              {{"evaluation", name_of(unpack(key))},
               {"worker", dispute.other.worker},
               {"host", worker == nullptr ? "" : worker->hello.host}},
              campaign_of(key), principals_.find(dispute.other.principal), dispute.other.worker);
}

void Trust::on_ruling(const Ruling& ruling, TimePoint now) {
  book_->now = now;
  const std::optional<Case> ruled = cases_.close(ruling.key);
  if (!ruled) return;
  ++book_->counters.rulings;
  if (ruling.kind == Ruling::Kind::Score) {
    const auto spent_us = static_cast<double>(std::max<std::int64_t>(ruling.measured.wall_us, 0));
    referee_us_ += (referee_us_ == 0 ? 1.0 : 0.05) * (spent_us - referee_us_);
  }
  // The referee could not work, so nothing is known about the evaluation or the workers.
  if (ruling.kind == Ruling::Kind::NoWord) {
    for (const Said& said : ruled->said)
      let_go(said);
    return book_->stop(ruled->task.campaign,
                       "the evaluation of " + name_of(ruled->task.key) +
                           " must be evaluated on this host, which cannot do it: " + ruling.reason);
  }
  carry_out(*ruled, ruling, now);
  for (const Said& said : ruled->said)
    on_ruled_word(said, ruling, now);
  compare_with_stored(*ruled, ruling);
}

/// Records the outcome, if there is none yet.
void Trust::carry_out(const Case& ruled, const Ruling& ruling, TimePoint now) {
  TaskRecord* record = book_->leases.find(ruling.key);
  if (record == nullptr) return;
  if (ruling.kind == Ruling::Kind::TimedOut) {
    if (record->lease) return;  // the other copy will decide
    if (record->task.ahead) return book_->leases.shelve(*record);
    return book_->stop(record->task.campaign, ruling.reason);
  }
  if (ruling.kind == Ruling::Kind::Rejected) {
    book_->act(FailureKept{record->task.campaign,
                           {.key = record->task.key,
                            .attempt = std::max<std::int64_t>(record->attempts, 1),
                            .reason = ruling.reason}});
    return book_->reject(*record, 0, ruling.reason);
  }
  // If a worker said the same, the outcome is its own: the referee only confirmed it.
  const auto right =
      std::ranges::find_if(ruled.said, [&](const Said& said) { return is_right(said, ruling); });
  const bool is_of_worker = right != ruled.said.end();
  WorkerEntry* entry = is_of_worker ? workers_->of_number(right->worker) : nullptr;
  if (entry != nullptr) {
    ++entry->done;
    ++entry->principal->standing(entry->number).taken;
    if (++entry->principal->taken == 1) update_room(*entry->principal);
  }
  const WorkerNumber by = is_of_worker ? right->worker : 0;
  book_->note_second_copy(*record, by, now);
  Measured measured = ruling.measured;
  // Time of a worker's slot, as for other outcomes.
  if (is_of_worker) measured.wall_us = right->measured.wall_us;
  book_->accept(
      {.key = record->task.key,
       .campaign = record->task.campaign,
       .status = EvaluationStatus::Ok,
       .measured = measured,
       .worker = by,
       .attempt = is_of_worker ? right->attempt : std::max<std::int64_t>(record->attempts, 1)});
}

/// The consequences for the worker that made the statement.
void Trust::on_ruled_word(const Said& said, const Ruling& ruling, TimePoint now) {
  let_go(said);
  Principal* principal = principals_.find(said.principal);
  const bool is_decided = ruling.kind != Ruling::Kind::TimedOut;
  if (said.taken && is_decided && is_right(said, ruling)) note_audited(said, principal, ruling);
  // A worker that died did not claim anything, so it cannot be wrong.
  if (principal == nullptr || said.what == Said::What::Died) return;
  if (said.what == Said::What::NoScore) {
    // A failure where there is a score may be bad luck: it counts against the worker, but is not a
    // lie.
    if (ruling.kind == Ruling::Kind::Score) strike(*principal, said.worker, now);
    return;
  }
  if (is_decided) ++book_->counters.audited;
  // The evaluation is pure, so other bits are a fault or a lie (decision 19).
  if (is_decided && !is_right(said, ruling)) {
    convict(*principal, said.worker,
            "it gave " + text_of(said) + " for the evaluation of " + name_of(unpack(ruling.key)) +
                ", and this host " + text_beside(said, ruling),
            now);
  } else if (is_decided) {
    ++principal->standing(said.worker).confirmed;
  }
  if (said.on_trial) try_waiting(*principal, said.worker, now);
}

/// A later process does not audit it again, and workers that gave other bits were wrong. For a
/// dispute, the worker that gave the kept result is not known.
void Trust::note_audited(const Said& said, Principal* principal, const Ruling& ruling) {
  const std::uint32_t campaign = campaign_of(ruling.key);
  if (principal != nullptr) --principal->standing(said.worker).unchecked_of(campaign);
  book_->act(AttemptEnded{campaign,
                          {.key = unpack(ruling.key),
                           .attempt = said.attempt,
                           .worker = 0,
                           .held_ms = ruling.measured.wall_us / 1000,
                           .outcome = AttemptOutcome::Audited}});
}

/// The stored outcome may be the wrong one.
void Trust::compare_with_stored(const Case& ruled, const Ruling& ruling) {
  if (ruling.kind == Ruling::Kind::TimedOut) return;
  for (const Said& said : ruled.said) {
    if (!said.taken || is_right(said, ruling)) continue;
    const std::uint32_t campaign = ruled.task.campaign;
    const std::string name = name_of(ruled.task.key);
    book_->note(
        "error", "a stored score is wrong",
        {{"evaluation", name}, {"stored", text_of(said)}, {"this host", text_beside(said, ruling)}},
        campaign);
    return book_->stop(campaign,
                       "a score in the store is wrong: the evaluation of " + name + " has " +
                           text_of(said) + ", and this host gives " + text_of(ruling) +
                           ". `swarmsmith show STORE " + to_string(ruled.task.key) +
                           "` names the worker that gave it; `swarmsmith recover STORE "
                           "--without-key KEY -o NEW.db` makes a store without the results of its "
                           "key, and the campaign continues from there with --store NEW.db",
                       true);
  }
}

/// The referee no longer has the statement, which was counted when its case was opened.
void Trust::let_go(const Said& said) {
  Principal* principal = principals_.find(said.principal);
  if (principal == nullptr || said.taken) return;
  if (said.on_trial) {
    Principal::Standing& standing = principal->standing(said.worker);
    SWARMSMITH_ASSERT(standing.on_trial > 0, "every result on trial was counted");
    --standing.on_trial;
    return;
  }
  SWARMSMITH_ASSERT(principal->claims > 0, "every claim before the referee was counted");
  if (principal->claims-- == Principal::kMostClaims) update_room(*principal);
}

}  // namespace swarmsmith
