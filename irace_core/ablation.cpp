#include "irace_core/ablation.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "irace_core/internal/ranking.h"

namespace swarmsmith {
namespace {

/// Nothing when the values do not fit together.
std::optional<AblationChange> change(const ParameterSpace& space, const Configuration& current,
                                     const Configuration& target, std::size_t parameter) {
  if (!current.is_active(parameter) || !target.is_active(parameter)) return std::nullopt;
  AblationChange made{Configuration(), {parameter}};
  Assignment values(space);
  for (const std::size_t i : space.hierarchy_order()) {
    const bool was_active = current.is_active(i);
    const bool is_active = space.is_active(i, values);
    const bool is_new = i == parameter || (is_active && !was_active);
    if (is_active) {
      const Configuration& from = is_new ? target : current;
      if (from.is_active(i)) values.set(i, from[i]);
    }
    if (i != parameter && is_active != was_active) made.changed.push_back(i);
  }
  made.configuration = values.configuration();
  if (!space.check(made.configuration) || space.is_forbidden(made.configuration)) {
    return std::nullopt;
  }
  return made;
}

}  // namespace

std::vector<std::size_t> differences(const Configuration& a, const Configuration& b) {
  std::vector<std::size_t> different;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool equal = a.is_active(i) == b.is_active(i) && (!a.is_active(i) || a[i] == b[i]);
    if (!equal) different.push_back(i);
  }
  return different;
}

std::vector<AblationChange> ablation_changes(const ParameterSpace& space,
                                             const Configuration& current,
                                             const Configuration& target,
                                             std::span<const std::size_t> open) {
  std::vector<AblationChange> changes;
  for (const std::size_t parameter : open) {
    if (current.is_active(parameter) && target.is_active(parameter) &&
        current[parameter] == target[parameter])
      continue;
    if (auto made = change(space, current, target, parameter)) changes.push_back(std::move(*made));
  }
  return changes;
}

std::size_t best_by_ranks(const std::vector<std::vector<double>>& costs, TestType type) {
  const std::vector<double> ranks = irace::overall_ranks(costs, type);
  return static_cast<std::size_t>(std::ranges::min_element(ranks) - ranks.begin());
}

}  // namespace swarmsmith
