#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/expected.h"
#include "coordinator/campaign/candidate_text.h"
#include "coordinator/task.h"
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
};

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

/// One iterated race and the tests of its elites: gives tasks, takes outcomes, gives rows. A pure
/// state machine. Starts by replaying what the store knows: known scores are not asked for again,
/// and the rows that led to the last stored step are not given again.
class DesignRunner {
 public:
  /// Fails when the scenario does not fit the space (budget too small: the smallest that works).
  static Expected<DesignRunner> start(DesignPlan plan, StoredDesign stored);

  /// Appends the tasks that became wanted to `tasks`, in canonical order, and the rows that became
  /// due to `rows`. An error: the replay came to another step than the store has, so that the store
  /// was written by another engine or is damaged.
  Expected<void> advance(std::vector<Task>& tasks, std::vector<Row>& rows);

  /// A wanted task's outcome; its row goes to `rows`. Call `advance` after one or more of these.
  void tell(const Outcome& outcome, std::vector<Row>& rows);

  DesignState state() const { return state_; }
  DesignId id() const { return plan_.row.id; }
  std::int64_t used() const { return used_; }
  /// Stored scores that the race has not asked for (yet).
  std::size_t unasked() const {
    return stored_.race_scores.size() + stored_.test_scores.size() +
           stored_.evaluator_scores.size();
  }

  static std::uint64_t key_of(std::int64_t candidate_number, std::int64_t pair) {
    return (static_cast<std::uint64_t>(candidate_number) << 32U) | static_cast<std::uint64_t>(pair);
  }

 private:
  struct Totals {
    std::int64_t runs = 0;
    double score_sum = 0;
    double score_squares = 0;
  };

  DesignRunner(DesignPlan plan, StoredDesign stored, std::optional<IteratedRace> race);

  Expected<void> go_on(std::vector<Task>& tasks, std::vector<Row>& rows);
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
  /// What is stored under the key of this purpose and was not asked for.
  std::unordered_map<std::uint64_t, StoredScore>& known(Purpose purpose);
  void put(std::size_t position, const StoredScore& score);
  void record_pair(Purpose purpose, const Experiment& experiment, std::vector<Row>& rows) const;
  Expected<void> record_events(std::vector<Row>& rows);
  Expected<void> record_step(const RaceStep& step, std::vector<Row>& rows);
  void record_estimate(const TimeEstimated& estimated, std::vector<Row>& rows);
  void record_warning(const RaceWarning& warning, std::vector<Row>& rows);
  void record_consumed(const RaceStep& step, std::vector<Row>& rows);
  /// The race's next use of a result that it was given; those before it were not used.
  void consume(std::int64_t configuration, std::int64_t pair, std::vector<Row>& rows);
  /// Costs that replace those of earlier tasks.
  void record_judged(std::vector<Row>& rows);
  void record_unused(std::size_t until, std::vector<Row>& rows);
  void record_candidate(const ConfigurationSampled& sampled, std::vector<Row>& rows);
  void record_iteration_start(const IterationStarted& started, std::vector<Row>& rows);
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
  std::int64_t calls_known_ = 0;  ///< tasks of the targetEvaluator
  bool test_calls_wanted_ = false;
  /// Calls of the targetEvaluator that wait for their turn. They are made one after the other
  /// (irace facts, 18.4): the first one of a pair may well write what the next ones read, such as
  /// the limits of a normalisation.
  std::deque<Task> calls_;
  bool is_calling_ = false;
  std::vector<std::int64_t> testing_;  ///< numbers of those who are tested
  std::optional<Error> fault_;         ///< of the store, found while the race was played again

  std::vector<std::string> machines_;  ///< by candidate number - 1
  std::vector<Totals> totals_;         ///< by candidate number - 1
  /// By candidate number - 1, score by pair: what a targetEvaluator said last.
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
