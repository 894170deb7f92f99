#include "worker/pool.h"

#include <chrono>
#include <cmath>
#include <exception>
#include <utility>

#include "base/assert.h"
#include "programs/cost.h"

namespace swarmsmith {

Result evaluate(const Evaluator& evaluator, const LeasedTask& item) {
  Result result;
  const auto begin = std::chrono::steady_clock::now();
  try {
    result = evaluator(item);
    // A score is a finite number: SQLite stores NaN as NULL (orchestration facts, 7), and an
    // infinite cost means a rejection (irace facts, 12).
    const double score = result.measured.score;
    if (!std::isfinite(score)) {
      result = {.failure = "the score is not finite"};
      // The coordinator would refuse the whole message (proto/wire.cpp).
    } else if (is_too_large(score)) {
      result = {.failure = "the score is beyond 1e300"};
    }
    // An exception that leaves a thread would end the process, and with it the evaluations of all
    // slots.
  } catch (const std::exception& error) {
    result.failure = error.what();
  } catch (...) {
    result.failure = "an exception without a text";
  }
  const auto spent = std::chrono::steady_clock::now() - begin;
  // Measured here for every kind of evaluator: credit and shares follow from it.
  result.measured.wall_us = std::chrono::duration_cast<std::chrono::microseconds>(spent).count();
  // Those of the lease, so that an evaluator cannot answer for another task.
  result.key = item.key;
  result.attempt = item.attempt;
  result.signature = item.signature;
  return result;
}

Pool::Pool(int slots, EvaluatorFactory make_evaluator, std::function<void()> wake)
    : slots_(slots), make_evaluator_(std::move(make_evaluator)), wake_(std::move(wake)) {
  SWARMSMITH_ASSERT(slots_ >= 1, "a worker evaluates something");
  for (int slot = 0; slot < slots_; ++slot) {
    threads_.emplace_back(
        [this, slot](const std::stop_token& stop) { work(stop, static_cast<std::size_t>(slot)); });
  }
}

Pool::~Pool() {
  for (std::jthread& thread : threads_)
    thread.request_stop();
}

Expected<void> Pool::use(const std::string& scenario) {
  // Made without the lock: slots may still be evaluating.
  auto next = std::make_shared<Generation>();
  for (int slot = 0; slot < slots_; ++slot) {
    Expected<Evaluator> evaluator = make_evaluator_(scenario);
    if (!evaluator) return Unexpected(evaluator.error());
    next->evaluators.push_back(std::move(*evaluator));
  }
  const std::scoped_lock lock(mutex_);
  // Results of items that still run get the old number, and are dropped in `finish`.
  ++generation_;
  current_ = std::move(next);
  waiting_.clear();
  events_.clear();
  results_ = 0;
  return {};
}

void Pool::run(std::vector<LeasedTask> items) {
  {
    const std::scoped_lock lock(mutex_);
    for (LeasedTask& item : items)
      waiting_.push_back(std::move(item));
  }
  has_work_.notify_all();
}

std::vector<PackedKey> Pool::take_back() {
  const std::scoped_lock lock(mutex_);
  std::vector<PackedKey> keys;
  for (const LeasedTask& item : waiting_)
    keys.push_back(item.key);
  waiting_.clear();
  return keys;
}

std::vector<PoolEvent> Pool::take_events() {
  const std::scoped_lock lock(mutex_);
  SWARMSMITH_ASSERT(results_ <= events_.size(), "results are among what slots did");
  // After results the owner polls by itself for a while, so it need not be woken for the next one.
  owner_comes_ = results_ > 0;
  results_ = 0;
  return std::exchange(events_, {});
}

void Pool::work(const std::stop_token& stop, std::size_t slot) {
  while (true) {
    LeasedTask item;
    std::shared_ptr<Generation> generation;
    std::uint64_t number = 0;
    {
      std::unique_lock lock(mutex_);
      const bool has_item =
          has_work_.wait(lock, stop, [this] { return !waiting_.empty() && current_ != nullptr; });
      if (!has_item || stop.stop_requested()) return;
      item = std::move(waiting_.front());
      waiting_.pop_front();
      ++running_;
      // The slot's own reference keeps its evaluator alive if another scenario replaces it
      // meanwhile.
      generation = current_;
      number = generation_;
      // Under the same lock as the removal: an item that is taken back has not started.
      events_.emplace_back(ItemStarted{item.key});
    }
    SWARMSMITH_ASSERT(slot < generation->evaluators.size(), "each slot has its evaluator");
    finish(number, evaluate(generation->evaluators[slot], item));
  }
}

void Pool::finish(std::uint64_t generation, Result result) {
  bool wake = false;
  {
    const std::scoped_lock lock(mutex_);
    SWARMSMITH_ASSERT(running_ > 0, "what is finished was running");
    --running_;
    // In another scenario its key means another evaluation.
    if (generation != generation_) return;
    events_.emplace_back(std::move(result));
    ++results_;
    const bool first = results_ == 1 && !owner_comes_;
    // The coordinator must hear of the results now, or a slot waits for its next task.
    const bool dry = waiting_.size() + running_ <= static_cast<std::size_t>(slots_);
    wake = first || dry || results_ == kMaxWaiting;
  }
  // Without the lock, so that the owner does not wake only to wait for it.
  if (wake) wake_();
}

}  // namespace swarmsmith
