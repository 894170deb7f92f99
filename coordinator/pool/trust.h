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

/// Decides which workers are trusted, and handles the referee's rulings (docs/decisions/0019). A
/// worker with a listed key can lie (orchestration facts, 6). So in a campaign of the simulator, a
/// worker's statement alone does not reject an evaluation or stop a campaign, and while its
/// principal is unknown, it does not become an outcome: it becomes a *case*, which the
/// coordinator's own child process decides.
///
/// The states of a principal (principal.h); without a key, each of its processes has its own state:
///
///     stranger ──first outcome──► proven ──fails where others succeed, lies──► quarantined
///        ▲                                                                        │
///        └──────────────────────── a person forgives ─────────────────────────────┘
///
/// A principal is a stranger until one of its results has become an outcome; with audits, its first
/// results wait until the referee has evaluated them again. Strangers get few tasks, and deaths of
/// their workers do not count against a task. With programs instead of the simulator there is no
/// referee, and the holder of a lease is trusted.
class Trust {
 public:
  /// Both must outlive this object and keep their addresses.
  Trust(TaskBook& book, WorkerRegistry& workers);

  /// See Scheduler.
  std::deque<StoredWord> know(std::uint32_t campaign, std::span<const StoredScore> known,
                              const StoredTrust& trust);
  void audit_stored(Task task, Said said) { cases_.open(std::move(task), std::move(said), true); }
  /// Cases of the campaign, and results that wait for a ruling, are no longer needed.
  void forget(std::uint32_t campaign);

  /// Whether the worker was given the task: it has a lease of it, or the result is signed.
  bool may_answer(const WorkerEntry& entry, const Result& result);
  /// A score of a task without an outcome: it becomes the outcome, waits, or becomes a case.
  void on_score(WorkerEntry& entry, TaskRecord& record, const Result& result, TimePoint now);
  /// A score of a task that has an outcome; its bits may differ.
  void on_repeated(WorkerEntry& entry, const Result& result);
  /// See Scheduler.
  void on_disputed(PackedKey key, const std::optional<Task>& task, TimePoint now);
  /// The holder of a lease reports that there is no score, or has died with it: opens a case,
  /// unless another worker has the task too.
  void claim(WorkerEntry& entry, TaskRecord& record, Said::What what);
  /// A queued task was lost again and again with strangers' workers: opens a case, one at a time.
  void rule_on_stray(TaskRecord& record);

  /// Starts the next case if the referee is free.
  void ask_referee();
  void on_ruling(const Ruling& ruling, TimePoint now);

  /// Sets the number of tasks that the worker wants; it gets at most as many as it may hold now.
  void set_credit(WorkerEntry& entry, std::uint32_t credit);
  /// Counts leases that ended without a result at a stranger's workers.
  void go_astray(Principal& principal, std::size_t leases, TimePoint now);
  /// The number of proven principals with a usable worker.
  std::size_t proven_present() const;
  /// Forgets principals that are no longer needed.
  void forget_idle() { principals_.forget_idle(); }

  /// The worker's principal, new or known.
  Principal& principal_of(const WorkerHello& hello) { return principals_.of(hello); }
  /// The reason why the worker gets no tasks; null if it may work.
  const Principal::Cause* cause_against(const Principal& principal,
                                        const std::string& identity) const;
  /// See Scheduler.
  std::vector<std::string> forgive(std::string_view word, const std::string& by, TimePoint now);
  const Principals& principals() const { return principals_; }
  const Cases& cases() const { return cases_; }
  const LeaseSigner& signer() const { return signer_; }

 private:
  // trust.cpp
  /// Whether its results must wait for the referee's rulings on its first ones.
  bool is_on_trial(const WorkerEntry& entry, std::uint32_t campaign) const;
  void hold_back(WorkerEntry& entry, TaskRecord& record, const Result& result, TimePoint now);
  void try_waiting(Principal& principal, WorkerNumber worker, TimePoint now);
  void take_waiting(Principal& principal, WorkerNumber worker, TimePoint now);
  void drop_waiting(Principal& principal, std::optional<WorkerNumber> worker = std::nullopt);
  /// Makes the result the outcome.
  void take(WorkerEntry& entry, TaskRecord& record, const Result& result, TimePoint now);
  bool is_drawn(PackedKey key, double share) const;
  /// Opens a case if the result is selected for an audit.
  void audit(const TaskRecord& record, const WorkerEntry& entry, const Result& result);
  /// Updates the number of tasks that its workers may hold now.
  void update_room(Principal& principal);
  /// `worker`: the one that made the evaluation.
  void strike(Principal& principal, WorkerNumber worker, TimePoint now);
  void convict(Principal& principal, WorkerNumber worker, const std::string& evidence,
               TimePoint now);
  std::vector<std::int64_t> unchecked_beside(const Principal& principal, WorkerNumber worker) const;
  void quarantine(Principal& principal, WorkerNumber worker, const std::string& reason,
                  TimePoint now);
  void quarantine_all(Principal& principal, const std::string& reason, TimePoint now);
  /// Quarantines one process of a principal without a key, or all after kMostLiars of them.
  void quarantine_process(Principal& principal, WorkerNumber worker, const std::string& reason,
                          TimePoint now);
  void isolate(WorkerEntry& entry, const std::string& sentence, TimePoint now);

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
  /// Results that differ from the outcome; their tasks were requested from the campaigns.
  std::unordered_map<PackedKey, std::vector<Dispute>> disputed_;
  LeaseSigner signer_;
  double referee_us_ = 0;  ///< running estimate of the referee's time for an evaluation
};

/// For people, at the worker and elsewhere.
std::string sentence_of_quarantine(const Principal& principal, const Principal::Cause& cause);

}  // namespace swarmsmith
