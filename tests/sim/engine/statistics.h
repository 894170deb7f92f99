#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace swarmsmith {

/// Kolmogorov-Smirnov: sqrt(n) times the largest distance between the samples' distribution and
/// `cdf`, which is continuous.
inline double ks_statistic(std::vector<double> samples, const std::function<double(double)>& cdf) {
  std::sort(samples.begin(), samples.end());
  const auto n = static_cast<double>(samples.size());
  double worst = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double expected = cdf(samples[i]);
    worst = std::max(
        {worst, static_cast<double>(i + 1) / n - expected, expected - static_cast<double>(i) / n});
  }
  return worst * std::sqrt(n);
}
/// Samples of the distribution stay below it 999 times in 1000.
inline constexpr double kKsLimit = 1.95;

/// How many standard deviations of a binomial law `count` lies off its mean.
inline double binomial_z(double count, double trials, double probability) {
  return (count - trials * probability) / std::sqrt(trials * probability * (1 - probability));
}

}  // namespace swarmsmith
