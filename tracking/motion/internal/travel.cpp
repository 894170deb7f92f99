#include "tracking/motion/internal/travel.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/assert.h"
#include "base/math.h"
#include "base/median.h"
#include "tracking/motion/internal/pivot.h"

namespace swarmsmith {
namespace {

constexpr double kMedianOfNormal = 0.6744897501960817;
/// Rounding error of the centre's path; smaller residuals do not count.
constexpr double kLeastStepSigma_m = 5e-5;
/// A heading counts as known if its sigma is smaller than this: a third of the scatter that a
/// straight run may have.
constexpr double kHeadingTold_rad = 1.5 * kPi / 180;
constexpr double kByTurnTold_m = 0.003;
/// The distance must exceed the noise by this factor, and the turns too.
constexpr double kOverNoise = 10;
constexpr double kLeastWay_m = 0.25;

/// Joins `stride` steps each, so that the motion of slow robots exceeds the noise, too.
std::vector<TravelStep> free_steps(std::span<const TravelStep> steps, int stride) {
  SWARMSMITH_ASSERT(stride >= 1, "a long step is of one step or more");
  std::vector<TravelStep> made;
  int in_a_row = 0;
  for (const TravelStep& step : steps) {
    const bool goes_on = !made.empty() && in_a_row > 0 && in_a_row < stride &&
                         std::fabs(made.back().to_s - step.from_s) < kSameInstant_s;
    if (step.touches || !step.is_steady) {
      // Drop an incomplete long step.
      if (in_a_row > 0 && in_a_row < stride) made.pop_back();
      in_a_row = 0;
      continue;
    }
    if (!goes_on) {
      if (in_a_row > 0 && in_a_row < stride) made.pop_back();
      made.push_back(step);
      in_a_row = 1;
      continue;
    }
    TravelStep& whole = made.back();
    whole.to_s = step.to_s;
    whole.ahead_m += step.ahead_m;
    whole.aside_m += step.aside_m;
    whole.turn_rad += step.turn_rad;
    whole.turn_sigma_rad = step.turn_sigma_rad;
    whole.sigma_m = std::max(whole.sigma_m, step.sigma_m);
    ++in_a_row;
  }
  if (in_a_row > 0 && in_a_row < stride) made.pop_back();
  return made;
}

/// Weighted sums of the products of (aside, ahead) and the turn.
struct Sums {
  Eigen::Matrix2d way = Eigen::Matrix2d::Zero();
  Eigen::Vector2d with_turn = Eigen::Vector2d::Zero();
  double turn = 0;
};

struct Line {
  Eigen::Vector2d normal{1, 0};  ///< perpendicular to the motion (aside, ahead) of the treads
  double ahead_m = 0;
  double most = 0;     ///< eigenvalue along these directions
  double by_turn = 0;  ///< distance that is proportional to the turn, metres per radian
};

double residual(const TravelStep& step, const Line& line) {
  return line.normal(0) * step.aside_m + line.normal(1) * step.ahead_m -
         line.ahead_m * step.turn_rad;
}

Line fit_line(const std::vector<TravelStep>& steps, const std::vector<double>& weights,
              bool with_place) {
  SWARMSMITH_ASSERT(steps.size() == weights.size(), "each step has its weight");
  Sums sums;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Eigen::Vector2d way(steps[i].aside_m, steps[i].ahead_m);
    sums.way += weights[i] * way * way.transpose();
    sums.with_turn += weights[i] * steps[i].turn_rad * way;
    sums.turn += weights[i] * steps[i].turn_rad * steps[i].turn_rad;
  }
  const bool turns = with_place && sums.turn > 1e-9;
  Eigen::Matrix2d rest = sums.way;
  if (turns) rest -= sums.with_turn * sums.with_turn.transpose() / sums.turn;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(rest);
  Line line;
  line.normal = axes.eigenvectors().col(0);
  line.most = axes.eigenvalues()(1);
  if (turns) line.ahead_m = line.normal.dot(sums.with_turn) / sums.turn;
  if (turns) line.by_turn = sums.with_turn.norm() / sums.turn;
  return line;
}

/// Least absolute residuals by reweighting, so that a minority of pushed steps does not turn the
/// line.
Line robust_line(const std::vector<TravelStep>& steps, bool with_place, double& sigma_m) {
  constexpr int kRounds = 20;
  std::vector<double> weights(steps.size(), 1);
  Line line = fit_line(steps, weights, with_place);
  std::vector<double> off(steps.size());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < steps.size(); ++i)
      off[i] = std::fabs(residual(steps[i], line));
    sigma_m = std::max(kLeastStepSigma_m, upper_median(off) / kMedianOfNormal);
    for (std::size_t i = 0; i < steps.size(); ++i)
      weights[i] = 1 / std::max(off[i], 2 * sigma_m);
    line = fit_line(steps, weights, with_place);
  }
  // Fit the steps that agree once more with equal weights, so that the error of the result is
  // known.
  double squares = 0;
  double count = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double is = residual(steps[i], line);
    weights[i] = std::fabs(is) < 4 * sigma_m ? 1 : 0;
    squares += weights[i] * is * is;
    count += weights[i];
  }
  if (count < 10) return line;
  sigma_m = std::max(kLeastStepSigma_m, std::sqrt(squares / count));
  return fit_line(steps, weights, with_place);
}

