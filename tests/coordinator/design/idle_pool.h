#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <iterator>
#include <map>

#include "base/rng.h"
#include "tests/coordinator/design/target_campaigns.h"

namespace swarmsmith {

/// Slots that take tasks in any order, idle now and then, and hear then what may be wanted
/// later. What is dropped has been begun already in half of the cases.
class IdlePool {
 public:
  /// `looks`: how often slots idle, per task that is run.
  IdlePool(CampaignRunner& runner, Memory& memory, Rng rng, Answer answer, double looks)
      : runner_(runner), memory_(memory), rng_(rng), answer_(std::move(answer)), looks_(looks) {}
  IdlePool(const IdlePool&) = delete;
  IdlePool& operator=(const IdlePool&) = delete;
  ~IdlePool() { take(); }

  /// Runs one task; false when there is none, or all is finished and nothing waits any more.
  bool step() {
    take();
    if (held_.empty() || (runner_.finished() && rng_.bernoulli(0.2))) return false;
    const auto chosen =
        std::next(held_.begin(), static_cast<std::ptrdiff_t>(rng_.below(held_.size())));
    const Task task = chosen->second;
    held_.erase(chosen);
    runner_.tell(answer_(task));
    return true;
  }
  void run(std::size_t limit = ~std::size_t{0}) {
    while (limit-- > 0 && step()) {
    }
    EXPECT_FALSE(runner_.error()) << to_string(*runner_.error());
  }
  std::int64_t given_ahead() const { return given_ahead_; }

 private:
  void take() {
    for (const Task& task : runner_.take_tasks())
      hold(task);
    if (rng_.bernoulli(looks_)) {
      for (const Task& task : runner_.take_more(1 + rng_.below(12), 8))
        hold(task);
    }
    for (const EvaluationKey& key : runner_.take_dropped()) {
      if (rng_.bernoulli(0.5)) held_.erase(key);
    }
    for (Row& row : runner_.take_rows())
      memory_.rows.push_back(std::move(row));
  }
  void hold(const Task& task) {
    const auto [at, fresh] = held_.emplace(task.key, task);
    given_ahead_ += task.ahead;
    if (fresh) return;
    EXPECT_TRUE(at->second.ahead && !task.ahead) << to_string(task.key) << " is asked for twice";
    at->second = task;
  }

  CampaignRunner& runner_;
  Memory& memory_;
  Rng rng_;
  Answer answer_;
  double looks_;
  std::map<EvaluationKey, Task> held_;
  std::int64_t given_ahead_ = 0;
};

/// Races that ask for all up to the next test, as those of machines do.
inline std::vector<DesignPlan> batched(std::vector<DesignPlan> plans) {
  for (DesignPlan& plan : plans)
    plan.scenario.one_task_at_a_time = false;
  return plans;
}

/// The runner that a resumed campaign has.
inline CampaignRunner resumed(const std::vector<DesignPlan>& plans, const Memory& memory,
                              OpenDesigns most = {}) {
  return {plans, by_design(memory.scores(), memory.steps(), {}), {}, memory.commands(), most};
}

}  // namespace swarmsmith
