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
/// (irace facts, 6.6); `domain` is not looked at for choices.
double quantile_value(const ParameterSpace& space, std::size_t parameter, const Interval& domain,
                      double p);

/// Brings a draw from a numeric parameter's continuous domain (integers: up to upper + 1) into the
/// domain: floor or rounding to the digits of the space.
double to_domain(const ParameterSpace& space, std::size_t parameter, const Interval& domain,
                 double drawn);

/// Whether a numeric parameter is sampled in its logarithm.
bool is_logarithmic(const Domain& domain);
bool is_whole(const Domain& domain);

/// Fills a configuration parameter by parameter in hierarchy order: inactive ones stay so, fixed
/// ones get their value, `draw(parameter, domain)` gives all others. Fails when a dependent domain
/// is empty.
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

/// Decides which configurations must not be tried: those of the space's forbidden clauses, and
/// those that contain all values of one that was rejected.
class ForbiddenList {
 public:
  explicit ForbiddenList(const ParameterSpace& space) : space_(&space) {}

  void add_rejected(const Configuration& configuration) { rejected_.push_back(configuration); }
  bool contains(const Configuration& configuration) const;

 private:
  const ParameterSpace* space_;
  std::vector<Configuration> rejected_;
};

/// What the repair makes of a configuration that was sampled, or the configuration itself without a
/// repair (irace facts, 8.5). One that is not in the space then is an error that shows it.
Expected<Configuration> repaired(const ParameterSpace& space, const Repair& repair,
                                 Configuration sampled);

/// Gives the first configurations of a design: points of a Sobol sequence, one dimension for each
/// parameter that is not fixed, in declaration order; independent uniform ones where there are more
/// parameters than the sequence has dimensions (irace facts, 5). Nothing comes twice.
class InitialSampler {
 public:
  /// `space` must outlive the sampler. One number is drawn from `rng` at once: the sequence's seed.
  InitialSampler(const ParameterSpace& space, Rng rng);

  bool uses_sobol() const { return sequence_.has_value(); }
  /// The next `wanted` points, repaired, without forbidden ones and those that came before. When
  /// some are lost the sequence is followed further, as far as irace's second and larger batch
  /// would reach; fewer than wanted may result, even none. Fails with a bad repair, and when a
  /// dependent domain is empty.
  Expected<std::vector<Configuration>> sample(std::int64_t wanted, const ForbiddenList& forbidden,
                                              const Repair& repair);
  /// How many points were looked at.
  std::uint32_t position() const { return position_; }

 private:
  Expected<Configuration> next_point();

  const ParameterSpace* space_;
  Rng rng_;
  std::optional<SobolSequence> sequence_;
  std::vector<std::size_t> dimension_;  ///< by parameter
  std::vector<double> point_;
  std::uint32_t position_ = 0;
  std::set<std::uint64_t> seen_;  ///< digests; with 64 bits, equal ones are equal configurations
};

}  // namespace swarmsmith::irace
