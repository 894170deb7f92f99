#pragma once

#include <optional>
#include <span>
#include <vector>

namespace swarmsmith {

/// Holm's adjusted p-values, in the given order: if all values below a level are called
/// significant, the probability of even one wrong result is at most that level. Tests without a p
/// are not counted.
/// Source: Holm 1979, Scandinavian Journal of Statistics 6(2); R's `p.adjust`.
std::vector<std::optional<double>> holm_adjusted(std::span<const std::optional<double>> p_values);

}  // namespace swarmsmith
