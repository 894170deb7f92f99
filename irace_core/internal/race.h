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

/// One race (irace facts, 9), as ask and tell; elitist or not.
///
/// Nothing is dropped between two tests, so that all runs up to the next test are asked for at
/// once. Results are consumed in the order (task, id). After a rejection the runs of the rejected
/// one on later tasks, and all runs that follow a stop, are void: neither counted nor used.
///
/// Where the next question depends on the last answers, less is asked for: one task at a time if
/// that is wanted; with a targetEvaluator a task's runs and then its calls; with capping the
/// protected elites that have not seen the pair first, bounded by bound_max, then the others,
/// bounded by the elites' times.
class Race {
 public:
  /// Elites come first among the contestants.
  Race(RaceSettings settings, std::vector<Contestant> contestants);

  bool finished() const { return stop_.has_value(); }
  /// Why it stopped, in words.
  const std::string& stop_reason() const { return *stop_; }
  /// All contestants were rejected: there is no result.
  bool nobody_left() const { return alive_.empty(); }
  /// What a target did that no race can go on with: a time above its bound, or none where bounds
  /// need one. The race is finished then, and its survivors mean nothing.
  const std::optional<Error>& failure() const { return failure_; }

  std::span<const RaceRun> wanted() const { return wanted_; }
  /// What came of all wanted runs, in their order; infinite costs reject. Times below
  /// min_measurable_time are raised to it, 0 is an unknown time. Adds to the steps.
  void tell(std::span<const Measurement> measurements);
  /// What would be wanted next on up to `pairs` further pairs, in canonical order, if the coming
  /// tests dropped none (and went on all the same: elitist_limit is not looked at). Nothing where
  /// results decide more than who is alive: bounds, calls of a targetEvaluator; and nothing with
  /// one_task_at_a_time, which asks for nothing that may be in vain.
  std::vector<RaceRun> ahead(std::int64_t pairs) const;
  /// The tasks since the last call; ids are filled in, iteration and generators are the caller's.
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
    /// Not run here: the targetEvaluator was called again for a past pair, and `cost` takes the
    /// place of the one that was known, from which it differs. The time stays as it was.
    bool replaces = false;
  };
  /// All results of a contestant that were run in this race (or replaced, see `replaces`), in the
  /// order of the tasks.
  std::vector<Result> results(std::size_t column) const;
  bool is_rejected(std::size_t column) const { return rejected_[column]; }

  /// A survivor and its overall rank.
  struct Survivor {
    std::size_t column;
    double rank;
  };
  /// Who is left at the end, best first.
  std::vector<Survivor> survivors() const;

 private:
  /// What the rules look at that changes from task to task while none is dropped.
  struct Progress {
    std::size_t task = 0;  ///< tasks that are done
    std::int64_t used = 0;
    std::vector<std::int64_t> protection;  ///< by column: known pairs still to come
    std::vector<std::int64_t> results;     ///< by column: pairs with a result
  };

  /// A task that has begun. `due` is what has to be answered now, `later` what is run after it.
  struct OpenTask {
    RaceStep step;
    std::vector<std::size_t> due;    ///< columns, in the order in which they are asked for
    std::vector<std::size_t> later;  ///< the same
    bool evaluates = false;          ///< `due` are calls of the targetEvaluator
    bool only_elites = false;        ///< only protected ones are run; with capping
    std::vector<std::size_t> ran;    ///< columns
    std::vector<double> bounds;      ///< by column: of the run in this task, 0 for none
  };

  // race.cpp: how a task goes on
  /// Begins the next task unless a rule stops the race.
  bool open_task();
  /// Uses the answers from `at` on to all that is due; moves `at` behind them.
  void take_in(std::span<const Measurement> measurements, std::size_t& at);
  void take_run(const RaceRun& run, const Measurement& measurement);
  void take_evaluation(std::size_t column, double cost);
  /// After all that was due has been answered: asks for more of the task, or closes it.
  void go_on();
  /// Rules 9.3.4 to 9.3.10, whose results are in place.
  void close_task();
  void reject_infinite(std::span<const std::size_t> columns, RaceStep& step);
  void fail(const RaceRun& run, const std::string& what);

  // race_plan.cpp: who has to be run, and when a race ends
  /// Known from before or run in this race.
  bool has_result(std::size_t column, std::size_t task) const;
  bool anybody_protected(const Progress& progress) const;
  /// Columns that are alive and have no result on the next task, by id (rule 9.3.1).
  std::vector<std::size_t> to_run(const Progress& progress) const;
  std::vector<std::size_t> by_id(std::vector<std::size_t> columns) const;
  /// Why no task follows on which `runs` would be run.
  std::optional<std::string> reason_to_stop(const Progress& progress, std::size_t runs) const;
  /// Rule 9.3.2, where the elites are done.
  std::optional<std::string> rule_to_stop(const Progress& progress, std::size_t runs) const;
  bool elites_are_done(const Progress& progress) const;
  /// Whether a test follows the first `task` tasks.
  bool is_test_point(std::size_t task) const;
  void pass(Progress& progress, std::span<const std::size_t> ran) const;
  void plan();
  /// All runs up to the next test are asked for at once, and later ones can be foretold.
  bool asks_ahead() const;
  /// Sets the bounds of all that is due.
  void set_bounds();
  /// What the bounds of others are taken from; nothing without protected elites.
  std::optional<double> elite_time() const;

  // race_elimination.cpp: who is dropped, and the sums that decide it
  void eliminate(RaceStep& step);
  /// Those that the test would drop, protected ones included; ascending.
  std::vector<std::size_t> worse_by_test(RaceStep& step);
  TestResult test_of_two();
  TestResult t_tests();
  /// Those that capping would drop, protected ones included; ascending.
  std::vector<std::size_t> worse_by_times() const;
  bool is_capping_point() const;
  std::span<const double> costs_so_far(std::size_t column) const;
  /// Means of all who are alive over the tasks that are done.
  std::vector<double> means() const;
  /// The task's costs of all who are alive enter the rank sums.
  void add_ranked_row(std::size_t task);
  /// Takes columns out of the race and out of all sums.
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
  /// Number of leading tasks up to the last one without a result of one alive.
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
