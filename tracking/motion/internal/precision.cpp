#include "tracking/motion/internal/precision.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/assert.h"
#include "base/math.h"
#include "base/median.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kHalf = 2;
constexpr std::size_t kLeastResiduals = 10;
/// Five samples that span a longer time are not used.
constexpr double kWindow_s = 0.6;
/// Median of the absolute value of a standard normal variable.
constexpr double kMedianOfNormal = 0.6744897501960817;

using Five = Eigen::Matrix<double, 5, 1>;

/// The weights of five values in the parabola's value at the middle one: a row of the hat matrix of
/// least squares. `times` count from the middle one. Nothing if times coincide.
std::optional<Five> weights_at_middle(const Five& times) {
  Eigen::Matrix<double, 5, 3> powers;
  powers << Five::Ones(), times, times.cwiseAbs2();
  const Eigen::Matrix3d normal = powers.transpose() * powers;
  if (!(std::fabs(normal.determinant()) > 1e-18)) return std::nullopt;
  return powers * normal.inverse().col(0);
}

/// The middle value minus the parabola there, scaled to the standard deviation of one value.
double residual_at_middle(const Five& weights, const Five& values) {
  SWARMSMITH_ASSERT(weights(kHalf) < 1, "a fit that goes through the middle says nothing of it");
  // A hat matrix is a projection: the squares of its row add up to its middle entry.
  return (values(kHalf) - weights.dot(values)) / std::sqrt(1 - weights(kHalf));
}

double sigma_of(const std::vector<double>& residuals, double least) {
  if (residuals.size() < kLeastResiduals) return least;
  return std::max(least, upper_median(residuals) / kMedianOfNormal);
}

}  // namespace

Scatter scatter_of(const std::vector<TimedPose>& track) {
  std::vector<double> of_place;
  std::vector<double> of_heading;
  for (std::size_t i = kHalf; i + kHalf < track.size(); ++i) {
    if (track[i + kHalf].time_s - track[i - kHalf].time_s > kWindow_s) continue;
    Five times;
    Five xs;
    Five ys;
    Five headings;
    for (Eigen::Index j = 0; j < times.size(); ++j) {
      const TimedPose& sample = track[i - kHalf + static_cast<std::size_t>(j)];
      times(j) = sample.time_s - track[i].time_s;
      xs(j) = sample.pose.x - track[i].pose.x;
      ys(j) = sample.pose.y - track[i].pose.y;
      headings(j) = wrap_angle(sample.pose.theta - track[i].pose.theta);
    }
    const std::optional<Five> weights = weights_at_middle(times);
    if (!weights) continue;
    // If the times are too uneven, the parabola passes through the middle value and leaves no
    // residual.
    if ((*weights)(kHalf) > 0.9) continue;
    of_place.push_back(std::fabs(residual_at_middle(*weights, xs)));
    of_place.push_back(std::fabs(residual_at_middle(*weights, ys)));
    of_heading.push_back(std::fabs(residual_at_middle(*weights, headings)));
  }
  return {sigma_of(of_place, kLeastSigma.sigma_m), sigma_of(of_heading, kLeastSigma.sigma_rad)};
}

}  // namespace swarmsmith
