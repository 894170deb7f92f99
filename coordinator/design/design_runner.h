#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/expected.h"
#include "coordinator/campaign/candidate_text.h"
#include "coordinator/design/task.h"
#include "coordinator/design/work_source.h"
#include "irace_core/iterated_race.h"
#include "storage/rows.h"

namespace swarmsmith {

/// How the elites are judged after the race, outside of its budget.
struct TestPlan {
  std::int64_t count = 0;  ///< pairs
  /// Pair n is test instance n; else fresh seeds on the training instances in turn.
  bool on_test_instances = false;
  std::int64_t elites = 1;       ///< how many of the last iteration
  bool every_iteration = false;  ///< as many of each other iteration too
};

/// One design, ready to run.
struct DesignPlan {
  DesignRow row;
  std::uint32_t mission = 0;  ///< index into the campaign's missions
  std::uint32_t method = 0;   ///< index into the campaign's methods
  ParameterSpace space;
  Scenario scenario;  ///< with the design's seed and budget
  std::function<CandidateText(const Configuration&)> describe;
  TestPlan tests;
  std::string source;                    ///< the simulator profile's name; "command" for programs
  std::vector<Configuration> initial{};  ///< that the first race begins with
  Repair repair{};                       ///< of sampled configurations; empty for none
  bool only_test = false;                ///< no race: the initial configurations are tested
  /// "cancel" and "extend" of this design, by number, as the store has them; see DesignRunner.
  std::vector<CommandRow> commands{};
};

/// What speaks against a command to a design, whatever its state: only races can be cancelled and
/// extended, by experiments where the budget is in experiments, and nothing follows a cancel.
Expected<void> check_command(const DesignPlan& plan, const CommandRow& command);

/// What a store knows of one design, for replay.
struct StoredDesign {
  /// By candidate number and pair, see `DesignRunner::key_of`.
  std::unordered_map<std::uint64_t, StoredScore> race_scores;
  std::unordered_map<std::uint64_t, StoredScore> test_scores;
  /// Of a targetEvaluator: by candidate number and task.
  std::unordered_map<std::uint64_t, StoredScore> evaluator_scores;
  /// Digest of step n at index n - 1.
  std::vector<std::uint64_t> step_digests;
};

/// The row of an outcome; iteration 0 when no race used it.
EvaluationRow evaluation_row(const Outcome& outcome, std::int64_t iteration, double bound,
                             const std::string& source);

/// One iterated race and the tests of its elites: gives tasks, takes outcomes, gives rows. A pure
/// state machine. Starts by replaying what the store knows: known scores are not asked for again,
/// and the rows that led to the last stored step are not given again.
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
  /// Tasks that were given and that nobody wants any more. Outcomes that come all the same are
  /// taken.
  std::vector<EvaluationKey> take_dropped() { return std::exchange(dropped_, {}); }
  /// Tasks that were given without being wanted and have no outcome, with their bounds: what may
  /// still come when the design is over.
  std::vector<std::pair<EvaluationKey, double>> outstanding() const;
  /// Since the last call, if an iteration has ended.
  std::optional<PassedCandidates> take_passed() { return std::exchange(passed_, std::nullopt); }
  /// How many tasks it waits for: the design with the fewest is the nearest to a barrier.
  std::size_t awaited() const { return awaited_.size(); }

  /// A further command; `advance` carries it out when it can act. Its row goes to `rows` now when
  /// it cannot act yet. Errors: what cannot be asked of this design as it stands, and why.
  Expected<void> command(const CommandRow& command, std::vector<Row>& rows);

  DesignState state() const { return state_; }
  DesignId id() const { return plan_.row.id; }
  std::int64_t used() const { return used_; }
  const std::string& source() const { return plan_.source; }
  /// Stored scores that the race has not asked for (yet), those that were computed ahead included.
  const StoredDesign& unasked() const { return stored_; }

  static std::uint64_t key_of(std::int64_t candidate_number, std::int64_t pair) {
    return (static_cast<std::uint64_t>(candidate_number) << 32U) | static_cast<std::uint64_t>(pair);
  }

