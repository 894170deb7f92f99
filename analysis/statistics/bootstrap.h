#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace swarmsmith {

/// Resampling uses the stream "bootstrap" of this seed, so the same values give the same interval,
/// whatever else is compared.
inline constexpr std::uint64_t kBootstrapSeed = 1;
inline constexpr std::size_t kResamples = 10'000;

/// A difference of means, and its 95 % percentile interval: the 0.025 and 0.975 quantiles of the
/// difference over resamples (Efron and Tibshirani 1993, chapter 13).
struct MeanDifference {
  double value = 0;
  double low = 0;
  double high = 0;
};

/// For independent samples, first - second; each sample is resampled separately. Neither may be
/// empty.
MeanDifference mean_difference(std::span<const double> first, std::span<const double> second,
                               std::size_t resamples = kResamples,
                               std::uint64_t seed = kBootstrapSeed);

/// For paired samples of the same length, not empty; pairs are resampled.
MeanDifference paired_mean_difference(std::span<const double> first, std::span<const double> second,
                                      std::size_t resamples = kResamples,
                                      std::uint64_t seed = kBootstrapSeed);

}  // namespace swarmsmith
