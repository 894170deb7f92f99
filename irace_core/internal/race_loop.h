#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/assert.h"
#include "base/rng.h"
#include "irace_core/internal/instances.h"
#include "irace_core/internal/kept_configuration.h"
#include "irace_core/internal/model.h"
#include "irace_core/internal/race.h"
#include "irace_core/internal/sampling.h"
#include "irace_core/internal/schedule.h"
#include "irace_core/internal/time_budget.h"
#include "irace_core/iterated_race.h"

namespace swarmsmith {

/// A configuration of the design with everything that is known about it.
struct Candidate {
  /// The result of the candidate on one pair.
  struct Result {
    std::int64_t pair;
    double cost;
    double time;
  };

  irace::KeptConfiguration configuration;
  std::int64_t parent = 0;
  /// Whether it may take part in races: false for forbidden initial configurations and for rejected
  /// ones.
  bool takes_part = true;
  std::vector<Result> results;  ///< in the order in which they arrived

  const Result* on(std::int64_t pair) const;
  /// Adds a result on a new pair, or replaces the cost of a known pair (and its time, if given).
  void know(const Result& result);
  Elite as_elite(std::int64_t id, double rank) const;
};

/// The state of an IteratedRace: the loop over races (irace facts, 2). Its parts are in
/// race_loop.cpp (the loop), race_loop_sampling.cpp (which configurations take part),
/// race_loop_races.cpp (beginning and end of a race), race_loop_estimate.cpp (the first estimate of
/// max_time) and race_loop_postselection.cpp.
class IteratedRace::State {
 public:
  State(ParameterSpace space, Scenario scenario, std::vector<Configuration> initial, Repair repair);
  // The models and the forbidden list point to the space.
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  /// Starts the first race, or the first estimate. An error is returned, not reported as an event.
  Expected<void> begin();
  /// Takes the answers to all wanted experiments.
  void tell(std::span<const Measurement> measurements);

  /// See IteratedRace.
  std::vector<Experiment> ahead(std::int64_t pairs) const;
  Expected<void> extend(std::int64_t experiments);
  Expected<std::int64_t> least_extension() const;

  std::int64_t used() const;       ///< experiments counted so far
  std::int64_t remaining() const;  ///< before the current race
  std::int64_t budget() const;
  std::vector<std::int64_t> alive() const;

  bool finished = false;
  std::optional<Error> failure;
  std::vector<Experiment> wanted;
  std::vector<RaceEvent> events;

  ParameterSpace space;
  Scenario scenario;
  std::vector<Candidate> candidates;  ///< by id - 1
  std::vector<Elite> elites;
  std::int64_t iteration = 0;
  std::int64_t iterations = 0;
  std::unique_ptr<irace::Race> race;
  std::optional<irace::TimeBudget> time;  ///< with max_time

 private:
  /// The first estimate of max_time, batch by batch.
  struct Estimate {
    std::vector<std::int64_t> tried;  ///< all configurations of earlier batches
    std::vector<std::int64_t> batch;
    /// Runs of the batch, while the targetEvaluator is asked for their costs.
    std::vector<Measurement> runs;
    std::int64_t pairs;
  };
  /// A run whose result was given to the race and that no step has reported yet. Most of them are
  /// reported in a step; those of rejected configurations are ignored.
  struct ToldRun {
    double time;
    bool was_known;
  };
  /// Whether a run that the race wants was made before: without elitism, a deterministic target
  /// would only repeat its result.
  bool is_known(const irace::RaceRun& run) const;
  Experiment experiment_of(const irace::RaceRun& run) const;

  // The loop.
  void take_initial(std::vector<Configuration> initial);
  /// The measurements, with times raised to min_measurable_time. An error if a budget of time needs
  /// a time and the target did not give it; that ends the design.
  Expected<std::vector<Measurement>> raised_times(std::span<const Measurement> measurements) const;
  /// Plans, samples and sets up the next race or the post-selection race, or finishes.
  Expected<void> begin_race();
  /// Asks for the runs that the race wants next; continues with further races as long as no run has
  /// to be asked for.
  void advance();
  void warn(std::string text);
  void stop(std::string reason);
  void fail(Error error);
  /// An error with the reason why the design cannot be extended, if there is one.
  Expected<void> may_be_extended() const;

  // Choice of the configurations of a race.
  /// The configurations of the first race: elites of the estimate, then given ones, then sampled
  /// ones.
  Expected<std::vector<std::int64_t>> first_contestants(const irace::RacePlan& plan);
  /// The configurations of a later race: elites by rank, then new ones from their models, which are
  /// sampled again after a soft restart.
  Expected<std::vector<std::int64_t>> later_contestants(const irace::RacePlan& plan,
                                                        IterationStarted& started);
  /// Samples up to `count` new configurations from the initial distribution.
  Expected<std::vector<std::int64_t>> sample_initial(std::int64_t count, std::int64_t in_iteration);
  /// Samples `count` configurations from the models; forbidden ones are replaced, in up to 100
  /// rounds.
  Expected<std::vector<Candidate>> sample_new(std::int64_t count, Rng& rng);
  /// The elites whose models sampled configurations that are too similar; each once, ascending.
  std::vector<std::int64_t> lines_to_restart(const std::vector<Candidate>& sampled) const;
  std::vector<irace::EliteLine> elite_lines() const;
  /// Gives the candidate the next id and reports its configuration.
  std::int64_t add(Candidate candidate, std::int64_t in_iteration);

