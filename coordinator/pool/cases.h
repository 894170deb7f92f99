#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "coordinator/design/task.h"
#include "coordinator/pool/lease_table.h"

namespace swarmsmith {

/// A worker's statement about an evaluation, or its death during one.
struct Said {
  enum class What {
    Score,
    NoScore,  ///< it fails, must be rejected, or takes too long
    Died,     ///< the worker's process ended or became silent while the task ran alone
  };
  What what = What::Score;
  WorkerNumber worker = 0;
  std::string principal;
  Measured measured{};
  std::int64_t attempt = 1;
  bool taken = false;     ///< whether it became the outcome
  bool on_trial = false;  ///< one of the first results of its principal, which waits for the
                          ///< referee's ruling
};

/// An outcome on disk, and the statement from which it came.
struct StoredWord {
  EvaluationKey key;
  Said said;
};

/// A result whose bits differ from the outcome.
struct Dispute {
  Said kept;
  Said other;
  std::uint64_t signature = 0;  ///< of the lease of `other`
};

/// An evaluation that the referee must decide, with the workers' statements about it. There are
/// none if only workers of strangers were lost with it.
struct Case {
  Task task;
  std::vector<Said> said;
  /// There is an outcome already, and the evaluation is repeated to check its bits.
  bool audit = false;
};

/// The evaluations for the referee, a child process of the coordinator that makes one evaluation at
/// a time. Cases that a design waits for come before audits. Pure bookkeeping: the scheduler opens
/// cases, and acts on the rulings.
class Cases {
 public:
  /// Adds the statement if the case is open; the case then stays an audit only if `audit` is set.
  void open(Task task, std::optional<Said> said, bool audit);
  /// The next task, if the referee is free; the task then counts as running until `close`.
  std::optional<Task> next();
  /// The ruling on the case has come. None if the case was forgotten in the meantime.
  std::optional<Case> close(PackedKey key);
  void add(PackedKey key, Said said) { open_.at(key).said.push_back(std::move(said)); }

  bool knows(PackedKey key) const { return open_.contains(key); }
  const Case* find(PackedKey key) const;
  bool empty() const { return open_.empty(); }
  std::size_t size() const { return open_.size(); }
  std::size_t audits() const { return audits_.size(); }
  /// The number of cases without a worker's statement.
  std::size_t without_worker() const;
  /// Forgets the cases of a campaign that was stopped; returns those that were open.
  std::vector<Case> forget(std::uint32_t campaign);

 private:
  std::unordered_map<PackedKey, Case> open_;
  std::deque<PackedKey> urgent_, audits_;
  std::optional<PackedKey> out_;
};

}  // namespace swarmsmith