/// Fits both unknowns, or only the heading.
TravelFit fit_of(const std::vector<TravelStep>& steps, bool with_place) {
  TravelFit fit;
  double sigma_m = 0;
  const Line line = robust_line(steps, with_place, sigma_m);
  fit.step_sigma_m = sigma_m;
  const auto count = static_cast<double>(steps.size());
  double turned = std::atan2(line.normal(1), line.normal(0));
  double forward = 0;
  double backward = 0;
  double turns = 0;
  for (const TravelStep& step : steps) {
    const double along = step.ahead_m * std::cos(turned) - step.aside_m * std::sin(turned);
    forward += along;
    turns += step.turn_rad * step.turn_rad;
    if (std::fabs(along) <= 3 * sigma_m) continue;
    fit.way_m += std::fabs(along);
    if (step.ahead_m < 0) backward += std::fabs(along);
  }
  SWARMSMITH_ASSERT(backward <= fit.way_m, "what it went backwards is part of its way");
  // The true heading is the direction in which it drives more.
  fit.turned_rad = forward < 0 ? wrap_angle(turned + kPi) : turned;
  fit.by_turn_m = forward < 0 ? -line.ahead_m : line.ahead_m;
  fit.backward_share = fit.way_m > 0 ? backward / fit.way_m : 0;
  fit.turned_sigma_rad = sigma_m / std::sqrt(std::max(line.most, 1e-12));
  // If distance and turn are always proportional, noise of the turns looks like a distance.
  const double noise_m = hypot(sigma_m, line.by_turn * steps.front().turn_sigma_rad);
  fit.knows_heading = line.most > kOverNoise * count * noise_m * noise_m &&
                      fit.turned_sigma_rad < kHeadingTold_rad && fit.way_m >= kLeastWay_m;
  fit.knows_by_turn = with_place && fit.knows_heading &&
                      sigma_m / std::sqrt(std::max(turns, 1e-12)) < kByTurnTold_m;
  return fit;
}

TravelFit fit_way(std::span<const TravelStep> all) {
  constexpr std::size_t kLeastSteps = 20;
  TravelFit fit;
  double step_sigma_m = 0;
  for (const bool with_place : {true, false}) {
    for (const int stride : {1, 5}) {
      const std::vector<TravelStep> steps = free_steps(all, stride);
      if (steps.size() < kLeastSteps) continue;
      fit = fit_of(steps, with_place);
      if (step_sigma_m == 0) step_sigma_m = fit.step_sigma_m;
      fit.step_sigma_m = step_sigma_m;
      if (fit.knows_heading) return fit;
    }
  }
  return fit;
}

/// Measures the skid; a heading that is wrong by 180 degrees gives the same result.
void measure_skid(std::span<const TravelStep> steps, const Pivot& pivot, TravelFit& fit) {
  double products = 0;
  double squares = 0;
  double sides = 0;
  double count = 0;
  for (const TravelStep& step : steps) {
    if (step.touches || step.sigma_m > 0) continue;
    const double aside = step.aside_m - pivot.ahead_m * step.turn_rad;
    const double along = (step.ahead_m + pivot.aside_m * step.turn_rad) * step.turn_rad;
    products += aside * along;
    squares += along * along;
    sides += aside * aside;
    ++count;
  }
  constexpr double kLeast = 20;
  if (count < kLeast || !(squares > 0)) return;
  fit.skid = products / squares;
  const double left = std::max(sides - fit.skid * products, 0.0);
  fit.skid_sigma = std::sqrt(left / count / squares);
}

}  // namespace

