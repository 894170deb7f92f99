#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "irace_core/parameter_space.h"

namespace swarmsmith::search {

/// A space of unconditional reals, in units in which each goes from -5 to 5: the weights of
/// networks as they are, and every other range at that scale.
class RealBox {
 public:
  static constexpr double kHalfWidth = 5;

  /// Errors: a parameter that is conditional, not real, logarithmic, or bounded by others; `search`
  /// is named in the sentence.
  static Expected<RealBox> of(const ParameterSpace& space, std::string_view search);

  std::size_t dimensions() const { return middles_.size(); }
  /// Inside the box and rounded to the space's digits: what is run.
  Configuration to_configuration(std::span<const double> point) const;
  /// The point of a configuration: the search goes on from what was run.
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
