#include "coordinator/design/target_calls.h"

#include <algorithm>
#include <utility>

#include "base/assert.h"

namespace swarmsmith {

std::optional<Task> TargetCalls::next() {
  if (is_calling_ || waiting_.empty()) return std::nullopt;
  is_calling_ = true;
  Task call = std::move(waiting_.front());
  waiting_.pop_front();
  return call;
}

void TargetCalls::finish() {
  SWARMSMITH_ASSERT(is_calling_, "a call is over once, and only when it was given");
  is_calling_ = false;
}

std::int64_t TargetCalls::pair_in_race(std::int64_t task) {
  SWARMSMITH_ASSERT(task >= 1 && tests_ >= 0, "calls count upwards from 1");
  const std::int64_t pair = task + tests_;
  last_ = std::max(last_, pair);
  return pair;
}

void TargetCalls::go_on() {
  const std::int64_t called = std::exchange(in_tests_, std::nullopt).value_or(0);
  tests_ += called;
  last_ += called;
}

}  // namespace swarmsmith
