#include "benchmarks/cluster/pool_model.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <queue>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "base/hash.h"

namespace swarmsmith::bench {
namespace {

// The worker's protocol: how much work it holds, and when it reports (worker/protocol.h).
constexpr double kWorkAheadUs = 20'000;
constexpr double kFlushAfterUs = 5'000;
constexpr std::size_t kResultsPerMessage = 64;
constexpr double kMaxCredit = 4'096;

class Model {
 public:
  Model(const ModelShape& shape, RecordedRaces& source) : shape_(shape), source_(&source) {
    for (std::int64_t left = shape.slots; left > 0; left -= shape.worker_slots) {
      workers_.push_back({.slots = std::min(left, shape.worker_slots)});
    }
  }

  ModelRun run() {
    take_wanted();
    dispatch(0);
    double now = 0;
    while (!source_->finished()) {
      const Event event = events_.top();
      events_.pop();
      now = event.at;
      on_event(event);
    }
    const auto useful = static_cast<double>(source_->total());
    return {.wall_s = now * 1e-6,
            .efficiency = useful * shape_.us / (static_cast<double>(shape_.slots) * now),
            .extra = static_cast<double>(started_) / useful - 1};
  }

 private:
  enum class Kind { Done, Flush, Tasks, Results };
  struct Item {
    EvaluationKey key;
    double us = 0;
  };
  struct Event {
    double at = 0;
    std::uint64_t order = 0;
    Kind kind = Kind::Done;
    std::size_t worker = 0;
    std::vector<Item> items{};
    bool operator<(const Event& other) const {
      return std::tie(other.at, other.order) < std::tie(at, order);
    }
  };
  struct Worker {
    std::int64_t slots = 0;
    std::int64_t leased = 0;  ///< as the coordinator knows it
    std::int64_t running = 0;
    std::deque<Item> waiting{};
    std::vector<Item> unsent{};
  };

  void at(double when, Kind kind, std::size_t worker, std::vector<Item> items = {}) {
    events_.push({when, ++order_, kind, worker, std::move(items)});
  }

  void on_event(const Event& event) {
    Worker& worker = workers_[event.worker];
    switch (event.kind) {
      case Kind::Tasks:
        worker.waiting.insert(worker.waiting.end(), event.items.begin(), event.items.end());
        start(event.worker, event.at);
        return;
      case Kind::Done:
        --worker.running;
        if (worker.unsent.empty()) at(event.at + kFlushAfterUs, Kind::Flush, event.worker);
        worker.unsent.push_back(event.items.front());
        start(event.worker, event.at);
        if (is_due(worker)) flush(event.worker, event.at);
        return;
      case Kind::Flush:
        // If its results have already gone, the timer is too early for the later ones, by 5 ms at
        // most.
        if (!worker.unsent.empty()) flush(event.worker, event.at);
        return;
      case Kind::Results:
        hear(event);
        return;
    }
  }

  // --- a worker ---

  void start(std::size_t number, double now) {
    Worker& worker = workers_[number];
    while (worker.running < worker.slots && !worker.waiting.empty()) {
      const Item item = worker.waiting.front();
      worker.waiting.pop_front();
      ++worker.running;
      ++started_;
      at(now + item.us, Kind::Done, number, {item});
    }
  }

  static bool is_due(const Worker& worker) {
    const auto held = worker.running + static_cast<std::int64_t>(worker.waiting.size());
    return worker.unsent.size() >= kResultsPerMessage || held <= worker.slots;
  }

  void flush(std::size_t number, double now) {
    at(now + shape_.latency_us, Kind::Results, number, std::exchange(workers_[number].unsent, {}));
  }

  // --- the coordinator: one thread, busy until `free_` ---

  void hear(const Event& event) {
    free_ = free_ > event.at ? free_ : event.at + shape_.wake_us;
    free_ += shape_.message_us + shape_.result_us * static_cast<double>(event.items.size());
    const std::int64_t tests = source_->tests();
    for (const Item& item : event.items) {
      --workers_[event.worker].leased;
      --leased_;
      source_->tell({.key = item.key});
    }
    free_ += shape_.test_us * static_cast<double>(source_->tests() - tests);
    (void)source_->take_rows();
    take_wanted();
    for (const EvaluationKey& key : source_->take_dropped())
      ahead_.erase(key);
    dispatch(free_);
  }

