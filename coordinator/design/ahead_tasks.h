#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "irace_core/experiment.h"
#include "storage/rows.h"

namespace swarmsmith {

/// Tasks of the race that were handed out although the race does not wait for them (yet):
/// look-ahead for idle slots, or tasks that a cancel released. Each task is here once, until its
/// outcome comes or the race wants it. A dropped task stays, since its outcome may still come.
class AheadTasks {
 public:
  /// Sets the experiments that the race would want after its batch, on up to `pairs` further pairs.
  /// A longer list must begin with the shorter one, and each experiment is visited only once.
  void expect(std::vector<Experiment> experiments, std::int64_t pairs);
  /// The number of pairs in the last call of `expect` since the last step.
  std::int64_t pairs_expected() const { return pairs_; }
  /// The next of these experiments; null at the end.
  const Experiment* next();

  void add(const EvaluationKey& key, double bound);
  bool contains(const EvaluationKey& key) const;
  /// Removes a task: its outcome has come, or it was not handed out. Returns its bound if it was
  /// here.
  std::optional<double> remove(const EvaluationKey& key);
  /// The race now waits for this task, so it is not dropped.
  void want(const EvaluationKey& key);
  /// A step has ended, so the race expects other experiments; drops the tasks of candidates whose
  /// numbers are not in `alive`, which is sorted.
  void end_step(std::span<const std::int64_t> alive);
  void drop_all();

  /// The tasks that were dropped since the last call.
  std::vector<EvaluationKey> take_dropped() { return std::exchange(dropped_, {}); }
  /// All tasks here, with their bounds.
  std::vector<std::pair<EvaluationKey, double>> outstanding() const;

 private:
  struct Ahead {
    EvaluationKey key;
    double bound;
    bool dropped;  ///< no longer needed
  };

  std::map<std::uint64_t, Ahead> tasks_;
  std::vector<EvaluationKey> dropped_;
  std::vector<Experiment> expected_;
  std::int64_t pairs_ = 0;
  std::size_t seen_ = 0;  ///< how many of the expected experiments were visited
};

}  // namespace swarmsmith
