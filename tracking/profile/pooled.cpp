#include "tracking/profile/pooled.h"

#include <algorithm>
#include <cmath>

#include "base/special_functions.h"

namespace swarmsmith {
namespace {

constexpr double kTail = 0.025;
constexpr double kNormal = 1.959963984540054;
/// Lower bound of the error; otherwise an estimate without noise would outweigh all others.
constexpr double kLeastError = 1e-9;

constexpr double kLeastDifference = 0.1;
constexpr double kLeastErrors = 5;
constexpr double kLeastSpreads = 3;

double spread_of(std::span<const Estimate> rates, double mean) {
  double squares = 0;
  for (const Estimate& rate : rates)
    squares += (rate.value - mean) * (rate.value - mean);
  return std::sqrt(squares / static_cast<double>(rates.size()));
}

}  // namespace

Pooled pooled(std::span<const Estimate> estimates) {
  const auto count = static_cast<double>(estimates.size());
  const auto square = [](const Estimate& one) {
    return std::max(one.error, kLeastError) * std::max(one.error, kLeastError);
  };
  const auto mean_with = [&](double variance, double& weights) {
    double sum = 0;
    weights = 0;
    for (const Estimate& one : estimates) {
      const double weight = 1 / (square(one) + variance);
      sum += weight * one.value;
      weights += weight;
    }
    return sum / weights;
  };
  double weights = 0;
  const double fixed = mean_with(0, weights);
  double heterogeneity = 0;
  double weights2 = 0;
  for (const Estimate& one : estimates) {
    heterogeneity += (one.value - fixed) * (one.value - fixed) / square(one);
    weights2 += 1 / (square(one) * square(one));
  }
  // DerSimonian and Laird's moment estimator of the variance between robots and runs: Cochran's Q
  // minus its expectation without such a variance, cut off at 0.
  const double scale = weights - weights2 / weights;
  const double variance =
      estimates.size() < 2 ? 0 : std::max(0.0, (heterogeneity - (count - 1)) / scale);

  Pooled result{.spread = std::sqrt(variance), .count = estimates.size()};
  result.mean = mean_with(variance, weights);
  result.error = std::sqrt(1 / weights);
  double half = kNormal * result.error;
  if (estimates.size() > 1) {
    double squares = 0;
    for (const Estimate& one : estimates) {
      const double off = one.value - result.mean;
      squares += off * off / (square(one) + variance);
    }
    // Hartung and Knapp's variance. It may be too small by chance if there are few estimates, so it
    // only replaces a smaller error.
    result.error = std::max(result.error, std::sqrt(squares / (count - 1) / weights));
    half = student_t_upper_quantile(kTail, count - 1) * result.error;
  }
  result.low = result.mean - half;
  result.high = result.mean + half;
  return result;
}

Groups grouped(std::vector<Estimate> rates) {
  std::ranges::sort(rates, {}, &Estimate::value);
  Groups best{.usual = rates, .weak = {}};
  double most = 0;
  for (std::size_t first = 1; first < rates.size(); ++first) {
    const auto usual = std::span(rates).first(first);
    const auto weak = std::span(rates).subspan(first);
    const Pooled low = pooled(usual);
    const Pooled high = pooled(weak);
    const double difference = high.mean - low.mean;
    const double spread = std::max(spread_of(usual, low.mean), spread_of(weak, high.mean));
    if (difference < kLeastDifference || difference < kLeastSpreads * spread) continue;
    // Use the errors of single estimates, because the spread of a group of one is unknown.
    const double error = std::hypot(usual.back().error, weak.front().error);
    if (weak.front().value - usual.back().value < kLeastErrors * error) continue;
    if (weak.front().value - usual.back().value <= most) continue;
    most = weak.front().value - usual.back().value;
    best = {{usual.begin(), usual.end()}, {weak.begin(), weak.end()}};
  }
  return best;
}

}  // namespace swarmsmith
