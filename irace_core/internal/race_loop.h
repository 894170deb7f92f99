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

/// A configuration of the design with all that is known about it.
struct Candidate {
  /// What it did on one pair.
  struct Result {
    std::int64_t pair;
    double cost;
    double time;
  };

  irace::KeptConfiguration configuration;
  std::int64_t parent = 0;
  bool takes_part = true;       ///< false for forbidden initial ones, and for rejected ones
  std::vector<Result> results;  ///< in the order in which they came

  const Result* on(std::int64_t pair) const;
  /// A further result, or a better known one of a pair.
  void know(const Result& result);
  Elite as_elite(std::int64_t id, double rank) const;
};

/// Everything behind an IteratedRace: the loop over races (irace facts, 2). Its parts are in
/// race_loop.cpp (the loop), race_loop_sampling.cpp (who takes part), race_loop_races.cpp (a race's
/// beginning and end), race_loop_estimate.cpp (the first estimate of max_time) and
/// race_loop_postselection.cpp.
class IteratedRace::State {
 public:
  State(ParameterSpace space, Scenario scenario, std::vector<Configuration> initial, Repair repair);
  // The models and the forbidden list point to the space.
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  /// Makes the first race, or the first estimate. Trouble is the caller's, not an event.
  Expected<void> begin();
  /// Answers to all wanted experiments.
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
    std::vector<std::int64_t> tried;  ///< all configurations of former batches
    std::vector<std::int64_t> batch;
    std::vector<Measurement> runs;  ///< of the batch, while the targetEvaluator is asked for costs
    std::int64_t pairs;
  };
  /// A run that the race was told of and that no step has reported yet; most become steps, those of
  /// rejected ones are void.
  struct ToldRun {
    double time;
    bool was_known;
  };
  /// A run that the race wants and that was made before: a deterministic target of a run without
  /// elitism would only repeat itself.
  bool is_known(const irace::RaceRun& run) const;
  Experiment experiment_of(const irace::RaceRun& run) const;

  // The loop.
  void take_initial(std::vector<Configuration> initial);
  /// Whether all is well so far; a target that does not measure its time ends the design.
  Expected<std::vector<Measurement>> raised_times(std::span<const Measurement> measurements) const;
  /// Plans, samples and sets up the next race, or the post-selection, or finishes.
  Expected<void> begin_race();
  /// Asks for what the race wants next; goes on to further races as long as nothing must be asked.
  void advance();
  void warn(std::string text);
  void stop(std::string reason);
  void fail(Error error);
  /// Why no extension can follow.
  Expected<void> may_be_extended() const;

  // Who takes part.
  /// Elites of the estimate, given configurations, then sampled ones.
  Expected<std::vector<std::int64_t>> first_contestants(const irace::RacePlan& plan);
  /// Elites by rank, then new ones from their models; sampled again after a soft restart.
  Expected<std::vector<std::int64_t>> later_contestants(const irace::RacePlan& plan,
                                                        IterationStarted& started);
  /// Up to `count` new ones from the initial distribution.
  Expected<std::vector<std::int64_t>> sample_initial(std::int64_t count, std::int64_t in_iteration);
  /// Forbidden ones are replaced, up to 100 rounds.
  Expected<std::vector<Candidate>> sample_new(std::int64_t count, Rng& rng);
  /// Elites whose models made configurations that are too alike; each once, ascending.
  std::vector<std::int64_t> lines_to_restart(const std::vector<Candidate>& sampled) const;
  std::vector<irace::EliteLine> elite_lines() const;
  /// Gives the next id and reports the configuration.
  std::int64_t add(Candidate candidate, std::int64_t in_iteration);

  // A race's beginning and end.
  void start_race(irace::RaceSettings settings, const std::vector<std::int64_t>& contestants);
  /// What the scenario says about every race.
  irace::RaceSettings common_settings(std::int64_t budget) const;
  irace::RaceSettings settings_of(const irace::RacePlan& plan);
  /// The pairs of the next race's tasks, from a list that is made long enough for its budget.
  void order_pairs(irace::RaceSettings& settings);
  void shuffle_past(std::span<std::int64_t> past) const;
  /// What a configuration brings along on these pairs.
  irace::Contestant contestant(std::int64_t id, std::span<const std::int64_t> pairs) const;
  /// Translates what the race wants into experiments.
  void ask();
  /// Tells the race the answers to all that it wants.
  void answer_race();
  /// Whether single runs matter: their times, or that they were known.
  bool keeps_track() const;
  /// Completes the race's steps by iteration, budget and generators, and counts their times.
  void report_steps();
  void count_runs(RaceStep& step);
  /// Takes over results and rejections, and chooses the elites.
  void end_race();
  void take_over_results();
  void reject(std::int64_t id);
  void choose_elites();
  /// Those who took part and are not elites: they are seldom looked at again.
  void put_away_losers();
  /// Reports how much the time that is left is good for.
  void report_time(std::vector<std::pair<std::int64_t, std::int64_t>> evaluated);

  // The first estimate.
  Expected<void> begin_estimate();
  /// Asks for so many configurations that were not tried yet; false when there are none.
  Expected<bool> ask_estimate(std::int64_t count);
  void tell_estimate(std::span<const Measurement> measurements);
  Expected<void> check_bounds(std::span<const Measurement> measurements) const;
  /// The results of the batch are there: takes them, and decides what follows.
  Expected<void> end_batch(std::span<const Measurement> costs);
  Expected<void> end_estimate();
  void lower_bound_max(double bound);
  /// Configurations that were tried with their overall ranks, in the order of `ids`.
  std::vector<Elite> ranked(std::span<const std::int64_t> ids) const;

  // Post-selection.
  /// False when there is nothing to do.
  bool begin_postselection();
  std::vector<std::int64_t> preferred() const;
  /// The elites after a post-selection race that rejected all who took part: those of the last
  /// iteration that has any left, or else the best of all others that were tried.
  void fall_back();

  Candidate& candidate(std::int64_t id) { return candidates[index_of(id)]; }
  const Candidate& candidate(std::int64_t id) const { return candidates[index_of(id)]; }
  std::size_t index_of(std::int64_t id) const {
    SWARMSMITH_ASSERT(id >= 1 && id <= static_cast<std::int64_t>(candidates.size()),
                      "ids are those of configurations that were made, from 1");
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
  bool nothing_was_run_ = false;  ///< in the last race: its first task needed more than was left
  std::int64_t pairs_seen_ = 0;   ///< rows 1 .. pairs_seen_ of the list were tried by a candidate
  std::int64_t races_ = 0;
  std::int64_t steps_ = 0;                 ///< tasks of the design so far, of the estimate too
  std::uint64_t sampling_drawn_ = 0;       ///< numbers that sampling has used in this iteration
  std::vector<std::vector<Elite>> ended_;  ///< elites of all iterations

  // Of the batch that was asked for.
  std::vector<irace::RaceRun> runs_;  ///< what the race wants, known ones included
  std::vector<Measurement> answers_;  ///< to `runs_`
  std::vector<std::size_t> asked_;    ///< positions in `runs_`, one for each of `wanted`
  std::map<std::pair<std::int64_t, std::int64_t>, ToldRun> told_;  ///< by (pair, configuration)
  std::int64_t repeated_ = 0;  ///< runs of this race that were known and cost nothing
};

}  // namespace swarmsmith
