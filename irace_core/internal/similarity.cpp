#include "irace_core/internal/similarity.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/assert.h"
#include "base/hash.h"
#include "base/math.h"
#include "irace_core/internal/sampling.h"

namespace swarmsmith::irace {
namespace {

/// A configuration prepared for comparison: one number for everything that must be equal, and
/// positions of numeric values in their domains.
struct Prepared {
  /// Digest of all categorical and ordinal values and of the set of active parameters.
  std::uint64_t choices;
  /// Positions of the active numeric parameters, as fractions of the width of their domains.
  std::vector<double> positions;
};

Prepared prepare(const ParameterSpace& space, const Configuration& configuration) {
  Prepared prepared;
  Digest choices;
  std::optional<Assignment> values;  // only needed for dependent domains
  for (std::size_t i = 0; i < space.size(); ++i) {
    if (space.is_fixed(i)) continue;
    choices.add(std::int32_t{configuration.is_active(i)});
    if (!configuration.is_active(i)) continue;
    if (!space.is_numeric(i)) {
      choices.add(configuration[i]);
      continue;
    }
    const Interval* constant = space.constant_interval(i);
    if (constant == nullptr && !values) values.emplace(space, configuration);
    SWARMSMITH_ASSERT(constant != nullptr || values,
                      "a dependent domain needs the values that it depends on");
    const Interval domain = constant != nullptr ? *constant : **space.interval(i, *values);
    // Logarithmic parameters are sampled, and so compared, on a logarithmic scale (irace facts,
    // 25.8).
    const bool in_logarithm = is_logarithmic(space[i].domain);
    const auto scaled = [&](double value) { return in_logarithm ? log(value) : value; };
    const double lower = scaled(domain.lower);
    const double width = scaled(domain.upper) - lower;
    prepared.positions.push_back(width > 0 ? (scaled(configuration[i]) - lower) / width : 0);
  }
  prepared.choices = choices.value64();
  return prepared;
}

/// The tolerance keeps rounding of the positions from deciding at the threshold.
bool near(const Prepared& a, const Prepared& b, double threshold) {
  constexpr double kRounding = 1e-15;
  SWARMSMITH_ASSERT(a.positions.size() == b.positions.size(),
                    "configurations with the same choices have the same active numbers");
  for (std::size_t i = 0; i < a.positions.size(); ++i) {
    if (std::fabs(a.positions[i] - b.positions[i]) > threshold + kRounding) return false;
  }
  return true;
}

}  // namespace

std::vector<std::size_t> similar_configurations(
    const ParameterSpace& space, const std::vector<const Configuration*>& configurations,
    double threshold) {
  std::vector<Prepared> prepared;
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t i = 0; i < configurations.size(); ++i) {
    prepared.push_back(prepare(space, *configurations[i]));
    order.emplace_back(prepared.back().choices, i);
  }
  std::sort(order.begin(), order.end());
  std::vector<bool> similar(configurations.size(), false);
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size() && order[j].first == order[i].first; ++j) {
      const auto [a, b] = std::pair(order[i].second, order[j].second);
      if ((similar[a] && similar[b]) || !near(prepared[a], prepared[b], threshold)) continue;
      similar[a] = true;
      similar[b] = true;
    }
  }
  std::vector<std::size_t> positions;
  for (std::size_t i = 0; i < similar.size(); ++i) {
    if (similar[i]) positions.push_back(i);
  }
  return positions;
}

}  // namespace swarmsmith::irace
