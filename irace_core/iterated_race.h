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

/// Repairs a sampled configuration, so that it becomes a sensible one (irace's
/// repairConfiguration); a pure function.
using Repair = std::function<Expected<Configuration>(const Configuration&)>;

/// The version of the race's behaviour. It changes whenever a race gives another result for the
/// same space, scenario and costs. Stores record it: a store with another version can be read, but
/// not continued or replayed. Version 2: Sobol points at the beginning, a post-selection race at
/// the end, blocks.
inline constexpr int kRaceVersion = 2;

/// The budget of a design: max_experiments, or, if min_experiments is set, the larger of it and the
/// smallest budget that works; 0 with max_time, where the number of experiments is known only once
/// some have run.
std::int64_t total_budget(const ParameterSpace& space, const Scenario& scenario);

/// Elitist iterated racing (Lopez-Ibanez et al., "The irace package", Operations Research
/// Perspectives 3, 2016), as ask and tell: a pure function of space, scenario, initial
/// configurations and costs. It has no clock, no threads, no input or output.
///
/// The rules are those of irace 4.4 with these differences, in which our behaviour is the one that
/// irace's users would expect:
/// - Ordinal parameters are sampled so that every value can occur (irace 4 never samples the last
///   one).
/// - A dependent domain is evaluated only if its parameter is active.
/// - Sobol points work for up to 1111 parameters (irace fails above 1024); with more parameters the
///   first configurations are uniform draws. Further points continue the sequence, and never repeat
///   a point.
/// - Past pairs are shuffled by blocks (irace: one by one).
/// - Without elitism, a configuration is not run again on a pair that it was run on before if the
///   target is deterministic.
/// - A design never exceeds its budget: a race ends before a task that would (irace exceeds it for
///   pairs that elites have not been run on, and because of nb_experiments_per_iteration).
/// - A Friedman test on a single pair drops no configuration: it has no degree of freedom.
/// - Post-selection never ends a design without its elites.
/// - The limit of 1024 configurations per race is an option.
/// - Runs of a rejected configuration on later tasks of a batch are ignored, so that the result
///   does not depend on the number of runs that were asked for at once.
///
/// All randomness comes from streams that are derived, each by its name, from the scenario's seed:
/// "instances" (order and seeds of the pairs, row by row), "initial" (the seed of the Sobol
/// sequence), "sampling" by iteration (parents and values, one configuration after the other,
/// parameters in hierarchy order), "order" by iteration (past pairs).
class IteratedRace : public Search {
 public:
  /// `initial` configurations take part in the first race, before sampled ones; they get the ids
  /// from 1 in their order, and forbidden ones do not take part. If the budget is too small, the
  /// error names the smallest budget that works.
  static Expected<IteratedRace> start(ParameterSpace space, Scenario scenario,
                                      std::vector<Configuration> initial = {}, Repair repair = {});

  IteratedRace(IteratedRace&&) noexcept;
  IteratedRace& operator=(IteratedRace&&) noexcept;
  ~IteratedRace() override;

  bool finished() const override;
  /// The reason why there is no result: every configuration was rejected, a dependent domain was
  /// empty, only forbidden configurations could be sampled, a repair returned a configuration
  /// outside the space, a time is missing, or the time is too short for one race. Only once
  /// finished.
  const std::optional<Error>& failure() const override;

  /// Everything that the race certainly needs before its next test, in canonical order (task, then
  /// configuration); empty once finished. Valid until the next tell().
  std::span<const Experiment> wanted() const override;
  /// The experiments that the race would want after wanted(), in canonical order, on up to `pairs`
  /// further pairs, if its tests dropped no candidate; for slots that would otherwise be idle. A
  /// call does not change the random generators, and the race's result does not depend on it. Empty
  /// if results decide more than which candidates are alive (capping, a targetEvaluator, max_time),
  /// and with one_task_at_a_time.
  std::vector<Experiment> ahead(std::int64_t pairs) const override;
  /// Takes the costs of all wanted() in the same order; smaller is better. An infinite cost rejects
  /// the configuration; its wanted experiments on later tasks are then neither counted nor used.
  /// Throws std::invalid_argument for NaN or a wrong number of costs.
  void tell(std::span<const Measurement> measurements) override;
  /// The same for a target that does not measure its time.
  void tell(std::span<const double> costs);
  /// Ids of all configurations that are alive in the current race, ascending; a targetEvaluator
  /// gets these.
  std::vector<std::int64_t> alive() const override;
  /// The events since the last call, in order.
  std::vector<RaceEvent> take_events() override;

  /// Adds budget to a design that has finished: it continues with further iterations (irace facts,
  /// 3.2), then a post-selection race with the budget that they leave. By default the whole
  /// remaining budget becomes one iteration, as in irace at the end of a run; a limit that was set
  /// (nb_iterations) rises by one, or, with nb_experiments_per_iteration, by the number of
  /// iterations that the budget allows. The earlier races stay unchanged, so the result differs
  /// from a design that had the larger budget from the start. If the budget is too small for an
  /// iteration, only the post-selection is run. Call it only when finished(); fails after a
  /// failure, and with max_time.
  Expected<void> extend(std::int64_t experiments) override;
  /// The smallest extension that gives a further iteration; fails if extend() does, and if no
  /// extension would give one. Only when finished().
  Expected<std::int64_t> least_extension() const override;

  /// The configuration with this id; throws std::out_of_range for an id that was never given. Valid
  /// until the next tell().
  const Configuration& configuration(std::int64_t id) const override;
  const ParameterSpace& space() const override;
  const Scenario& scenario() const;

  /// Elites of the last iteration that has ended, best first.
  std::span<const Elite> elites() const override;
  /// So far, including the current race.
  std::int64_t experiments_used() const override;
  /// The budget of the whole design; with max_time the experiments so far plus the latest estimate
  /// of how many fit in the remaining time.
  std::int64_t budget() const override;
  double time_used() const;  ///< with max_time: the time of all experiments that count
  std::int64_t remaining() const { return budget() - experiments_used(); }
  std::int64_t iteration() const override;     ///< of the current race
  std::int64_t n_iterations() const override;  ///< as planned now
  std::int64_t n_alive() const override;       ///< in the current race
  std::int64_t n_configurations() const;       ///< number of ids given so far

 private:
  class State;

  explicit IteratedRace(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace swarmsmith
