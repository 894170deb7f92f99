#include "tracking/robots/latency.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "base/math.h"

namespace swarmsmith {
namespace {

/// Shifts that are tried.
constexpr double kLeast_s = -0.5;
constexpr double kMost_s = 1.5;
constexpr double kStep_s = 0.01;
constexpr int kShifts = 201;

/// A command holds that long where no other follows.
constexpr double kPeriod_s = 0.1;
/// Samples of one camera further apart say nothing of when something happened between them.
constexpr double kLongestGap_s = 0.25;
constexpr double kBlock_s = 2;
constexpr std::size_t kLeastIntervals = 50;
constexpr double kLargestError_s = 0.02;
/// What is commanded below this over a whole run is standing: metres and radians.
constexpr double kLeastWay_m = 0.05;
constexpr double kLeastTurn_rad = 0.5;
constexpr double kTreadDistance_m = 0.147;
/// Sums of squares of a motion without noise are not less.
constexpr double kLeastSquares = 1e-12;

/// What the camera saw between two of its frames.
struct Interval {
  double from_s = 0;
  double to_s = 0;
  double ahead_m = 0;  ///< along the heading in the middle
  double aside_m = 0;
  double turn_rad = 0;
};

std::vector<Interval> intervals_of(std::span<const Sample> seen, double until_s) {
  std::vector<Interval> intervals;
  std::map<int, const Sample*> last;
  for (const Sample& sample : seen) {
    if (sample.use != Sample::Use::Used || sample.time_s > until_s) continue;
    const Sample* before = std::exchange(last[sample.camera], &sample);
    if (before == nullptr) continue;
    const double gap_s = sample.time_s - before->time_s;
    if (gap_s <= 0 || gap_s > kLongestGap_s) continue;
    const double turn = wrap_angle(sample.pose.theta - before->pose.theta);
    const SinCos heading = sin_cos(before->pose.theta + turn / 2);
    const double x = sample.pose.x - before->pose.x;
    const double y = sample.pose.y - before->pose.y;
    intervals.push_back({before->time_s, sample.time_s, x * heading.cos + y * heading.sin,
                         y * heading.cos - x * heading.sin, turn});
  }
  return intervals;
}

/// What was commanded from the beginning until a time: a way and a turn that are straight lines
/// between commands.
class Commanded {
 public:
  explicit Commanded(std::span<const TimedCommand> commands) : commands_(commands) {
    double way = 0;
    double turn = 0;
    for (std::size_t i = 0; i < commands.size(); ++i) {
      if (i > 0) {
        const double held_s = commands[i].time_s - commands[i - 1].time_s;
        way += held_s * speed(i - 1);
        turn += held_s * spin(i - 1);
      }
      ways_.push_back(way);
      turns_.push_back(turn);
    }
  }

  /// Way and turn until then.
  std::array<double, 2> until(double time_s) const {
    const auto next = std::ranges::upper_bound(commands_, time_s, {}, &TimedCommand::time_s);
    if (next == commands_.begin()) return {0, 0};
    const auto i = static_cast<std::size_t>(next - commands_.begin()) - 1;
    const double held_s = time_s - commands_[i].time_s;
    return {ways_[i] + held_s * speed(i), turns_[i] + held_s * spin(i)};
  }

 private:
  double speed(std::size_t i) const { return (commands_[i].left_mps + commands_[i].right_mps) / 2; }
  double spin(std::size_t i) const {
    return (commands_[i].right_mps - commands_[i].left_mps) / kTreadDistance_m;
  }

  std::span<const TimedCommand> commands_;
  std::vector<double> ways_;
  std::vector<double> turns_;
};

/// Commanded and seen motion at one shift: their sums, what is left, and how well they agree.
struct Fit {
  std::vector<std::array<double, 2>> commanded;  ///< way and turn, an interval
  std::array<double, 3> gains{};                 ///< ahead, aside, turn
  double way_left = 0;                           ///< sums of squares
  double turn_left = 0;
  double way_agreement = 0;
  double turn_agreement = 0;

