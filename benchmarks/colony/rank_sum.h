#pragma once

#include <span>

namespace swarmsmith {

/// One-sided rank-sum test (Mann and Whitney 1947): the probability of a rank sum of `a` as large
/// as this one or larger, if `a` and `b` come from one distribution. Small means: `a` is larger.
/// Exact without ties, else by the normal approximation with its correction for ties and
/// continuity, as R computes wilcox.test(a, b, alternative = "greater") for up to 49 values each.
/// Neither is empty.
double p_of_larger(std::span<const double> a, std::span<const double> b);

}  // namespace swarmsmith
