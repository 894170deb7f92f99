#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <unordered_map>
#include <vector>

#include "coordinator/lease_table.h"
#include "coordinator/task.h"

namespace swarmsmith {

/// Evaluations that are made once more by another worker, to compare the bits (orchestration facts,
/// 9): a fixed share, chosen by a hash of the key, so that nobody can know in advance which. What
/// differs is judged by a third worker.
///
/// Pure bookkeeping: which task waits, whom it must not go to, and who said what. The scheduler
/// leases the tasks and reports what comes of them.
class Audits {
 public:
  /// Who gave which result of an evaluation.
  struct Word {
    WorkerNumber worker = 0;
    double score = 0;
    std::uint64_t state_digest = 0;
  };
  /// What a word brought about.
  struct Verdict {
    bool differs = false;  ///< from the word that is kept
    /// The one whom the two others contradict, once a third has spoken.
    std::optional<WorkerNumber> outvoted;
    /// All three differ: nobody can be believed.
    bool no_two_agree = false;
  };

  /// Whether the evaluation is one of those, when one of `every` is audited; 0: none.
  static bool chooses(PackedKey key, std::int64_t every);

  /// The task has its first result, and is to be evaluated again.
  void open(Task task, const Word& first);
  /// The next task that waits for a worker and may go to this one; it is out then, until
  /// `give_back` or `hear`. Nothing when there is none.
  std::optional<Task> take_for(WorkerNumber worker);
  /// Its worker was lost, or had no answer: it waits again, a few times.
  void give_back(PackedKey key);
  /// What another worker says. The audit is over, unless words differ and a third is wanted.
  Verdict hear(PackedKey key, const Word& word);

  bool knows(PackedKey key) const { return open_.contains(key); }
  /// The result of an open audit's task that counts.
  const Word& kept(PackedKey key) const { return open_.at(key).words.front(); }
  /// Tasks that a worker may be found for among these, or has been.
  bool can_go_on(const std::vector<WorkerNumber>& workers) const;
  std::size_t waiting() const { return queue_.size(); }
  bool empty() const { return open_.empty(); }
  /// Of a campaign that is stopped.
  void forget(std::uint32_t campaign);
  /// Given up: no worker could be found, or too many were lost with it.
  std::uint64_t given_up() const { return given_up_; }

 private:
  struct Audit {
    Task task;
    std::vector<Word> words;
    int losses = 0;
    bool out = false;
  };

  static bool may_take(const Audit& audit, WorkerNumber worker);
  void drop(PackedKey key);

  std::unordered_map<PackedKey, Audit> open_;
  std::deque<PackedKey> queue_;
  std::uint64_t given_up_ = 0;
};

}  // namespace swarmsmith
