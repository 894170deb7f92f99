#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "coordinator/design/task.h"

namespace swarmsmith {

/// The calls of a targetEvaluator, which are made one after another (irace facts, 18.4): the first
/// call for a pair may write data that the next ones read, such as the limits of a normalisation.
/// The pair of a call is the number of its task; the tasks of the race and of the tests share one
/// numbering, so that no two tasks have the same number.
class TargetCalls {
 public:
  void add(Task call) { waiting_.push_back(std::move(call)); }
  /// The call to make now; none while another call is running.
  std::optional<Task> next();
  /// The running call has finished.
  void finish();

  /// The pair for the race's task with this number, counted from 1 over all iterations.
  std::int64_t pair_in_race(std::int64_t task);
  /// The pair for a test, counted from 1.
  std::int64_t pair_in_tests(std::int64_t test) const { return last_ + test; }
  /// Starts the calls for this number of tests.
  void begin_tests(std::int64_t count) { in_tests_ = count; }
  bool are_tests_begun() const { return in_tests_.has_value(); }
  /// The race continues after the tests, and its further tasks are numbered after them.
  void go_on();

 private:
  std::deque<Task> waiting_;
  bool is_calling_ = false;
  std::int64_t last_ = 0;                 ///< the last task before the current tests
  std::int64_t tests_ = 0;                ///< number of tasks for tests before the race continued
  std::optional<std::int64_t> in_tests_;  ///< number of tests in the current calls
};

}  // namespace swarmsmith
