#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "irace_core/parameter_space.h"

namespace swarmsmith::search {

/// A space of unconditional reals, in units in which the range of each parameter is -5 to 5: the
/// weights of networks keep their values, and every other range is scaled to this.
class RealBox {
 public:
  static constexpr double kHalfWidth = 5;

  /// Errors: forbidden clauses, or a parameter that is not real, has a condition, is logarithmic,
  /// or has bounds that depend on others; the message names `search`.
  static Expected<RealBox> of(const ParameterSpace& space, std::string_view search);

  std::size_t dimensions() const { return middles_.size(); }
  /// The configuration that is run for a point: moved inside the box and rounded to the space's
  /// digits.
  Configuration to_configuration(std::span<const double> point) const;
  /// The point of a configuration, with which the search continues after rounding.
  std::vector<double> to_point(const Configuration& configuration) const;

 private:
  RealBox() = default;

  std::vector<double> middles_;
  std::vector<double> units_;  ///< a tenth of the range
  std::vector<double> lower_;
  std::vector<double> upper_;
  int digits_ = 0;
};

}  // namespace swarmsmith::search
