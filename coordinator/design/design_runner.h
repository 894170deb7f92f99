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

/// One iterated race and the tests of its elites: gives tasks, takes outcomes, gives rows. A pure
/// state machine (docs/architecture.md, "A design's life"). Starts by replaying what the store
/// knows: known scores are not asked for again, and the rows that led to the last stored step are
/// not given again.
///
/// Commands (docs/irace.md, "More budget, and an early end") act between two batches, and their
/// rows get the number of the race's step after which they did; replayed, they act there again. A
/// "cancel" acts as soon as it can: the design stops, and what was evaluated after that step counts
/// nowhere. An "extend" acts when the race and its tests are over: the race goes on from its end,
/// and its new elites are tested.
class DesignRunner {
 public:
  /// Fails when the scenario does not fit the space (budget too small: the smallest that works).
  static Expected<DesignRunner> start(DesignPlan plan, StoredDesign stored);

  /// Appends the tasks that became wanted to `tasks`, in canonical order, and the rows that became
  /// due to `rows`. An error: the replay came to another step than the store has, so that the store
  /// was written by another engine or is damaged.
  Expected<void> advance(std::vector<Task>& tasks, std::vector<Row>& rows);

  /// The task of an evaluation in the race or the tests that was asked for; nothing for others.
  std::optional<Task> task_of(const EvaluationKey& key) const;

  /// A wanted task's outcome, or that of one that was given ahead; its row goes to `rows`. Call
  /// `advance` after one or more of these.
  void tell(const Outcome& outcome, std::vector<Row>& rows);

  /// Appends at most `count` tasks that the race may want after what it waits for, on the next
  /// `pairs` pairs (Task::ahead; orchestration facts, 10); none is given twice. Which are given,
  /// and whether they are ever told, changes no row of the answer: their scores are stored without
  /// an iteration until the race asks for them. One that is wanted before its outcome is there
  /// comes by `advance`, as any other.
  void look_ahead(std::size_t count, std::int64_t pairs, std::vector<Task>& tasks,
                  std::vector<Row>& rows);
  /// Tasks that were given and are no longer needed. Outcomes that come all the same are
  /// taken.
  std::vector<EvaluationKey> take_dropped() { return ahead_.take_dropped(); }
  /// Tasks that were given without being wanted and have no outcome, with their bounds: what may
  /// still come when the design is over.
  std::vector<std::pair<EvaluationKey, double>> outstanding() const { return ahead_.outstanding(); }
  /// Since the last call, if an iteration has ended.
  std::optional<PassedCandidates> take_passed() { return std::exchange(passed_, std::nullopt); }
  /// How many tasks it waits for: the design with the fewest is the nearest to a barrier.
  std::size_t awaited() const { return batch_.n_awaited(); }

  /// A further command; `advance` carries it out when it can act. Its row goes to `rows` now when
  /// it cannot act yet. Errors: what cannot be asked of this design as it stands, and why.
  Expected<void> command(const CommandRow& command, std::vector<Row>& rows);

  DesignState state() const { return recorder_.design().state; }
  DesignId id() const { return plan_.row.id; }
  std::int64_t used() const { return recorder_.design().used; }
  const std::string& source() const { return plan_.source; }
  /// Stored scores that the race has not asked for (yet), those that were computed ahead included.
  const StoredDesign& unasked() const { return scores_.unasked(); }

 private:
  DesignRunner(DesignPlan plan, StoredDesign stored, std::unique_ptr<Search> search);

  // From state to state.
  Expected<void> go_on(std::vector<Task>& tasks);
  /// From waiting on to what is to be evaluated first.
  Expected<void> begin(std::vector<Task>& tasks);
  /// Races on until something is awaited or the race is over.
  Expected<void> go_on_racing(std::vector<Task>& tasks);
  /// To the tests of the elites; or to an end without, when every configuration was rejected.
  Expected<void> finish_race(std::vector<Task>& tasks);
  /// The tests' outcomes are there: true when nothing is left to be tested.
  bool finish_tests(std::vector<Task>& tasks);
  /// A cancel that acts now.
  bool is_cancelled() const;
  void cancel(std::vector<Task>& tasks);
  /// The race goes on with more budget, if that was asked for.
  Expected<bool> extend(std::vector<Task>& tasks);

  // What is evaluated.
  void want_batch(std::vector<Task>& tasks);
  /// In place of a race.
  void test_the_given(std::vector<Task>& tasks);
  void want_tests(std::vector<Task>& tasks);
  /// A targetEvaluator's word on the tests that were run.
  void want_test_calls(std::vector<Task>& tasks);
  /// Takes the experiment's score from what is known, or makes a task of it.
  void want(std::size_t position, const EvaluationKey& key, const Experiment& experiment,
            std::vector<Task>& tasks);
  EvaluationKey key_of(Purpose purpose, const Experiment& experiment) const;
  Task task_of(const EvaluationKey& key, const Experiment& experiment) const;
  std::string call_of(std::int64_t number) const;

  // What the race says of it.
  Expected<void> tell_race();
  Expected<void> take_events();
  void add_candidate(const ConfigurationSampled& sampled);
  void end_iteration(const IterationEnded& ended);
  /// The race used these (configuration, pair), in this order.
  void count_used(const std::vector<std::pair<std::int64_t, std::int64_t>>& used);
  void count_judged();
  void leave_unused(const StoredScore& score);

  DesignPlan plan_;
  std::unique_ptr<Search> search_;  ///< null when only given configurations are tested
  CommandLog commands_;
  KnownScores scores_;
  Batch batch_;
  AheadTasks ahead_;
  TargetCalls calls_;
  EliteTests tests_;
  RowRecorder recorder_;

  /// What the race was told and has not said that it used, in the order in which it asked for it.
  std::deque<StoredScore> given_;
  std::map<std::int64_t, Experiment> pairs_;  ///< of the race, as somebody was first tried on them
  /// Texts for workers, by number, of those in the race.
  std::map<std::int64_t, std::string> call_texts_;
  std::optional<PassedCandidates> passed_;
  std::optional<Error> fault_;  ///< of the store, found while the race was played again
};

}  // namespace swarmsmith
