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

/// Evaluates a task; exceptions and scores that are not numbers become failures with a message.
Result evaluate(const Evaluator& evaluator, const LeasedTask& item);

/// The slots' events since the last call, in order.
struct ItemStarted {
  PackedKey key = 0;
};
using PoolEvent = std::variant<ItemStarted, Result>;

/// The slots: threads that take items in the order of their arrival. All members must be called
/// from the owner's thread.
class Pool {
 public:
  /// The slots call `wake` when the owner should call `take_events`: not for every item, because
  /// waking the owner costs more than a short evaluation, but always when `kMaxWaiting` results are
  /// waiting, or when the slots are about to run out of items.
  Pool(int slots, EvaluatorFactory make_evaluator, std::function<void()> wake);
  /// Waits for the running items.
  ~Pool();
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  /// Replaces the scenario; drops waiting items, and also the results of running ones.
  Expected<void> use(const std::string& scenario);
  void run(std::vector<LeasedTask> items);
  /// Removes the items that have not started, and returns their keys.
  std::vector<PackedKey> take_back();
  /// After a call that returned results, the owner calls again within a few milliseconds on its
  /// own, so it is not woken for the next result.
  std::vector<PoolEvent> take_events();

  static constexpr std::size_t kMaxWaiting = 64;

 private:
  /// One evaluator for each slot; all are replaced together.
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
  std::size_t results_ = 0;  ///< number of results in `events_`
  std::size_t running_ = 0;
  bool owner_comes_ = false;
  std::uint64_t generation_ = 0;
  /// Shared with slots that are still running an item of the previous scenario.
  std::shared_ptr<Generation> current_;
  std::vector<std::jthread> threads_;
};

}  // namespace swarmsmith
