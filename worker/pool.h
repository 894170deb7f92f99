#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "base/expected.h"
#include "worker/evaluator.h"

namespace swarmsmith {

/// Evaluates a task: an exception and a score that is not a number are failures with a sentence.
Result evaluate(const Evaluator& evaluator, const LeasedTask& item);

/// What slots did since the last call, in order.
struct ItemStarted {
  PackedKey key = 0;
};
using PoolEvent = std::variant<ItemStarted, Result>;

/// The slots: threads that take items in the order in which they came. All members may be called
/// from the owner's thread only.
class Pool {
 public:
  /// `wake` is called from the slots when the owner should call `take_events`: not for every item,
  /// since waking it costs more than a short evaluation; but in any case when `kMaxWaiting` results
  /// wait, or the slots are about to run dry.
  Pool(int slots, EvaluatorFactory make_evaluator, std::function<void()> wake);
  /// Waits for running items.
  ~Pool();
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  /// Replaces the scenario; items that wait are dropped, the results of running ones too.
  Expected<void> use(const std::string& scenario);
  void run(std::vector<LeasedTask> items);
  /// Items that were not started; they are not run any more.
  std::vector<PackedKey> take_back();
  /// After a call that gave results the owner comes again within a few milliseconds by itself, and
  /// is not woken for the next result.
  std::vector<PoolEvent> take_events();

  static constexpr std::size_t kMaxWaiting = 64;

 private:
  /// One evaluator a slot, replaced together.
  struct Generation {
    std::vector<Evaluator> evaluators;
  };

  void work(const std::stop_token& stop, std::size_t slot);
  void finish(std::uint64_t generation, Result result);

  int slots_;
  EvaluatorFactory make_evaluator_;
  std::function<void()> wake_;
  std::mutex mutex_;
  std::condition_variable_any has_work_;
  std::deque<LeasedTask> waiting_;
  std::vector<PoolEvent> events_;
  std::size_t results_ = 0;  ///< in `events_`
  std::size_t running_ = 0;
  bool owner_comes_ = false;
  std::uint64_t generation_ = 0;
  /// Shared with slots that still run an item of the previous one.
  std::shared_ptr<Generation> current_;
  std::vector<std::jthread> threads_;
};

}  // namespace swarmsmith