  static std::uint64_t packed_key(const EvaluationKey& key) {
    return key_of(number_of(key.candidate), key.pair);
  }

 private:
  struct Totals {
    std::int64_t runs = 0;
    double score_sum = 0;
    double score_squares = 0;
  };

  DesignRunner(DesignPlan plan, StoredDesign stored, std::optional<IteratedRace> race);

  Expected<void> go_on(std::vector<Task>& tasks, std::vector<Row>& rows);
  /// From waiting on to what is to be evaluated first.
  Expected<void> begin(std::vector<Task>& tasks, std::vector<Row>& rows);
  /// The tests' outcomes are there: true when nothing is left to be tested.
  bool finish_tests(std::vector<Task>& tasks, std::vector<Row>& rows);

  // design_commands.cpp
  /// The commands that acted in the order in which they did, then the others.
  void sort_commands();
  /// The next one of this kind, when it acts here.
  const CommandRow* next_command(const char* kind) const;
  /// A cancel that acts now.
  bool is_cancelled() const;
  void cancel(std::vector<Task>& tasks, std::vector<Row>& rows);
  /// The race goes on with more budget, if that was asked for.
  Expected<bool> extend(std::vector<Task>& tasks, std::vector<Row>& rows);
  void record_acted(CommandRow command, std::vector<Row>& rows);
  void warn(const std::string& text, std::vector<Row>& rows) const;

  // design_ahead.cpp
  /// A score that nobody waits for.
  void keep_ahead(const Outcome& outcome, double bound, std::vector<Row>& rows);
  /// Lets go what was given of candidates that are out of the race.
  void drop_void();
  bool is_known_or_out(std::uint64_t packed) const;
  /// Races on until something is awaited or the race is over.
  Expected<void> go_on_racing(std::vector<Task>& tasks, std::vector<Row>& rows);
  /// To the tests of the elites; or to an end without, when every configuration was rejected.
  Expected<void> finish_race(std::vector<Task>& tasks, std::vector<Row>& rows);
  /// In place of a race.
  void test_the_given(std::vector<Task>& tasks, std::vector<Row>& rows);
  void want_batch(std::vector<Task>& tasks, std::vector<Row>& rows);
  /// Who is tested: the last iteration's elites, best first, then those of the others.
  std::vector<std::int64_t> tested() const;
  void want_tests(std::vector<Task>& tasks, std::vector<Row>& rows);
  /// A targetEvaluator's word on the tests that were run.
  void want_test_calls(std::vector<Task>& tasks, std::vector<Row>& rows);
  void begin_batch(std::vector<Experiment> batch);
  /// Takes the experiment's score from what is known, or makes a task of it.
  void want(std::size_t position, const EvaluationKey& key, const Experiment& experiment,
            std::vector<Task>& tasks, std::vector<Row>& rows);
  Task task_of(const EvaluationKey& key, const Experiment& experiment) const;
  std::string call_of(std::int64_t number) const;
  /// What is stored under the key of this purpose and was not asked for.
  std::unordered_map<std::uint64_t, StoredScore>& known(Purpose purpose);
  void put(std::size_t position, const StoredScore& score);
  /// The store has the evaluation; when no iteration has used it so far, it takes it from this row.
  void record_use(const StoredScore& score, std::vector<Row>& rows) const;
  void record_pair(Purpose purpose, const Experiment& experiment, std::vector<Row>& rows);
  Expected<void> record_events(std::vector<Row>& rows);
  Expected<void> record_step(const RaceStep& step, std::vector<Row>& rows);
  void record_estimate(const TimeEstimated& estimated, std::vector<Row>& rows);
  void record_consumed(const RaceStep& step, std::vector<Row>& rows);
  /// The race's next use of a result that it was given; those before it were not used.
  void consume(std::int64_t configuration, std::int64_t pair, std::vector<Row>& rows);
  /// Costs that replace those of earlier tasks.
  void record_judged(std::vector<Row>& rows);
  void record_unused(std::size_t until, std::vector<Row>& rows);
  void record_candidate(const ConfigurationSampled& sampled, std::vector<Row>& rows);
  void record_iteration_start(const IterationStarted& started, std::vector<Row>& rows);
  void forget_losers();
  void record_iteration_end(const IterationEnded& ended, std::vector<Row>& rows);
  void record_state(std::vector<Row>& rows);
  Error other_way() const;
  /// Rows of the race go through here: those that led to the last stored step are on disk.
  void record(Row row, std::vector<Row>& rows) const;
  /// None for 0.
  CandidateId candidate(std::int64_t number) const {
    return number > 0 ? candidate_id(plan_.row.id, number) : CandidateId{};
  }

