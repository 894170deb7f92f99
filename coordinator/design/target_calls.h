#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "coordinator/design/task.h"

namespace swarmsmith {

/// Calls of a targetEvaluator. They are made one after the other (irace facts, 18.4): the first one
/// of a pair may well write what the next ones read, such as the limits of a normalisation. Their
/// pairs number the design's tasks, those of the race and those of the tests through each other, so
/// that no two tasks have one number.
class TargetCalls {
 public:
  void add(Task call) { waiting_.push_back(std::move(call)); }
  /// The call to be made now; nothing while one is on its way.
  std::optional<Task> next();
  /// The call that was on its way was made.
  void finish();

  /// The pair of the race's task with this number, from 1 through all its iterations.
  std::int64_t pair_in_race(std::int64_t task);
  /// The pair of a test, from 1.
  std::int64_t pair_in_tests(std::int64_t test) const { return last_ + test; }
  /// So many tests are called.
  void begin_tests(std::int64_t count) { in_tests_ = count; }
  bool are_tests_begun() const { return in_tests_.has_value(); }
  /// The race goes on after the tests, and its further tasks follow theirs.
  void go_on();

 private:
  std::deque<Task> waiting_;
  bool is_calling_ = false;
  std::int64_t last_ = 0;   ///< pair of the last task before the tests that are called
  std::int64_t tests_ = 0;  ///< tasks that were tests before the race went on
  std::optional<std::int64_t> in_tests_;  ///< tests that are called now
};

}  // namespace swarmsmith
