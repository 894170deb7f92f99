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

/// Tasks of the race that somebody was given and that it does not wait for (yet): for slots that
/// would idle, or let go by a cancel. Each is here once, until its outcome comes or the race wants
/// it. What is dropped stays, since its outcome may come all the same.
class AheadTasks {
 public:
  /// What the race would want after its batch, on up to `pairs` further pairs; a longer list begins
  /// as the shorter one does, and each of it is looked at once.
  void expect(std::vector<Experiment> experiments, std::int64_t pairs);
  /// On how many pairs it was asked, since the last step.
  std::int64_t pairs_expected() const { return pairs_; }
  /// The next of these; null at the end.
  const Experiment* next();

  void add(const EvaluationKey& key, double bound);
  bool contains(const EvaluationKey& key) const;
  /// Its outcome is there, or it was never taken: the bound, if it was here.
  std::optional<double> remove(const EvaluationKey& key);
  /// The race waits for it now, and it is not dropped.
  void want(const EvaluationKey& key);
  /// A step is over: the race expects something else, and tasks of others than the candidates with
  /// these numbers, ascending, are dropped.
  void end_step(std::span<const std::int64_t> alive);
  void drop_all();

  /// Those that were dropped since the last call.
  std::vector<EvaluationKey> take_dropped() { return std::exchange(dropped_, {}); }
  /// With their bounds.
  std::vector<std::pair<EvaluationKey, double>> outstanding() const;

 private:
  struct Ahead {
    EvaluationKey key;
    double bound;
    bool dropped;  ///< it is no longer needed
  };

  std::map<std::uint64_t, Ahead> tasks_;
  std::vector<EvaluationKey> dropped_;
  std::vector<Experiment> expected_;
  std::int64_t pairs_ = 0;
  std::size_t seen_ = 0;  ///< of those that are expected
};

}  // namespace swarmsmith
