#pragma once

#include <optional>
#include <vector>

#include "base/expected.h"
#include "base/rng.h"
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

/// Every parameter uniform in its domain.
Expected<Configuration> sample_uniform(const ParameterSpace& space, Rng& rng);

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

/// The first configurations of a design: `wanted` uniform ones, less duplicates and forbidden ones.
/// When some are lost a second and larger batch replaces the first (irace facts, 5). Fewer than
/// wanted may result; none at all is an error.
Expected<std::vector<Configuration>> sample_initial(const ParameterSpace& space,
                                                    const ForbiddenList& forbidden,
                                                    std::int64_t wanted, Rng& rng);

}  // namespace swarmsmith::irace
