#include "coordinator/design/target_calls.h"

#include <algorithm>
#include <utility>

#include "base/assert.h"

namespace swarmsmith {

std::optional<Task> TargetCalls::next() {
  // One after the other, in the order of the race (irace facts, 18.4).
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
  // A race that was extended continues after its tests, so the numbers of their calls are left out.
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
