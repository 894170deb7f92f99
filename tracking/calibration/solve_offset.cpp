#include "tracking/calibration/solve_offset.h"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/math.h"
#include "base/plain_text.h"
#include "tracking/rig/issue.h"

namespace swarmsmith {
namespace {

constexpr double kTrim = 3;
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kLeastRun_m = 0.5;
/// Shortest distance for measuring a direction of travel.
constexpr double kStep_m = 0.1;
constexpr double kMostSpread_rad = 5 * kDegree;

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// The unknowns are centre x, y; offset x, y; drift x, y.
struct SpinFit {
  Eigen::Matrix<double, 6, 1> unknowns;
  Matrix6 inverse;                ///< inverse of the normal matrix
  std::vector<double> residuals;  ///< distance, one per sample
  double squares = 0;
};

std::optional<SpinFit> fit_spin(const std::vector<TagSample>& samples) {
  const auto count = static_cast<Eigen::Index>(samples.size());
  if (count < 4) return std::nullopt;
  Eigen::Matrix<double, Eigen::Dynamic, 6> a(2 * count, 6);
  Eigen::VectorXd b(2 * count);
  // Times relative to the middle keep the equations well conditioned.
  const double middle = (samples.front().time_s + samples.back().time_s) / 2;
  for (Eigen::Index i = 0; i < count; ++i) {
    const TagSample& sample = samples[static_cast<std::size_t>(i)];
    const double c = std::cos(sample.tag.theta);
    const double s = std::sin(sample.tag.theta);
    const double t = sample.time_s - middle;
    // tag = centre + drift * t + rotation(theta) * offset is linear in the six unknowns, so it
    // needs no start and no iteration.
    a.middleRows<2>(2 * i) << 1, 0, c, -s, t, 0, 0, 1, s, c, 0, t;
    b.segment<2>(2 * i) << sample.tag.x, sample.tag.y;
  }
  const Matrix6 normal = a.transpose() * a;
  const Eigen::SelfAdjointEigenSolver<Matrix6> axes(normal);
  // If the heading hardly changes, the centre and the offset cannot be told apart.
  if (!(axes.eigenvalues()(0) > 1e-9 * axes.eigenvalues()(5))) return std::nullopt;
  SpinFit fit;
  fit.inverse = normal.inverse();
  fit.unknowns = fit.inverse * (a.transpose() * b);
  const Eigen::VectorXd off = b - a * fit.unknowns;
  for (Eigen::Index i = 0; i < count; ++i)
    fit.residuals.push_back(off.segment<2>(2 * i).norm());
  fit.squares = off.squaredNorm();
  return fit;
}

/// The range of the headings, from the smallest to the largest, including full turns.
double turn_of(const std::vector<TagSample>& samples) {
  double heading = 0;
  double least = 0;
  double most = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    heading += wrap_angle(samples[i].tag.theta - samples[i - 1].tag.theta);
    least = std::min(least, heading);
    most = std::max(most, heading);
  }
  return most - least;
}

Unexpected refuse(std::string text) {
  return Unexpected(error_of(IssueCode::SpinQuality, std::move(text), ""));
}

}  // namespace

Expected<OffsetCalibration> solve_offset(std::span<const TagSample> samples) {
  std::vector<TagSample> kept(samples.begin(), samples.end());
  std::optional<SpinFit> fit = fit_spin(kept);
  constexpr int kMostRounds = 10;
  for (int round = 0; fit && round < kMostRounds; ++round) {
    const auto freedom = static_cast<double>(2 * kept.size()) - 6;
    // The variance is per axis; a residual is a distance over both axes.
    const double limit = kTrim * std::sqrt(2 * fit->squares / freedom);
    std::vector<TagSample> rest;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      if (fit->residuals[i] <= limit) rest.push_back(kept[i]);
    }
    if (rest.size() == kept.size()) break;
    kept = std::move(rest);
    fit = fit_spin(kept);
  }
  const double turned = turn_of(kept);
  if (!fit) {
    return refuse(fmt::format(
        "{} over {:.0f} degrees {} not enough; film the robot turning "
        "on the spot, two turns or more",
        counted(kept.size(), "sample"), turned / kDegree, kept.size() == 1 ? "is" : "are"));
  }
  const double variance = fit->squares / (static_cast<double>(2 * kept.size()) - 6);
  OffsetCalibration calibration;
  calibration.offset = {fit->unknowns(2), fit->unknowns(3), 0};
  calibration.sigma_x_m = std::sqrt(variance * fit->inverse(2, 2));
  calibration.sigma_y_m = std::sqrt(variance * fit->inverse(3, 3));
  calibration.rms_m = std::sqrt(fit->squares / static_cast<double>(kept.size()));
  calibration.drift_m_s = std::hypot(fit->unknowns(4), fit->unknowns(5));
  calibration.turned_rad = turned;
  calibration.samples = static_cast<int>(kept.size());
  return calibration;
}

Expected<TravelYaw> solve_yaw(std::span<const TagSample> samples, const TagOffset& offset,
                              bool reverse) {
  const TagOffset without_yaw{offset.x_m, offset.y_m, 0};
  std::vector<Pose> centres;
  for (const TagSample& sample : samples)
    centres.push_back(robot_pose(sample.tag, without_yaw));
  TravelYaw travel;
  if (!centres.empty()) {
    travel.length_m =
        std::hypot(centres.back().x - centres.front().x, centres.back().y - centres.front().y);
  }
  if (!(travel.length_m >= kLeastRun_m)) {
    return refuse(fmt::format("the straight run is {:.2f} m long, but at least {} m are needed",
                              travel.length_m, kLeastRun_m));
  }
  double sine = 0;
  double cosine = 0;
  int count = 0;
  std::size_t from = 0;
  for (std::size_t to = 1; to < centres.size(); ++to) {
    const auto way = [&](std::size_t i) {
      return std::hypot(centres[to].x - centres[i].x, centres[to].y - centres[i].y);
    };
    if (way(from) < kStep_m) continue;
    while (from + 1 < to && way(from + 1) >= kStep_m)
      ++from;
    const double direction =
        std::atan2(centres[to].y - centres[from].y, centres[to].x - centres[from].x);
    // Even in a slight curve, the heading half way is the direction of the chord.
    const double heading = centres[(from + to) / 2].theta;
    const double yaw = heading - direction + (reverse ? std::numbers::pi : 0);
    sine += std::sin(yaw);
    cosine += std::cos(yaw);
    ++count;
  }
  travel.yaw_rad = std::atan2(sine, cosine);
  const double length = std::hypot(sine, cosine) / count;
  // The circular standard deviation, sqrt(-2 ln R) (Mardia 1972); rounding may make R exceed 1.
  travel.spread_rad = std::sqrt(std::max(0.0, -2 * std::log(std::min(1.0, length))));
  if (!(travel.spread_rad <= kMostSpread_rad)) {
    return refuse(
        fmt::format("heading and direction of travel differ by a spread of {:.1f} "
                    "degrees, limit {:.0f}; drive straight on, without stops and turns",
                    travel.spread_rad / kDegree, kMostSpread_rad / kDegree));
  }
  return travel;
}

}  // namespace swarmsmith