  // Beginning and end of a race.
  void start_race(irace::RaceSettings settings, const std::vector<std::int64_t>& contestants);
  /// The settings from the scenario that all races have in common.
  irace::RaceSettings common_settings(std::int64_t budget) const;
  irace::RaceSettings settings_of(const irace::RacePlan& plan);
  /// Sets the pairs of the next race's tasks; extends the list of pairs as far as the budget needs.
  void order_pairs(irace::RaceSettings& settings);
  void shuffle_past(std::span<std::int64_t> past) const;
  /// The configuration with its known results on these pairs.
  irace::Contestant contestant(std::int64_t id, std::span<const std::int64_t> pairs) const;
  /// Translates the runs that the race wants into experiments.
  void ask();
  /// Gives the race the answers to all runs that it wants.
  void answer_race();
  /// Whether single runs have to be recorded: their times, or whether they were known.
  bool keeps_track() const;
  /// Adds iteration, budget and generators to the race's steps, and counts the times of their runs.
  void report_steps();
  void count_runs(RaceStep& step);
  /// Stores results and rejections, and chooses the elites.
  void end_race();
  void take_over_results();
  void reject(std::int64_t id);
  void choose_elites();
  /// Packs the configurations of the race that are not elites: they are seldom looked at again.
  void put_away_losers();
  /// Reports how many experiments fit in the remaining time.
  void report_time(std::vector<std::pair<std::int64_t, std::int64_t>> evaluated);

  // The first estimate.
  Expected<void> begin_estimate();
  /// Asks for `count` configurations that were not tried yet; false if there are none.
  Expected<bool> ask_estimate(std::int64_t count);
  void tell_estimate(std::span<const Measurement> measurements);
  Expected<void> check_bounds(std::span<const Measurement> measurements) const;
  /// Called with the results of the batch: stores them, and decides how to continue.
  Expected<void> end_batch(std::span<const Measurement> costs);
  Expected<void> end_estimate();
  void lower_bound_max(double bound);
  /// These configurations, which were tried, with their overall ranks, in the order of `ids`.
  std::vector<Elite> ranked(std::span<const std::int64_t> ids) const;

  // Post-selection.
  /// Begins the post-selection race; returns false if it is not possible or not worthwhile.
  bool begin_postselection();
  std::vector<std::int64_t> preferred() const;
  /// Chooses the elites after a post-selection race that rejected all its configurations: those of
  /// the last iteration that has any left, otherwise the best of all others that were tried.
  void fall_back();

  Candidate& candidate(std::int64_t id) { return candidates[index_of(id)]; }
  const Candidate& candidate(std::int64_t id) const { return candidates[index_of(id)]; }
  std::size_t index_of(std::int64_t id) const {
    SWARMSMITH_ASSERT(id >= 1 && id <= static_cast<std::int64_t>(candidates.size()),
                      "ids count existing configurations, from 1");
    return static_cast<std::size_t>(id - 1);
  }

  Repair repair_;
  irace::Schedule schedule_;
  irace::SamplingModels models_;
  irace::ForbiddenList forbidden_;
  std::int64_t total_budget_;  ///< 0 with max_time
  Rng root_;
  irace::InstanceLog instances_;
  irace::InitialSampler initial_;
  double bound_max_;
  std::optional<Estimate> estimate_;
  std::optional<std::string> end_reason_;  ///< set in the post-selection race
  std::int64_t initial_count_ = 0;
  std::int64_t used_before_race_ = 0;
  /// The last race ran nothing, since its first task needed more than the remaining budget.
  bool nothing_was_run_ = false;
  /// Rows 1 .. pairs_seen_ of the list have been used by some candidate.
  std::int64_t pairs_seen_ = 0;
  std::int64_t races_ = 0;
  /// Tasks of the design so far, including those of the estimate.
  std::int64_t steps_ = 0;
  std::uint64_t sampling_drawn_ = 0;       ///< random numbers used by sampling in this iteration
  std::vector<std::vector<Elite>> ended_;  ///< elites of all iterations

  // The batch that was asked for.
  std::vector<irace::RaceRun> runs_;  ///< runs that the race wants, known ones included
  std::vector<Measurement> answers_;  ///< to `runs_`
  std::vector<std::size_t> asked_;    ///< positions in `runs_`, one for each of `wanted`
  std::map<std::pair<std::int64_t, std::int64_t>, ToldRun> told_;  ///< by (pair, configuration)
  std::int64_t repeated_ = 0;  ///< runs of this race whose results were known, which cost nothing
};

}  // namespace swarmsmith
