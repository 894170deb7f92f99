#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "coordinator/pool/cases.h"
#include "coordinator/pool/lease_signer.h"
#include "coordinator/pool/principal.h"
#include "coordinator/pool/task_book.h"
#include "coordinator/pool/worker_registry.h"
#include "storage/store.h"

namespace swarmsmith {

/// Who is believed, and what the referee says of the rest (docs/decisions/0019). A listed worker
/// can lie (orchestration facts, 6), so that in a campaign of the simulator no worker's word alone
/// rejects an evaluation, stops a campaign or, while nothing is known of who answers for the
/// worker, becomes an outcome: that is a *case*, which the coordinator's own child process decides.
///
/// A principal (principal.h)
///
///     stranger ──first outcome──► proven ──fails where others succeed, lies──► quarantined
///        ▲                                                                        │
///        └──────────────────────── a person forgives ─────────────────────────────┘
///
/// (without a key, each of its processes by itself) is a stranger until a result
/// of its became an outcome; with audits its first results wait until the referee has made them
/// again. Strangers get few tasks, and their deaths do not count against a task. With programs in
/// place of the simulator there is no referee: the holder of a lease is believed.
class Trust {
 public:
  /// Both must stay where they are.
  Trust(TaskBook& book, WorkerRegistry& workers);

  /// See Scheduler.
  std::deque<StoredWord> know(std::uint32_t campaign, std::span<const StoredScore> known,
                              const StoredTrust& trust);
  void audit_stored(Task task, Said said) { cases_.open(std::move(task), std::move(said), true); }
  /// What is before the referee of the campaign, or waits for that, is of no use any more.
  void forget(std::uint32_t campaign);

  /// Whether the worker was given the task: it has a lease of it, or the result one that is signed.
  bool may_answer(const WorkerEntry& entry, const Result& result);
  /// A score of a task without an outcome: becomes the outcome, or waits, or is a case.
  void on_score(WorkerEntry& entry, TaskRecord& record, const Result& result, TimePoint now);
  /// A score of a task that has an outcome, which may have other bits.
  void on_repeated(WorkerEntry& entry, const Result& result);
  /// See Scheduler.
  void on_disputed(PackedKey key, const std::optional<Task>& task, TimePoint now);
  /// The holder of a lease says that there is no score, or died with it: a case, unless another
  /// worker has the task too.
  void claim(WorkerEntry& entry, TaskRecord& record, Said::What what);
  /// A queued task that was lost with strangers again and again: a case, one at a time.
  void rule_on_stray(TaskRecord& record);

  /// The next case, when the referee has nothing to do.
  void ask_referee();
  void on_ruling(const Ruling& ruling, TimePoint now);

  /// How many tasks the worker wants; it gets as many as it may hold now.
  void set_credit(WorkerEntry& entry, std::uint32_t credit);
  /// Leases that a stranger's workers had ended without a result.
  void go_astray(Principal& principal, std::size_t leases, TimePoint now);
  /// Principals that have proved themselves and are there.
  std::size_t proven_present() const;
  /// Principals that may be forgotten.
  void forget_idle() { principals_.forget_idle(); }

  /// Who answers for the worker, new or known.
  Principal& principal_of(const WorkerHello& hello) { return principals_.of(hello); }
  /// Why the worker gets nothing; null when it may work.
  const Principal::Cause* cause_against(const Principal& principal,
                                        const std::string& identity) const;
  /// See Scheduler.
  std::vector<std::string> forgive(std::string_view word, const std::string& by, TimePoint now);
  const Principals& principals() const { return principals_; }
  const Cases& cases() const { return cases_; }
  const LeaseSigner& signer() const { return signer_; }

 private:
  // trust.cpp
  /// Whether its results wait for what the referee says of its first ones.
  bool is_on_trial(const WorkerEntry& entry, std::uint32_t campaign) const;
  void hold_back(WorkerEntry& entry, TaskRecord& record, const Result& result, TimePoint now);
  void try_waiting(Principal& principal, WorkerNumber worker, TimePoint now);
  void take_waiting(Principal& principal, WorkerNumber worker, TimePoint now);
  void drop_waiting(Principal& principal, std::optional<WorkerNumber> worker = std::nullopt);
  /// The result becomes the outcome.
  void take(WorkerEntry& entry, TaskRecord& record, const Result& result, TimePoint now);
  bool is_drawn(PackedKey key, double share) const;
  /// Opens a case when the result is one of those that are made again.
  void audit(const TaskRecord& record, const WorkerEntry& entry, const Result& result);
  /// What its workers may hold now.
  void update_room(Principal& principal);
  /// `worker`: whose evaluation it was.
  void strike(Principal& principal, WorkerNumber worker, TimePoint now);
  void convict(Principal& principal, WorkerNumber worker, const std::string& evidence,
               TimePoint now);
  std::vector<std::int64_t> unchecked_beside(const Principal& principal, WorkerNumber worker) const;
  void quarantine(Principal& principal, WorkerNumber worker, const std::string& reason,
                  TimePoint now);
  void quarantine_all(Principal& principal, const std::string& reason, TimePoint now);
  /// One process of a principal without a key; after kMostLiars of them, all of it.
  void quarantine_process(Principal& principal, WorkerNumber worker, const std::string& reason,
                          TimePoint now);
  void isolate(WorkerEntry& entry, const std::string& sentence, TimePoint now);
  /// Whether the principal stands behind it no longer.
  bool is_cast_out(const Said& said) const;

  // trust_rulings.cpp
  void dispute(WorkerEntry& entry, const DoneEntry& known, const Result& result);
  void note_conflict(PackedKey key, const Dispute& dispute);
  void note_audited(const Said& said, Principal* principal, const Ruling& ruling);
  void on_ruled_word(const Said& said, const Ruling& ruling, TimePoint now);
  void carry_out(const Case& ruled, const Ruling& ruling, TimePoint now);
  void compare_with_stored(const Case& ruled, const Ruling& ruling);
  void let_go(const Said& said);

  TaskBook* book_;
  WorkerRegistry* workers_;
  Principals principals_;
  Cases cases_;
  /// Results with other bits than the outcome's, whose tasks are asked for.
  std::unordered_map<PackedKey, std::vector<Dispute>> disputed_;
  LeaseSigner signer_;
  double referee_us_ = 0;  ///< of one of its evaluations
};

/// For people, at the worker and elsewhere.
std::string sentence_of_quarantine(const Principal& principal, const Principal::Cause& cause);

}  // namespace swarmsmith
