#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/experiment.h"
#include "irace_core/internal/agreement.h"
#include "irace_core/internal/elimination.h"
#include "irace_core/internal/race_settings.h"
#include "irace_core/internal/ranks.h"
#include "irace_core/race_event.h"

namespace swarmsmith::irace {

/// One race (irace facts, 9), elitist or not, as ask and tell.
///
/// No configuration is dropped between two tests, so that all runs up to the next test are asked
/// for at once. Results are used in the order (task, id). Two kinds of runs are neither counted nor
/// used: runs of a rejected configuration on later tasks, and all runs that follow a stop.
///
/// If the next question depends on the last answers, fewer runs are asked for at once: one task at
/// a time with one_task_at_a_time; with a targetEvaluator, a task's runs and then its calls; with
/// capping, first the protected elites that have not been run on the pair, bounded by bound_max,
/// then the others, bounded by the elites' times.
class Race {
 public:
  /// The elites come first among the contestants.
  Race(RaceSettings settings, std::vector<Contestant> contestants);

  bool finished() const { return stop_.has_value(); }
  /// The reason why the race stopped, as text.
  const std::string& stop_reason() const { return *stop_; }
  /// Whether all contestants were rejected, so that there is no result.
  bool none_left() const { return alive_.empty(); }
  /// An error of the target with which no race can continue: a time above its bound, or no time
  /// although bounds need one. The race is then finished, and its survivors are meaningless.
  const std::optional<Error>& failure() const { return failure_; }

  std::span<const RaceRun> wanted() const { return wanted_; }
  /// Takes the results of all wanted runs, in their order; infinite costs reject. Times below
  /// min_measurable_time are raised to it; 0 is an unknown time. Adds steps for take_steps().
  void tell(std::span<const Measurement> measurements);
  /// The runs that would be wanted next on up to `pairs` further pairs, in canonical order, if the
  /// coming tests dropped no configuration (and the race did not stop because of elitist_limit).
  /// Empty if results decide more than which configurations are alive (bounds, calls of a
  /// targetEvaluator), and with one_task_at_a_time, which never asks for runs that may be in vain.
  std::vector<RaceRun> ahead(std::int64_t pairs) const;
  /// The tasks since the last call. Ids are filled in; the caller adds the iteration and the
  /// generators.
  std::vector<RaceStep> take_steps();

  std::int64_t used() const { return used_; }
  std::size_t alive_count() const { return alive_.size(); }
  std::vector<std::int64_t> alive_ids() const;  ///< ascending
  const Contestant& contestant(std::size_t column) const { return contestants_[column]; }
  std::int64_t pair_of(std::size_t task) const { return settings_.pairs[task]; }
  std::size_t size() const { return contestants_.size(); }

  /// A cost that this race has measured.
  struct Result {
    std::int64_t pair;
    double cost;
    double time = 0;
    /// True if this was not run here: the targetEvaluator was called again for a past pair, and
    /// `cost` replaces the known cost, from which it differs. The time does not change.
    bool replaces = false;
  };
  /// All results of a contestant from runs in this race (or replaced, see `replaces`), in the order
  /// of the tasks.
  std::vector<Result> results(std::size_t column) const;
  bool is_rejected(std::size_t column) const { return rejected_[column]; }

  /// A survivor and its overall rank.
  struct Survivor {
    std::size_t column;
    double rank;
  };
  /// The configurations left at the end, best first.
  std::vector<Survivor> survivors() const;

 private:
  /// The state that the rules use and that changes from task to task while no configuration is
  /// dropped.
  struct Progress {
    std::size_t task = 0;  ///< tasks that are done
    std::int64_t used = 0;
    std::vector<std::int64_t> protection;  ///< by column: known pairs whose tasks are still to come
    std::vector<std::int64_t> results;     ///< by column: number of pairs with a result
  };

  /// A task that has begun. The runs `due` must be answered now; the runs `later` come after them.
  struct OpenTask {
    RaceStep step;
    std::vector<std::size_t> due;    ///< columns, in the order in which they are asked for
    std::vector<std::size_t> later;  ///< columns, in the same order
    bool evaluates = false;          ///< whether `due` are calls of the targetEvaluator
    bool only_elites = false;        ///< whether only protected elites are run; with capping
    std::vector<std::size_t> ran;    ///< columns that were run
    std::vector<double> bounds;      ///< by column: bound of the run in this task, 0 for none
  };

