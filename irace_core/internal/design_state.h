#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/rng.h"
#include "irace_core/internal/instances.h"
#include "irace_core/internal/model.h"
#include "irace_core/internal/race.h"
#include "irace_core/internal/sampling.h"
#include "irace_core/internal/schedule.h"
#include "irace_core/iterated_race.h"

namespace swarmsmith {

/// A configuration of the design with all that is known about it.
struct Candidate {
  /// Its cost on one pair.
  struct Result {
    std::int64_t pair;
    double cost;
  };

  Configuration configuration;
  std::int64_t parent = 0;
  bool takes_part = true;       ///< false for forbidden initial ones
  std::vector<Result> results;  ///< in the order in which they came
};

/// Everything behind an IteratedRace: the loop over races (irace facts, 2).
class IteratedRace::State {
 public:
  State(ParameterSpace space, Scenario scenario, std::vector<Configuration> initial, Repair repair);
  // The models and the forbidden list point to the space.
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  /// Makes the first race. Trouble is the caller's, not an event.
  Expected<void> begin();
  void tell(std::span<const Measurement> measurements);

  bool finished = false;
  std::optional<Error> failure;
  std::vector<Experiment> wanted;
  std::vector<RaceEvent> events;

  ParameterSpace space;
  Scenario scenario;
  std::vector<Candidate> candidates;  ///< by id - 1
  std::vector<Elite> elites;
  std::int64_t budget = 0;
  std::int64_t used_before_race = 0;
  std::int64_t iteration = 0;
  std::int64_t iterations = 0;
  std::unique_ptr<irace::Race> race;

 private:
  /// Plans, samples and starts the next race, or finishes when there is none.
  Expected<void> begin_race();
  /// Given configurations, then uniform ones.
  Expected<std::vector<std::int64_t>> first_contestants(const irace::RacePlan& plan);
  /// Elites by rank, then new ones from their models; sampled again after a soft restart.
  Expected<std::vector<std::int64_t>> later_contestants(const irace::RacePlan& plan,
                                                        IterationStarted& started);
  /// Forbidden ones are replaced, up to 100 rounds.
  Expected<std::vector<Candidate>> sample_new(std::int64_t count, Rng& rng);
  /// Elites whose models made configurations that are too alike; each once, ascending.
  std::vector<std::int64_t> lines_to_restart(const std::vector<Candidate>& sampled) const;
  std::vector<irace::EliteLine> elite_lines() const;
  /// Gives the next id and reports the configuration.
  std::int64_t add(Candidate candidate, std::int64_t in_iteration);
  void start_race(const irace::RacePlan& plan, const std::vector<std::int64_t>& contestants);
  std::vector<std::int64_t> order_of_pairs(const irace::RacePlan& plan, std::int64_t past) const;
  /// What an elite cost on these pairs, NaN where it was not tried.
  std::vector<double> past_costs(std::int64_t id, std::span<const std::int64_t> pairs) const;
  /// Translates what the race wants into experiments.
  void ask();
  /// Completes the race's steps by iteration, budget and generators.
  void report_steps();
  /// Takes over results and rejections, and chooses the elites.
  void end_race();
  void choose_elites();
  void stop(std::string reason);
  void fail(Error error);

  Candidate& candidate(std::int64_t id) { return candidates[static_cast<std::size_t>(id - 1)]; }
  const Candidate& candidate(std::int64_t id) const {
    return candidates[static_cast<std::size_t>(id - 1)];
  }

  Repair repair_;
  irace::Schedule schedule_;
  irace::SamplingModels models_;
  irace::ForbiddenList forbidden_;
  Rng root_;
  irace::InstanceLog instances_;
  std::int64_t initial_count_ = 0;
  std::int64_t pairs_seen_ = 0;  ///< rows 1 .. pairs_seen_ of the list were tried by somebody
  std::int64_t races_ = 0;
  std::uint64_t sampling_drawn_ = 0;  ///< numbers that sampling has used in this iteration
};

}  // namespace swarmsmith
