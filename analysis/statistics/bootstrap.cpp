#include "analysis/statistics/bootstrap.h"

#include <vector>

#include "analysis/statistics/summary.h"
#include "base/rng.h"

namespace swarmsmith {
namespace {

double resampled_mean(std::span<const double> values, Rng& rng) {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    sum += values[rng.below(values.size())];
  return sum / static_cast<double>(values.size());
}

MeanDifference with_interval(double value, const std::vector<double>& resampled) {
  return {value, quantile_of(resampled, 0.025), quantile_of(resampled, 0.975)};
}

}  // namespace

MeanDifference mean_difference(std::span<const double> first, std::span<const double> second,
                               std::size_t resamples, std::uint64_t seed) {
  Rng rng = Rng(seed).split("bootstrap");
  std::vector<double> resampled;
  resampled.reserve(resamples);
  for (std::size_t i = 0; i < resamples; ++i) {
    const double mean = resampled_mean(first, rng);
    resampled.push_back(mean - resampled_mean(second, rng));
  }
  return with_interval(mean_of(first) - mean_of(second), resampled);
}

MeanDifference paired_mean_difference(std::span<const double> first, std::span<const double> second,
                                      std::size_t resamples, std::uint64_t seed) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < first.size(); ++i)
    differences.push_back(first[i] - second[i]);
  Rng rng = Rng(seed).split("bootstrap");
  std::vector<double> resampled;
  resampled.reserve(resamples);
  for (std::size_t i = 0; i < resamples; ++i)
    resampled.push_back(resampled_mean(differences, rng));
  return with_interval(mean_of(differences), resampled);
}

}  // namespace swarmsmith