TravelFit fit_travel(std::span<const TravelStep> steps) {
  TravelFit fit = fit_way(steps);
  const std::optional<Pivot> pivot = pivot_of(steps);
  if (!pivot) return fit;
  const double turned = fit.knows_heading ? fit.turned_rad : 0;
  fit.knows_place = true;
  fit.ahead_m = std::cos(turned) * pivot->ahead_m - std::sin(turned) * pivot->aside_m;
  fit.aside_m = std::sin(turned) * pivot->ahead_m + std::cos(turned) * pivot->aside_m;
  fit.place_sigma_m = pivot->sigma_m;
  measure_skid(steps, *pivot, fit);
  return fit;
}

namespace {

/// The part of a step that treads and skids do not explain, for the point about which the robot
/// turns, in the axes of its true heading.
struct Unexplained {
  double aside_m = 0;
  double way_m = 0;
};

/// The friction of treads slows a body's sideways motion and never drives it. So the sideways
/// motion in a step is at most the motion that the body already had in this direction in the step
/// before, until it has stopped; the rest is a push. After a contact or a gap, all of it may be the
/// body's own motion.
std::vector<Unexplained> unexplained(std::span<const TravelStep> steps, const TravelFit& fit) {
  const double turned = fit.knows_heading ? fit.turned_rad : 0;
  const Eigen::Rotation2Dd to_true(turned);
  // If the point about which it turns is unknown, sideways motion in proportion to turns may be due
  // to skids or to the position of the measured point.
  const double by_turn_m = !fit.knows_place && fit.knows_by_turn ? fit.by_turn_m : 0;
  std::vector<Unexplained> all;
  const TravelStep* before = nullptr;
  Eigen::Vector2d had(0, 0);  // ahead and left, in the axes of the previous step
  for (const TravelStep& step : steps) {
    Eigen::Vector2d way = to_true * Eigen::Vector2d(step.ahead_m, step.aside_m);
    if (fit.knows_place) way += step.turn_rad * Eigen::Vector2d(fit.aside_m, -fit.ahead_m);
    const bool goes_on = before != nullptr && !before->touches && !step.touches &&
                         std::fabs(before->to_s - step.from_s) < kSameInstant_s;
    double explained = way(1);
    if (goes_on) {
      const double turn = (before->turn_rad + step.turn_rad) / 2;
      const double kept = (Eigen::Rotation2Dd(-turn) * had)(1);
      const double with_turn = by_turn_m * step.turn_rad;
      explained = std::clamp(way(1), std::min(0.0, kept) + std::min(0.0, with_turn),
                             std::max(0.0, kept) + std::max(0.0, with_turn));
    }
    all.push_back({way(1) - explained, std::fabs(way(0))});
    had = {way(0), explained};
    before = &step;
  }
  return all;
}

}  // namespace

std::optional<Slide> worst_slide(std::span<const TravelStep> steps, const TravelFit& fit) {
  /// Tolerance for slip and single bumps: a length, plus a share of the distance.
  struct Window {
    double length_s;
    double slip_m;
  };
  constexpr std::array<Window, 2> kWindows{{{1, 0.03}, {5, 0.05}}};
  constexpr double kSlip = 0.1;
  constexpr double kSigmas = 4;
  const std::vector<Unexplained> ways = unexplained(steps, fit);
  SWARMSMITH_ASSERT(ways.size() == steps.size(), "each step has its way");
  std::optional<Slide> worst;
  for (const Window& window : kWindows) {
    std::size_t first = 0;
    double aside = 0;
    double way = 0;
    double squares = 0;
    const auto add = [&](std::size_t i, double sign) {
      const TravelStep& step = steps[i];
      if (step.touches) return;
      aside += sign * ways[i].aside_m;
      way += sign * ways[i].way_m;
      squares += sign * (fit.step_sigma_m * fit.step_sigma_m + step.sigma_m * step.sigma_m);
    };
    for (std::size_t last = 0; last < steps.size(); ++last) {
      add(last, 1);
      while (steps[last].to_s - steps[first].from_s > window.length_s + kSameInstant_s)
        add(first++, -1);
      SWARMSMITH_ASSERT(first <= last, "a step is shorter than the windows");
      const double limit =
          window.slip_m + kSlip * way + kSigmas * std::sqrt(std::max(0.0, squares));
      const double is = std::fabs(aside);
      if (worst && is - limit <= std::fabs(worst->aside_m) - worst->limit_m) continue;
      if (is == 0) continue;
      worst = Slide{steps[first].from_s, steps[last].to_s, aside, limit};
    }
  }
  return worst;
}

}  // namespace swarmsmith
