#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/expected.h"
#include "coordinator/design/ahead_tasks.h"
#include "coordinator/design/batch.h"
#include "coordinator/design/command_log.h"
#include "coordinator/design/elite_tests.h"
#include "coordinator/design/known_scores.h"
#include "coordinator/design/plans.h"
#include "coordinator/design/row_recorder.h"
#include "coordinator/design/target_calls.h"
#include "coordinator/design/task.h"
#include "coordinator/design/work_source.h"
#include "irace_core/search.h"
#include "storage/rows.h"

namespace swarmsmith {

/// One iterated race and the tests of its elites: hands out tasks, takes outcomes, and produces
/// rows. A pure state machine (docs/architecture.md, "A design's life"). At the start it replays
/// the stored part of the race: known scores are not evaluated again, and the rows up to the last
/// stored step are not produced again.
///
/// Commands (docs/irace.md, "More budget, and an early end") take effect between two batches, and
/// their rows contain the number of the last step before that; in a replay they take effect there
/// again. A "cancel" takes effect as soon as possible: the design stops, and evaluations after that
/// step do not count. An "extend" takes effect when the race and its tests are over: the race
/// continues from its end, and its new elites are tested.
class DesignRunner {
 public:
  /// Fails if the scenario does not fit the space; if the budget is too small, the error gives the
  /// smallest sufficient one.
  static Expected<DesignRunner> start(DesignPlan plan, StoredDesign stored);

  /// Appends the newly wanted tasks to `tasks`, in canonical order, and the rows that are due to
  /// `rows`. Error: the replay gave a different step than the store has, so the store was written
  /// by another engine or is damaged.
  Expected<void> advance(std::vector<Task>& tasks, std::vector<Row>& rows);

  /// The task of an evaluation that the race or the tests have asked for; none for others.
  std::optional<Task> task_of(const EvaluationKey& key) const;

  /// The outcome of a task that was wanted or handed out ahead; its row is appended to `rows`. Call
  /// `advance` after one or more of these calls.
  void tell(const Outcome& outcome, std::vector<Row>& rows);

  /// Appends at most `count` tasks that the race may want after its current batch, on the next
  /// `pairs` pairs (Task::ahead; orchestration facts, 10); no task is handed out twice. These tasks
  /// and their outcomes change no row of the answer: their scores are stored without an iteration
  /// until the race asks for them. A task that the race wants before its outcome has come is handed
  /// out again by `advance`, like any other.
  void look_ahead(std::size_t count, std::int64_t pairs, std::vector<Task>& tasks,
                  std::vector<Row>& rows);
  /// Tasks that were handed out and are no longer needed. Their outcomes are still accepted.
  std::vector<EvaluationKey> take_dropped() { return ahead_.take_dropped(); }
  /// Tasks without an outcome that were handed out although the race did not want them, with their
  /// bounds: their outcomes may still come when the design is over.
  std::vector<std::pair<EvaluationKey, double>> outstanding() const { return ahead_.outstanding(); }
  /// The candidates that are out of the race, if an iteration has ended since the last call.
  std::optional<PassedCandidates> take_passed() { return std::exchange(passed_, std::nullopt); }
  /// The number of tasks that the design waits for; the design with the fewest is nearest to a
  /// barrier.
  std::size_t awaited() const { return batch_.n_awaited(); }

  /// Takes a command; `advance` carries it out when it can take effect. If it cannot take effect
  /// yet, its row is appended to `rows` now. Errors: the command is not possible in the design's
  /// current state; the message says why.
  Expected<void> command(const CommandRow& command, std::vector<Row>& rows);

  DesignState state() const { return recorder_.design().state; }
  DesignId id() const { return plan_.row.id; }
  std::int64_t used() const { return recorder_.design().used; }
  const std::string& source() const { return plan_.source; }
  /// Stored scores that the race has not asked for (yet), including those that were computed ahead.
  const StoredDesign& unasked() const { return scores_.unasked(); }

 private:
  DesignRunner(DesignPlan plan, StoredDesign stored, std::unique_ptr<Search> search);

  // Transitions between states.
  Expected<void> go_on(std::vector<Task>& tasks);
  /// From Waiting to the first evaluations.
  Expected<void> begin(std::vector<Task>& tasks);
  /// Continues the race until evaluations are awaited or the race is over.
  Expected<void> go_on_racing(std::vector<Task>& tasks);
  /// Starts the elites' tests; ends the design without tests if all configurations were rejected.
  Expected<void> finish_race(std::vector<Task>& tasks);
  /// All outcomes of the tests have come; returns true if there is nothing left to test.
  bool finish_tests(std::vector<Task>& tasks);
  /// Whether a cancel takes effect now.
  bool is_cancelled() const;
  void cancel(std::vector<Task>& tasks);
  /// Continues the race with more budget, if an extension was requested.
  Expected<bool> extend(std::vector<Task>& tasks);

  // Evaluations.
  void want_batch(std::vector<Task>& tasks);
  /// Instead of a race, tests the given configurations.
  void test_the_given(std::vector<Task>& tasks);
  void want_tests(std::vector<Task>& tasks);
  /// Asks a targetEvaluator for the scores of the test runs.
  void want_test_calls(std::vector<Task>& tasks);
  /// Takes the experiment's score from the known scores, or makes a task for it.
  void want(std::size_t position, const EvaluationKey& key, const Experiment& experiment,
            std::vector<Task>& tasks);
  EvaluationKey key_of(Purpose purpose, const Experiment& experiment) const;
  Task task_of(const EvaluationKey& key, const Experiment& experiment) const;
  std::string call_of(std::int64_t number) const;

  // Events of the race.
  Expected<void> tell_race();
  Expected<void> take_events();
  Expected<void> add_candidate(const ConfigurationSampled& sampled);
  Error beyond(const std::string& what, std::int64_t most) const;
  void end_iteration(const IterationEnded& ended);
  /// The race used these runs (configuration, pair), in this order.
  void count_used(const std::vector<std::pair<std::int64_t, std::int64_t>>& used);
  void count_judged();
  void leave_unused(const StoredScore& score);

  DesignPlan plan_;
  std::unique_ptr<Search> search_;  ///< null if only given configurations are tested
  CommandLog commands_;
  KnownScores scores_;
  Batch batch_;
  AheadTasks ahead_;
  TargetCalls calls_;
  EliteTests tests_;
  RowRecorder recorder_;

  /// Scores that the race has not reported as used yet, in the order of its requests.
  std::deque<StoredScore> given_;
  std::map<std::int64_t, Experiment> pairs_;  ///< the race's pairs, as they were first used
  /// The texts that workers get for the candidates in the race, by number.
  std::map<std::int64_t, std::string> call_texts_;
  std::optional<PassedCandidates> passed_;
  std::optional<Error> fault_;  ///< a fault of the store that the replay found
};

}  // namespace swarmsmith
