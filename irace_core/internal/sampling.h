#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "base/expected.h"
#include "base/rng.h"
#include "irace_core/internal/sobol.h"
#include "irace_core/iterated_race.h"
#include "irace_core/parameter_space.h"

namespace swarmsmith::irace {

/// The value of a parameter at quantile `p` in [0, 1) of its uniform distribution over `domain`
/// (irace facts, 6.6); `domain` is ignored for categorical and ordinal parameters.
double quantile_value(const ParameterSpace& space, std::size_t parameter, const Interval& domain,
                      double p);

/// Converts a draw from a numeric parameter's continuous domain (integers: up to upper + 1) to a
/// value of the domain: floor, or rounding to the digits of the space.
double to_domain(const ParameterSpace& space, std::size_t parameter, const Interval& domain,
                 double drawn);

/// Whether a numeric parameter is sampled on a logarithmic scale.
bool is_logarithmic(const Domain& domain);
bool is_whole(const Domain& domain);

/// Fills in a configuration parameter by parameter in hierarchy order: inactive parameters stay
/// inactive, fixed ones get their value, and all others get the result of `draw(parameter,
/// domain)`. Fails when a dependent domain is empty.
template <class Draw>
Expected<Configuration> sample_configuration(const ParameterSpace& space, Draw draw) {
  Assignment values(space);
  for (const std::size_t parameter : space.hierarchy_order()) {
    if (!space.is_active(parameter, values)) continue;
    std::optional<Interval> domain = Interval{0, 0};
    if (space.is_numeric(parameter)) {
      auto found = space.interval(parameter, values);
      if (!found) return Unexpected(found.error());
      if (!*found) continue;
      domain = *found;
    }
    values.set(parameter, space.is_fixed(parameter) ? 0 : draw(parameter, *domain));
  }
  return values.configuration();
}

/// The configurations that must not be tried: those that a forbidden clause of the space matches,
/// and those that contain all values of a rejected configuration.
class ForbiddenList {
 public:
  explicit ForbiddenList(const ParameterSpace& space) : space_(&space) {}

  void add_rejected(const Configuration& configuration) { rejected_.push_back(configuration); }
  bool contains(const Configuration& configuration) const;

 private:
  const ParameterSpace* space_;
  std::vector<Configuration> rejected_;
};

/// The result of the repair for a sampled configuration; without a repair the configuration itself
/// (irace facts, 8.5). If the repaired configuration is not in the space, the error shows it.
Expected<Configuration> repaired(const ParameterSpace& space, const Repair& repair,
                                 Configuration sampled);

/// Gives the first configurations of a design: points of a Sobol sequence, with one dimension for
/// each parameter that is not fixed, in declaration order; independent uniform configurations if
/// there are more parameters than the sequence has dimensions (irace facts, 5). No configuration
/// occurs twice.
class InitialSampler {
 public:
  /// `space` must outlive the sampler. The constructor draws one number from `rng`: the sequence's
  /// seed.
  InitialSampler(const ParameterSpace& space, Rng rng);

  bool uses_sobol() const { return sequence_.has_value(); }
  /// The next `wanted` points, repaired, without forbidden and repeated ones. If some are dropped,
  /// the sequence is continued as far as irace's second and larger batch would reach; there may be
  /// fewer than wanted, even none. Fails if a repair returns a configuration outside the space, and
  /// if a dependent domain is empty.
  Expected<std::vector<Configuration>> sample(std::int64_t wanted, const ForbiddenList& forbidden,
                                              const Repair& repair);
  /// The number of points taken from the sequence.
  std::uint32_t position() const { return position_; }

 private:
  Expected<Configuration> next_point();

  const ParameterSpace* space_;
  Rng rng_;
  std::optional<SobolSequence> sequence_;
  std::vector<std::size_t> dimension_;  ///< by parameter
  std::vector<double> point_;
  std::uint32_t position_ = 0;
  /// digests; with 64 bits, equal digests are taken as equal configurations.
  std::set<std::uint64_t> seen_;
};

}  // namespace swarmsmith::irace