  DesignPlan plan_;
  StoredDesign stored_;
  std::optional<IteratedRace> race_;  ///< none when only given configurations are tested
  DesignState state_ = DesignState::Waiting;

  std::size_t next_command_ = 0;  ///< in the plan; those before it have acted

  /// What was given ahead and has no outcome yet.
  struct Ahead {
    EvaluationKey key;
    double bound;
    bool dropped;  ///< nobody wants it any more
  };
  std::map<std::uint64_t, Ahead> ahead_;
  std::vector<EvaluationKey> dropped_;
  std::optional<PassedCandidates> passed_;
  /// What the race would want after the current batch, on so many pairs; how many were looked at.
  std::vector<Experiment> next_;
  std::int64_t next_pairs_ = 0;
  std::size_t next_seen_ = 0;

  /// What is waited for, in the race's order: a batch of the race, or the tests.
  std::vector<Experiment> batch_;
  std::vector<Measurement> measurements_;
  std::vector<StoredScore> scores_;                         ///< that these were made of
  std::unordered_map<std::uint64_t, std::size_t> awaited_;  ///< position by key
  /// Scores that the race wanted and did not use; it may want them again, in a later iteration.
  std::unordered_map<std::uint64_t, StoredScore> unused_;
  /// Results that the race was told and has not reported the use of.
  struct Given {
    std::int64_t configuration;
    std::int64_t pair;
    StoredScore score;
  };
  std::vector<Given> given_;
  std::size_t consumed_ = 0;  ///< of them, by the race's steps
  bool reported_ = false;     ///< a step or an estimate came with the last batch
  std::int64_t pairs_known_ = 0;
  std::map<std::int64_t, Experiment> pairs_;  ///< of the race, as somebody was first tried on them
  std::int64_t tests_known_ = 0;              ///< pairs of the tests
  std::int64_t calls_known_ = 0;              ///< tasks of the targetEvaluator
  std::int64_t test_calls_ = 0;               ///< of them in testing, before the race went on
  /// Of tests: those who are tested again after an extension are not run again.
  std::unordered_map<std::uint64_t, StoredScore> tested_scores_;
  bool test_calls_wanted_ = false;
  /// Calls of the targetEvaluator that wait for their turn. They are made one after the other
  /// (irace facts, 18.4): the first one of a pair may well write what the next ones read, such as
  /// the limits of a normalisation.
  std::deque<Task> calls_;
  bool is_calling_ = false;
  std::vector<std::int64_t> testing_;  ///< numbers of those who are tested
  std::optional<Error> fault_;         ///< of the store, found while the race was played again

  std::map<std::int64_t, std::string>
      calls_of_;                ///< texts for workers, by number, of those in the race
  std::vector<Totals> totals_;  ///< by candidate number - 1
  /// By candidate number - 1, score by pair: what a targetEvaluator said last. Else empty.
  std::vector<std::map<std::int64_t, double>> judged_;
  std::vector<std::vector<std::int64_t>> elites_;  ///< of each iteration, best first
  std::set<std::int64_t> alive_;                   ///< numbers, in the current iteration
  std::size_t steps_ = 0;                          ///< of the race, seen so far
  std::int64_t iteration_ = 0;
  std::int64_t used_ = 0;
  std::int64_t best_ = 0;  ///< number of the best so far, the winner at the end
  double best_mean_ = 0;
  std::string reason_;
};

}  // namespace swarmsmith