  Item item_of(const Task& task) const {
    const auto bits = mix64(static_cast<std::uint64_t>(task.seed) ^ 0x74696d65U);
    const double part = static_cast<double>(bits >> 11U) * 0x1p-53;
    return {task.key, shape_.us * (1 + shape_.spread * (2 * part - 1))};
  }

  void take_wanted() {
    for (const Task& task : source_->take_tasks()) {
      const Item item = item_of(task);
      if (given_ahead_.erase(task.key) > 0) continue;  // it has already been given to a worker
      ahead_.erase(task.key);
      wanted_[design_of(task.key.candidate).value].push_back(item);
      ++queued_;
    }
  }

  /// The queue of the design that waits for the fewest evaluations.
  std::deque<Item>& most_urgent() {
    auto best = wanted_.begin();
    for (auto at = wanted_.begin(); at != wanted_.end(); ++at) {
      if (awaited(at->first) < awaited(best->first)) best = at;
    }
    return best->second;
  }
  std::int64_t awaited(std::int64_t design) const {
    return source_->awaited(static_cast<std::size_t>(design - 1));
  }

  void dispatch(double now) {
    const auto n = static_cast<std::int64_t>(workers_.size());
    const std::int64_t parts = n > 1 ? 2 * shape_.slots : shape_.slots;
    const std::int64_t share = std::max<std::int64_t>(1, (queued_ + leased_ + parts - 1) / parts);
    for (std::int64_t i = 0; i < n && queued_ > 0; ++i) {
      turn_ = (turn_ + 1) % workers_.size();
      const double credit =
          static_cast<double>(workers_[turn_].slots) * (2 + kWorkAheadUs / shape_.us);
      const auto most = std::min(static_cast<std::int64_t>(std::min(credit, kMaxCredit)),
                                 share * workers_[turn_].slots);
      fill(turn_, most, now);
    }
    if (queued_ == 0) look_ahead(now);
  }

  void fill(std::size_t number, std::int64_t most, double now) {
    std::vector<Item> items;
    while (queued_ > 0 && workers_[number].leased < most) {
      std::deque<Item>& queue = most_urgent();
      items.push_back(queue.front());
      queue.pop_front();
      if (queue.empty()) std::erase_if(wanted_, [](const auto& q) { return q.second.empty(); });
      --queued_;
      ++workers_[number].leased;
      ++leased_;
    }
    if (!items.empty()) at(now + shape_.latency_us, Kind::Tasks, number, std::move(items));
  }

  /// Gives evaluations ahead only to idle slots: more of them would delay the needed ones.
  void look_ahead(double now) {
    std::int64_t idle = 0;
    for (const Worker& worker : workers_)
      idle += std::max<std::int64_t>(0, worker.slots - worker.leased);
    const auto ready = static_cast<std::int64_t>(ahead_.size());
    if (idle > ready) {
      for (const Task& task : source_->take_more(static_cast<std::size_t>(idle - ready),
                                                 static_cast<std::size_t>(shape_.slots)))
        ahead_.emplace(task.key, item_of(task).us);
    }
    for (std::size_t number = 0; number < workers_.size() && !ahead_.empty(); ++number) {
      std::vector<Item> items;
      while (!ahead_.empty() && workers_[number].leased < workers_[number].slots) {
        const auto next = ahead_.begin();
        items.push_back({next->first, next->second});
        given_ahead_.insert(next->first);
        ahead_.erase(next);
        ++workers_[number].leased;
        ++leased_;
      }
      if (!items.empty()) at(now + shape_.latency_us, Kind::Tasks, number, std::move(items));
    }
  }

  ModelShape shape_;
  RecordedRaces* source_;
  std::priority_queue<Event> events_;
  std::uint64_t order_ = 0;
  std::vector<Worker> workers_;
  std::size_t turn_ = 0;
  std::map<std::int64_t, std::deque<Item>> wanted_;  ///< by design
  std::int64_t queued_ = 0;                          ///< total number in the queues
  std::int64_t leased_ = 0;
  std::map<EvaluationKey, double> ahead_;  ///< requested ahead, and not given to a worker yet
  std::set<EvaluationKey> given_ahead_;
  std::int64_t started_ = 0;
  double free_ = 0;
};

}  // namespace

ModelRun run_model(const ModelShape& shape, RecordedRaces& source) {
  return Model(shape, source).run();
}

}  // namespace swarmsmith::bench
