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

/// What a worker said of an evaluation, or did.
struct Said {
  enum class What {
    Score,
    NoScore,  ///< that it fails, is to be rejected, or takes too long
    Died,     ///< its process ended, or fell silent, while it ran alone
  };
  What what = What::Score;
  WorkerNumber worker = 0;
  std::string principal;
  Measured measured{};
  std::int64_t attempt = 1;
  bool taken = false;     ///< it is the outcome
  bool on_trial = false;  ///< one of the first results of its principal, which waits for the word
};

/// An outcome that is on disk, and who gave it.
struct StoredWord {
  EvaluationKey key;
  Said said;
};

/// A result with other bits than the outcome.
struct Dispute {
  Said kept;
  Said other;
  std::uint64_t signature = 0;  ///< of the lease of `other`
};

/// An evaluation that is before the referee, and who said what of it; no worker, when it was lost
/// with strangers only.
struct Case {
  Task task;
  std::vector<Said> said;
  /// An outcome is there, and is made again to see whether its bits are right.
  bool audit = false;
};

/// What the referee has to evaluate: the coordinator's own child, one evaluation after the other.
/// Cases that a design waits for go before audits. Pure bookkeeping: the scheduler opens cases, and
/// does what follows from the rulings.
class Cases {
 public:
  /// A further word when the case is open; then the case stays an audit only if this is one.
  void open(Task task, std::optional<Said> said, bool audit);
  /// The next task, when the referee has nothing to do; it is out then, until `close`.
  std::optional<Task> next();
  /// Its ruling has come. Nothing when the case was forgotten meanwhile.
  std::optional<Case> close(PackedKey key);
  void add(PackedKey key, Said said) { open_.at(key).said.push_back(std::move(said)); }

  bool knows(PackedKey key) const { return open_.contains(key); }
  const Case* find(PackedKey key) const;
  bool empty() const { return open_.empty(); }
  std::size_t size() const { return open_.size(); }
  std::size_t audits() const { return audits_.size(); }
  /// Cases without a word of a worker.
  std::size_t of_nobody() const;
  /// Of a campaign that is stopped; those that were open.
  std::vector<Case> forget(std::uint32_t campaign);

 private:
  std::unordered_map<PackedKey, Case> open_;
  std::deque<PackedKey> urgent_, audits_;
  std::optional<PackedKey> out_;
};

}  // namespace swarmsmith