  // race.cpp: how a task proceeds
  /// Begins the next task unless a rule stops the race.
  bool open_task();
  /// Takes the answers, from `at` on, to all runs that are due; moves `at` past them.
  void take_in(std::span<const Measurement> measurements, std::size_t& at);
  void take_run(const RaceRun& run, const Measurement& measurement);
  void take_evaluation(std::size_t column, double cost);
  /// Called when all that was due has been answered: asks for more runs of the task, or closes it.
  void go_on();
  /// Applies rules 9.3.4 to 9.3.10 to the results of the task.
  void close_task();
  void reject_infinite(std::span<const std::size_t> columns, RaceStep& step);
  void fail(const RaceRun& run, const std::string& what);

  // race_plan.cpp: which runs are needed, and when a race ends
  /// Whether the result is known from before or was measured in this race.
  bool has_result(std::size_t column, std::size_t task) const;
  bool any_protected(const Progress& progress) const;
  /// Columns that are alive and have no result on the next task, by id (rule 9.3.1).
  std::vector<std::size_t> to_run(const Progress& progress) const;
  std::vector<std::size_t> by_id(std::vector<std::size_t> columns) const;
  /// The reason for stopping before a task with this number of runs.
  std::optional<std::string> reason_to_stop(const Progress& progress, std::size_t runs) const;
  /// Applies rule 9.3.2; called if the elites are done.
  std::optional<std::string> rule_to_stop(const Progress& progress, std::size_t runs) const;
  bool elites_are_done(const Progress& progress) const;
  /// Whether there is a test after the first `task` tasks.
  bool is_test_point(std::size_t task) const;
  void pass(Progress& progress, std::span<const std::size_t> ran) const;
  void plan();
  /// Whether all runs up to the next test are asked for at once, so that later ones can be
  /// predicted.
  bool asks_ahead() const;
  /// Sets the bounds of all runs that are due.
  void set_bounds();
  /// The elites' time, which determines the bounds of the others; nothing without protected elites.
  std::optional<double> elite_time() const;

  // race_elimination.cpp: which configurations are dropped, and the sums that decide it
  void eliminate(RaceStep& step);
  /// The columns that the test would drop, protected ones included; ascending.
  std::vector<std::size_t> worse_by_test(RaceStep& step);
  TestResult test_of_two();
  TestResult t_tests();
  /// The columns that capping would drop, protected ones included; ascending.
  std::vector<std::size_t> worse_by_times() const;
  bool is_capping_point() const;
  std::span<const double> costs_so_far(std::size_t column) const;
  /// Mean costs of all alive columns over the finished tasks.
  std::vector<double> means() const;
  /// Adds the task's costs of all alive columns to the rank sums.
  void add_ranked_row(std::size_t task);
  /// Removes columns from the race and from all sums.
  void drop(const std::vector<std::size_t>& columns);
  void find_uncovered();
  void describe_best(RaceStep& step) const;
  void describe_agreement(RaceStep& step) const;
  std::uint64_t digest(const RaceStep& step) const;

  RaceSettings settings_;
  std::vector<Contestant> contestants_;
  std::vector<std::vector<double>> costs_;  ///< by column, then task
  std::vector<std::vector<double>> times_;  ///< the same
  std::vector<bool> rejected_;
  std::vector<std::size_t> alive_;  ///< columns, ascending
  Progress progress_;
  std::int64_t used_ = 0;
  std::int64_t tests_without_drop_ = 0;
  /// The number, from 1, of the last task among new and past pairs on which no alive configuration
  /// has a result; 0 if there is none.
  std::size_t uncovered_ = 0;

  RankTable ranks_;
  QualityVariance quality_;
  StudentQuantiles quantiles_;

  std::optional<OpenTask> open_;
  std::vector<RaceRun> wanted_;
  std::vector<RaceStep> steps_;
  std::optional<std::string> stop_;
  std::optional<Error> failure_;
};

}  // namespace swarmsmith::irace
