#include "irace_core/search/real_box.h"

#include <algorithm>
#include <string>

#include "base/assert.h"
#include "irace_core/internal/rounding.h"

namespace swarmsmith::search {
namespace {

/// The reason why the parameter is not a plain real; empty when it is one.
std::string objection(const ParameterSpace& space, std::size_t index) {
  const auto* real = std::get_if<Real>(&space[index].domain);
  if (real == nullptr) return "is not a real number";
  if (space[index].condition) return "has a condition";
  if (real->log) return "is logarithmic";
  if (space.constant_interval(index) == nullptr) return "has a range that depends on others";
  return {};
}

}  // namespace

Expected<RealBox> RealBox::of(const ParameterSpace& space, std::string_view search) {
  if (!space.forbidden().empty()) {
    return bad_input("the search " + std::string(search) +
                         " makes weights one by one, and would not keep to forbidden combinations",
                     "forbidden");
  }
  RealBox box;
  box.digits_ = space.digits();
  for (std::size_t i = 0; i < space.size(); ++i) {
    if (const std::string trouble = objection(space, i); !trouble.empty()) {
      return bad_input("the search " + std::string(search) +
                           " needs reals without conditions, such as the weights of networks, and "
                           "this parameter " +
                           trouble,
                       space[i].name);
    }
    const Interval& range = *space.constant_interval(i);
    box.lower_.push_back(range.lower);
    box.upper_.push_back(range.upper);
    box.middles_.push_back((range.lower + range.upper) / 2);
    box.units_.push_back((range.upper - range.lower) / (2 * kHalfWidth));
  }
  return box;
}

Configuration RealBox::to_configuration(std::span<const double> point) const {
  SWARMSMITH_ASSERT(point.size() == dimensions(), "a point has the box's dimensions");
  Configuration configuration(middles_.size());
  for (std::size_t i = 0; i < middles_.size(); ++i) {
    const double value = irace::round_to_digits(middles_[i] + point[i] * units_[i], digits_);
    configuration.set(i, std::clamp(value, lower_[i], upper_[i]));
  }
  return configuration;
}

std::vector<double> RealBox::to_point(const Configuration& configuration) const {
  SWARMSMITH_ASSERT(configuration.size() == dimensions(), "a dimension for each parameter");
  std::vector<double> point;
  point.reserve(middles_.size());
  for (std::size_t i = 0; i < middles_.size(); ++i)
    point.push_back(units_[i] > 0 ? (configuration[i] - middles_[i]) / units_[i] : 0);
  return point;
}

}  // namespace swarmsmith::search