  /// Minus the logarithm of the likelihood with the variances that make it largest.
  double surprise() const {
    const auto count = static_cast<double>(commanded.size());
    return count * std::log(way_left / (2 * count)) + count / 2 * std::log(turn_left / count);
  }
};

Fit fit_at(double shift_s, const std::vector<Interval>& intervals, const Commanded& commanded) {
  Fit fit;
  double ahead = 0;
  double aside = 0;
  double turn = 0;
  double ways = 0;
  double turns = 0;
  double seen_ways = 0;
  double seen_turns = 0;
  for (const Interval& seen : intervals) {
    const auto from = commanded.until(seen.from_s - shift_s);
    const auto to = commanded.until(seen.to_s - shift_s);
    const std::array<double, 2> told{to[0] - from[0], to[1] - from[1]};
    fit.commanded.push_back(told);
    ahead += seen.ahead_m * told[0];
    aside += seen.aside_m * told[0];
    turn += seen.turn_rad * told[1];
    ways += told[0] * told[0];
    turns += told[1] * told[1];
    seen_ways += seen.ahead_m * seen.ahead_m + seen.aside_m * seen.aside_m;
    seen_turns += seen.turn_rad * seen.turn_rad;
  }
  if (ways > 0) fit.gains = {ahead / ways, aside / ways, 0};
  if (turns > 0) fit.gains[2] = turn / turns;
  fit.way_left = std::max(seen_ways - ahead * fit.gains[0] - aside * fit.gains[1], kLeastSquares);
  fit.turn_left = std::max(seen_turns - turn * fit.gains[2], kLeastSquares);
  if (ways > 0 && seen_ways > 0)
    fit.way_agreement = hypot(ahead, aside) / std::sqrt(ways * seen_ways);
  if (turns > 0 && seen_turns > 0) fit.turn_agreement = turn / std::sqrt(turns * seen_turns);
  return fit;
}

/// The sum over blocks of their squared slopes, divided by the squared curvature: the variance when
/// the errors of a block belong together.
double sandwich_variance(double shift_s, const Fit& best, double curvature,
                         const std::vector<Interval>& intervals, const Commanded& commanded) {
  const auto count = static_cast<double>(intervals.size());
  const double way_variance = best.way_left / (2 * count);
  const double turn_variance = best.turn_left / count;
  std::map<std::int64_t, double> slopes;
  const auto add = [&](double by_s, double sign) {
    const Fit fit = fit_at(shift_s + by_s, intervals, commanded);
    for (std::size_t i = 0; i < intervals.size(); ++i) {
      const double ahead = intervals[i].ahead_m - best.gains[0] * fit.commanded[i][0];
      const double aside = intervals[i].aside_m - best.gains[1] * fit.commanded[i][0];
      const double turn = intervals[i].turn_rad - best.gains[2] * fit.commanded[i][1];
      const double surprise =
          (ahead * ahead + aside * aside) / (2 * way_variance) + turn * turn / (2 * turn_variance);
      slopes[static_cast<std::int64_t>(std::floor(intervals[i].to_s / kBlock_s))] +=
          sign * surprise / (2 * kStep_s);
    }
  };
  add(kStep_s, 1);
  add(-kStep_s, -1);
  double squares = 0;
  for (const auto& [block, slope] : slopes)
    squares += slope * slope;
  return squares / (curvature * curvature);
}

Latency not_told(std::string reason) {
  Latency latency;
  latency.reason = std::move(reason);
  return latency;
}

/// How much was commanded while the camera looked.
struct Amount {
  double way_m = 0;
  double turn_rad = 0;
};

Amount amount_of(const Fit& fit) {
  Amount amount;
  for (const auto& [way, turn] : fit.commanded) {
    amount.way_m += std::fabs(way);
    amount.turn_rad += std::fabs(turn);
  }
  return amount;
}

}  // namespace

Latency latency_of(std::span<const TimedCommand> commands, std::span<const Sample> seen) {
  if (commands.empty()) return not_told("its log has no commands");
  const std::vector<Interval> intervals =
      intervals_of(seen, commands.back().time_s + kPeriod_s + kLeast_s);
  if (intervals.size() < kLeastIntervals) {
    return not_told(fmt::format(
        "the camera saw it in {} pairs of frames while its log has commands, and {} are needed",
        intervals.size(), kLeastIntervals));
  }
  const Commanded commanded(commands);
  std::vector<double> surprises;
  for (int i = 0; i < kShifts; ++i)
    surprises.push_back(fit_at(kLeast_s + kStep_s * i, intervals, commanded).surprise());
  const auto least =
      static_cast<std::size_t>(std::ranges::min_element(surprises) - surprises.begin());
  double shift_s = kLeast_s + kStep_s * static_cast<double>(least);
  const Amount amount = amount_of(fit_at(shift_s, intervals, commanded));
  const bool is_to_turn = amount.turn_rad >= kLeastTurn_rad;
  if (!is_to_turn && amount.way_m < kLeastWay_m) return not_told("its commands did not move it");

  const bool is_at_the_edge = least == 0 || least + 1 == surprises.size();
  double curvature = 0;
  if (!is_at_the_edge) {
    const double before = surprises[least - 1];
    const double after = surprises[least + 1];
    const double bend = before - 2 * surprises[least] + after;
    if (bend > 0) shift_s += kStep_s * (before - after) / (2 * bend);
    curvature = bend / (kStep_s * kStep_s);
  }
  const Fit best = fit_at(shift_s, intervals, commanded);
  Latency latency;
  latency.agreement = is_to_turn ? best.turn_agreement : best.way_agreement;
  if (*latency.agreement < kLeastAgreement) {
    latency.reason = fmt::format(
        "what the camera saw does not follow its commands (agreement "
        "{:.2f}, at least {:g} is needed)",
        *latency.agreement, kLeastAgreement);
    return latency;
  }
  if (is_at_the_edge) {
    latency.beyond = true;
    latency.reason =
        fmt::format("its motion is {} s or more from its commands; is the start of the run right?",
                    least == 0 ? kLeast_s : kMost_s);
    return latency;
  }
  if (curvature > 0) {
    latency.error_s = std::sqrt(
        std::max(1 / curvature, sandwich_variance(shift_s, best, curvature, intervals, commanded)));
  }
  if (!(curvature > 0) || latency.error_s > kLargestError_s) {
    latency.reason =
        curvature > 0
            ? fmt::format(
                  "its commands change too little: it would be known to {:.0f} ms, and {:.0f} "
                  "are allowed",
                  1000 * latency.error_s, 1000 * kLargestError_s)
            : "its commands do not change";
    return latency;
  }
  latency.seconds = shift_s;
  return latency;
}

}  // namespace swarmsmith
