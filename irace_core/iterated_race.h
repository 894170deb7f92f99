#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/expected.h"
#include "irace_core/experiment.h"
#include "irace_core/parameter_space.h"
#include "irace_core/race_event.h"
#include "irace_core/scenario.h"
#include "irace_core/search.h"

namespace swarmsmith {

/// Changes a configuration that was sampled into one that makes sense (irace's
/// repairConfiguration); a pure function.
using Repair = std::function<Expected<Configuration>(const Configuration&)>;

/// Changes with what a race answers to the same space, scenario and costs. Stores keep it: one of
/// another version can be read, but not continued or replayed. 2: Sobol points at the beginning, a
/// post-selection race at the end, blocks.
inline constexpr int kRaceVersion = 2;

/// The budget of a design: max_experiments, or what min_experiments makes of it; 0 with max_time,
/// which only running turns into experiments.
std::int64_t total_budget(const ParameterSpace& space, const Scenario& scenario);

/// Elitist iterated racing (Lopez-Ibanez et al., "The irace package", Operations Research
/// Perspectives 3, 2016), as ask and tell: a pure function of space, scenario, initial
/// configurations and costs. No clock, no threads, no input or output.
///
/// The rules are those of irace 4.4 with these differences, where irace's users would expect ours:
/// - Ordinal values are drawn so that all can be drawn (irace 4 never draws the last one).
/// - A dependent domain is evaluated only where its parameter is active.
/// - Sobol points reach to 1111 parameters (irace fails above 1024); the first configurations of
///   more parameters are uniform draws. Further points continue the sequence, and never repeat one.
/// - Past pairs are shuffled by blocks (irace: one by one).
/// - Without elitism a deterministic target is not run again on a pair that it has seen.
/// - A design never runs more than its budget: a race ends before a task that would (irace goes
/// over
///   it for pairs that elites miss, and by nb_experiments_per_iteration).
/// - A Friedman test of a single pair drops none: it has no degree of freedom.
/// - Post-selection never ends a design without its elites.
/// - The cap of 1024 configurations a race is an option.
/// - Runs of a rejected configuration on later tasks of a batch are void, so that the answer does
///   not depend on how much was run at once.
///
/// All randomness comes from streams split by name from the scenario's seed: "instances" (order
/// and seeds of the pairs, in rows), "initial" (the seed of the Sobol sequence), "sampling" by
/// iteration (parents and values, one configuration after the other, parameters in hierarchy
/// order), "order" by iteration (past pairs).
class IteratedRace : public Search {
 public:
  /// `initial` configurations take part in the first race, before sampled ones; they get the ids
  /// from 1 in their order, and forbidden ones take no part. A budget that is too small is an error
  /// that says the smallest one that works.
  static Expected<IteratedRace> start(ParameterSpace space, Scenario scenario,
                                      std::vector<Configuration> initial = {}, Repair repair = {});

  IteratedRace(IteratedRace&&) noexcept;
  IteratedRace& operator=(IteratedRace&&) noexcept;
  ~IteratedRace() override;

  bool finished() const override;
  /// Why there is no result: every configuration was rejected, a dependent domain was empty,
  /// nothing that is not forbidden could be sampled, a repair made something that is not in the
  /// space, a time is missing, or the time is too short for one race. Only once finished.
  const std::optional<Error>& failure() const override;

  /// Everything that the race certainly needs before its next test, in canonical order (task, then
  /// configuration); empty once finished. Valid until the next tell().
  std::span<const Experiment> wanted() const override;
  /// What the race would want after that, in canonical order, on up to `pairs` further pairs, if
  /// its tests dropped no candidate: for slots that would idle. It moves no generator; what the
  /// race answers does not depend on it. Empty where results decide more than who is alive:
  /// capping, a targetEvaluator, max_time; and with one_task_at_a_time.
  std::vector<Experiment> ahead(std::int64_t pairs) const override;
  /// Costs of all wanted() in the same order, smaller is better. An infinite cost rejects the
  /// configuration; what was wanted of it on later tasks is then neither counted nor used. Throws
  /// std::invalid_argument for NaN or a wrong number of costs.
  void tell(std::span<const Measurement> measurements) override;
  /// The same of a target that does not measure its time.
  void tell(std::span<const double> costs);
  /// Ids of all that are alive in the current race, ascending: what a targetEvaluator gets.
  std::vector<std::int64_t> alive() const override;
  /// What happened since the last call, in order.
  std::vector<RaceEvent> take_events() override;

  /// More budget for a design that is over: further iterations follow from its end (irace facts,
  /// 3.2), then a post-selection with what they leave. By default all that is left becomes one
  /// iteration, as in irace at the end of a run; a limit that was set (nb_iterations) rises by one,
  /// or, with nb_experiments_per_iteration, by as many as the budget is good for. The races before
  /// are as they were: this is not the design that had the larger budget from the start. When it is
  /// too little for an iteration, only the post-selection is left. Call it only when finished();
  /// fails after a failure, and with max_time.
  Expected<void> extend(std::int64_t experiments) override;
  /// The smallest extension that gives an iteration now; fails where extend() does, and when no
  /// extension would. Only when finished().
  Expected<std::int64_t> least_extension() const override;

  /// A configuration by its id; throws std::out_of_range for an id that never was. Valid until the
  /// next tell().
  const Configuration& configuration(std::int64_t id) const override;
  const ParameterSpace& space() const override;
  const Scenario& scenario() const;

  /// Elites of the last iteration that ended, best first.
  std::span<const Elite> elites() const override;
  std::int64_t experiments_used()
      const override;  ///< counted so far, those of the current race included
  /// Of the whole design; with max_time what was used and what the rest of the time is good for, as
  /// estimated last.
  std::int64_t budget() const override;
  double time_used() const;  ///< with max_time: of all experiments that count
  std::int64_t remaining() const { return budget() - experiments_used(); }
  std::int64_t iteration() const override;     ///< of the current race
  std::int64_t n_iterations() const override;  ///< as planned now
  std::int64_t n_alive() const override;       ///< in the current race
  std::int64_t n_configurations() const;       ///< ids given so far

 private:
  class State;

  explicit IteratedRace(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace swarmsmith
