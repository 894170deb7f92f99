#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/expected.h"
#include "irace_core/experiment.h"
#include "irace_core/parameter_space.h"
#include "irace_core/race_event.h"

namespace swarmsmith {

/// A method that searches for the best configuration of a design, as ask and tell: iterated racing,
/// evolution, random search, ...
///
/// Every search is a pure function of its space, options and seed and the costs that it is given.
/// It has no clock, no thread, no input and no output, so that a stored design can be replayed: the
/// same costs lead to the same questions, events and digests, with any number of workers. It counts
/// each run that it asks for, and never asks for more than its budget.
class Search {
 public:
  virtual ~Search() = default;

  virtual bool finished() const = 0;
  /// The reason why there is no result. Only once finished.
  virtual const std::optional<Error>& failure() const = 0;

  /// All experiments that the search certainly needs before its next decision, in canonical order
  /// (pair, then configuration); empty once finished. Valid until the next tell().
  virtual std::span<const Experiment> wanted() const = 0;
  /// Experiments that it would probably want after wanted(), in canonical order, on up to `pairs`
  /// further pairs; for slots that would otherwise be idle. A call does not change the random
  /// generators, and no result depends on it.
  virtual std::vector<Experiment> ahead(std::int64_t pairs) const = 0;
  /// Takes the costs of all wanted() in the same order; smaller is better, an infinite cost is a
  /// rejection.
  /// Throws std::invalid_argument for NaN or a wrong number of costs.
  virtual void tell(std::span<const Measurement> measurements) = 0;
  /// Ids of all configurations whose results may still matter, ascending.
  virtual std::vector<std::int64_t> alive() const = 0;
  /// The events since the last call, in order.
  virtual std::vector<RaceEvent> take_events() = 0;

  /// Adds budget to a search that has finished. The error says why this is not possible.
  virtual Expected<void> extend(std::int64_t experiments) = 0;
  /// The smallest extension that has an effect. Only when finished().
  virtual Expected<std::int64_t> least_extension() const = 0;

  /// The configuration with this id; throws std::out_of_range for an id that was never given. Valid
  /// until the next tell().
  virtual const Configuration& configuration(std::int64_t id) const = 0;
  virtual const ParameterSpace& space() const = 0;

  /// Elites of the last iteration that has ended, best first; the first one is the result.
  virtual std::span<const Elite> elites() const = 0;
  virtual std::int64_t experiments_used() const = 0;
  virtual std::int64_t budget() const = 0;
  /// unit depends on the search: race, generation, ...
  virtual std::int64_t iteration() const = 0;
  virtual std::int64_t n_iterations() const = 0;  ///< as planned now
  virtual std::int64_t n_alive() const = 0;
};

}  // namespace swarmsmith
