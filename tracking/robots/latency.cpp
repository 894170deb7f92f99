#include "tracking/robots/latency.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "base/math.h"
#include "base/plain_text.h"
#include "sim/control/treads.h"
#include "tracking/robots/intervals.h"

namespace swarmsmith {
namespace {

/// Range (to 1.5 s) and step of the shifts that are tried; the best one is then refined twice.
constexpr double kLeast_s = -0.5;
constexpr double kStep_s = 0.02;
constexpr int kShifts = 101;
constexpr double kFineStep_s = 0.005;

/// Accelerations that are tried, m/s^2 and rad/s^2; the last one is practically unlimited.
constexpr std::array kWayLimits{0.2, 0.4, 0.75, 1.5, 3.0, 8.0, 1000.0};
constexpr std::array kTurnLimits{3.0, 6.0, 12.0, 25.0, 50.0, 100.0, 250.0, 1e5};

/// Duration of the last command.
constexpr double kPeriod_s = 0.1;
constexpr double kBlock_s = 2;
constexpr std::size_t kLeastIntervals = 50;
constexpr double kLargestError_s = 0.02;
constexpr double kLeastSurprise = 10;
/// An acceleration limit that improves the fit by more than this is not chance, although the motion
/// may have another cause.
constexpr double kLeastDoubt = 2;
/// A robot whose commands over a whole run sum to less than this stands still: metres and radians.
constexpr double kLeastWay_m = 0.05;
constexpr double kLeastTurn_rad = 0.5;
/// Lower bound of the sums of squares, for motion without noise.
constexpr double kLeastSquares = 1e-12;

/// The motion of treads that follow their commands with a limited acceleration, as the distance
/// until a time. `values` are the commanded speeds; before the first one the treads do not move.
class Response {
 public:
  Response(std::span<const TimedCommand> commands, const std::vector<double>& values, double limit)
      : begin_s_(commands.front().time_s - kTable_s) {
    const double end_s = commands.back().time_s + kPeriod_s;
    const auto count = static_cast<std::size_t>((end_s - begin_s_) / kTable_s) + 2;
    double speed = 0;
    double way = 0;
    std::size_t next = 0;
    for (std::size_t i = 0; i < count; ++i) {
      ways_.push_back(way);
      const double from_s = begin_s_ + kTable_s * static_cast<double>(i);
      const double wanted = mean_command(commands, values, from_s, next);
      const double most = limit * kTable_s;
      if (std::fabs(wanted - speed) <= most) {
        speed = wanted;
        way += speed * kTable_s;
      } else {
        const double change = wanted > speed ? most : -most;
        way += (speed + change / 2) * kTable_s;
        speed += change;
      }
    }
  }

  double until(double time_s) const {
    const double place = (time_s - begin_s_) / kTable_s;
    if (place <= 0) return 0;
    const std::size_t i = std::min(static_cast<std::size_t>(place), ways_.size() - 2);
    return ways_[i] + (place - static_cast<double>(i)) * (ways_[i + 1] - ways_[i]);
  }

 private:
  static constexpr double kTable_s = 0.005;

  /// Mean command over one step of the table; `next` is the first command after the previous step.
  static double mean_command(std::span<const TimedCommand> commands,
                             const std::vector<double>& values, double from_s, std::size_t& next) {
    const double to_s = from_s + kTable_s;
    double sum = 0;
    double since_s = from_s;
    for (; next < commands.size() && commands[next].time_s < to_s; ++next) {
      const double change_s = std::max(commands[next].time_s, since_s);
      sum += (next == 0 ? 0 : values[next - 1]) * (change_s - since_s);
      since_s = change_s;
    }
    return (sum + (next == 0 ? 0 : values[next - 1]) * (to_s - since_s)) / kTable_s;
  }

  double begin_s_;
  std::vector<double> ways_;
};

/// Commanded and seen motion of one kind, at one shift.
struct Fit {
  std::vector<double> told;      ///< commanded motion of each interval
  std::array<double, 2> gain{};  ///< ahead and to the side; for turns only the first
  double left = kLeastSquares;   ///< sum of squared residuals
  double agreement = 0;
};

/// Seen motion of one kind: distances ahead and to the side, or turns.
class Seen {
 public:
  Seen(const std::vector<SeenInterval>& intervals, bool is_turn)
      : intervals_(intervals), is_turn_(is_turn) {}

  std::array<double, 2> of(std::size_t i) const {
    const SeenInterval& seen = intervals_[i];
    if (is_turn_) return {seen.turn_rad, 0};
    return {seen.ahead_m, seen.aside_m};
  }

  Fit fit(const Response& response, double shift_s) const {
    Fit fit;
    fit.told.reserve(intervals_.size());
    std::array<double, 2> both{};
    double told = 0;
    double seen = 0;
    for (std::size_t i = 0; i < intervals_.size(); ++i) {
      const double way = response.until(intervals_[i].to_s - shift_s) -
                         response.until(intervals_[i].from_s - shift_s);
      const std::array<double, 2> here = of(i);
      fit.told.push_back(way);
      told += way * way;
      seen += here[0] * here[0] + here[1] * here[1];
      both[0] += here[0] * way;
      both[1] += here[1] * way;
    }
    if (told > 0) fit.gain = {both[0] / told, both[1] / told};
    fit.left = std::max(seen - both[0] * fit.gain[0] - both[1] * fit.gain[1], kLeastSquares);
    // A turn in the opposite direction is disagreement; a distance in another direction means that
    // the heading is off.
    const double common = is_turn_ ? both[0] : hypot(both[0], both[1]);
    if (told > 0 && seen > 0) fit.agreement = common / std::sqrt(told * seen);
    return fit;
  }

  /// Number of seen values, all with the same variance.
  double count() const { return static_cast<double>(intervals_.size()) * (is_turn_ ? 1 : 2); }

  /// The negative log-likelihood, with the variance that maximises the likelihood.
  double surprise(const Fit& fit) const { return count() / 2 * std::log(fit.left / count()); }

 private:
  const std::vector<SeenInterval>& intervals_;
  bool is_turn_;
};

/// One kind of motion of the treads, with the acceleration limit that fits it best.
class Followed {
 public:
  Followed(std::span<const TimedCommand> commands, std::vector<double> values, Seen seen,
           std::span<const double> limits)
      : commands_(commands), values_(std::move(values)), seen_(seen), limits_(limits) {
    for (const double limit : limits)
      responses_.emplace_back(commands_, values_, limit);
  }

  /// Sets whether accelerations are limited.
  void limit(bool is_limited) { is_limited_ = is_limited; }

  /// The surprise at a shift with the best of the limits that are tried; does not keep this limit.
  double coarse(double shift_s) const {
    if (!is_limited_) return seen_.surprise(seen_.fit(responses_.back(), shift_s));
    double least = kNone;
    for (const Response& response : responses_)
      least = std::min(least, seen_.surprise(seen_.fit(response, shift_s)));
    return least;
  }

  /// From now on, limits are searched around the best limit at this shift.
  void settle(double shift_s) {
    double least = kNone;
    for (std::size_t i = 0; i < responses_.size(); ++i) {
      const double surprise = seen_.surprise(seen_.fit(responses_[i], shift_s));
      if (surprise >= least) continue;
      least = surprise;
      low_ = std::log(limits_[i == 0 ? 0 : i - 1]);
      high_ = std::log(limits_[std::min(i + 1, limits_.size() - 1)]);
    }
  }

  /// The limit with the smallest surprise, by golden-section search.
  double best_limit(double shift_s) const {
    // Nine sections leave 0.618^9 = 1.3 % of the bracket, which is a logarithm.
    constexpr double kGolden = 0.6180339887498949;
    constexpr int kSections = 9;
    if (!is_limited_) return limits_.back();
    const auto surprise = [&](double logarithm) {
      return seen_.surprise(seen_.fit(Response(commands_, values_, std::exp(logarithm)), shift_s));
    };
    double low = low_;
    double high = high_;
    double left = high - kGolden * (high - low);
    double right = low + kGolden * (high - low);
    double at_left = surprise(left);
    double at_right = surprise(right);
    for (int i = 0; i < kSections; ++i) {
      if (at_left <= at_right) {
        high = right;
        right = std::exchange(left, right - kGolden * (right - low));
        at_right = std::exchange(at_left, surprise(left));
      } else {
        low = left;
        left = std::exchange(right, left + kGolden * (high - left));
        at_left = std::exchange(at_right, surprise(right));
      }
    }
    return std::exp((low + high) / 2);
  }

  double fine(double shift_s) const {
    return seen_.surprise(seen_.fit(response_of(best_limit(shift_s)), shift_s));
  }

  Response response_of(double limit) const { return {commands_, values_, limit}; }
  const Seen& seen() const { return seen_; }

 private:
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  std::span<const TimedCommand> commands_;
  std::vector<double> values_;
  Seen seen_;
  std::span<const double> limits_;
  std::vector<Response> responses_;
  bool is_limited_ = false;
  double low_ = 0;
  double high_ = 0;
};

/// Adds the surprise of one kind of motion at a shift to each block of time, with gain, variance
/// and acceleration of the best shift.
void add_blocks(const Followed& motion, const std::vector<SeenInterval>& intervals, double shift_s,
                double by_s, std::map<std::int64_t, double>& blocks) {
  const Response response = motion.response_of(motion.best_limit(shift_s));
  const Fit best = motion.seen().fit(response, shift_s);
  const Fit fit = motion.seen().fit(response, shift_s + by_s);
  const double variance = best.left / motion.seen().count();
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const std::array<double, 2> seen = motion.seen().of(i);
    const double ahead = seen[0] - best.gain[0] * fit.told[i];
    const double aside = seen[1] - best.gain[1] * fit.told[i];
    blocks[static_cast<std::int64_t>(std::floor(intervals[i].to_s / kBlock_s))] +=
        (ahead * ahead + aside * aside) / (2 * variance);
  }
}

/// The sum of the blocks' squared slopes, divided by the squared curvature: the variance if the
/// errors within a block are correlated. At least the variance of independent errors.
double sandwich_variance(const Followed& way, const Followed& turn,
                         const std::vector<SeenInterval>& intervals, double shift_s) {
  using Blocks = std::map<std::int64_t, double>;
  std::array<Blocks, 3> at;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double by_s = kFineStep_s * (static_cast<double>(i) - 1);
    add_blocks(way, intervals, shift_s, by_s, at[i]);
    add_blocks(turn, intervals, shift_s, by_s, at[i]);
  }
  double squares = 0;
  double curvature = 0;
  for (const auto& [block, here] : at[1]) {
    const double before = at[0][block];
    const double after = at[2][block];
    const double slope = (after - before) / (2 * kFineStep_s);
    squares += slope * slope;
    curvature += (before - 2 * here + after) / (kFineStep_s * kFineStep_s);
  }
  if (!(curvature > 0)) return 0;
  return std::max(squares / (curvature * curvature), 1 / curvature);
}

Latency not_told(std::string reason) {
  Latency latency;
  latency.reason = std::move(reason);
  return latency;
}

double sum_of_sizes(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values)
    sum += std::fabs(value);
  return sum;
}

/// The minimum of a parabola through three points that are `step` apart, and its curvature.
struct Parabola {
  double off = 0;
  double curvature = 0;
};

Parabola parabola(double before, double here, double after, double step) {
  const double bend = before - 2 * here + after;
  if (!(bend > 0)) return {};
  return {std::clamp(step * (before - after) / (2 * bend), -step, step), bend / (step * step)};
}

/// The best shift, with or without limited accelerations.
struct Shift {
  double shift_s = 0;
  double surprise = 0;
  double curvature = 0;    ///< 0 if none was found
  bool is_beyond = false;  ///< it lies at the end of the range of shifts
};

Shift best_shift(Followed& way, Followed& turn, bool is_limited) {
  way.limit(is_limited);
  turn.limit(is_limited);
  std::vector<double> surprises;
  for (int i = 0; i < kShifts; ++i) {
    const double shift_s = kLeast_s + kStep_s * i;
    surprises.push_back(way.coarse(shift_s) + turn.coarse(shift_s));
  }
  const auto least =
      static_cast<std::size_t>(std::ranges::min_element(surprises) - surprises.begin());
  Shift best{.shift_s = kLeast_s + kStep_s * static_cast<double>(least),
             .surprise = surprises[least]};
  // If all shifts fit equally well, there is no best shift.
  if (least == 0 || least + 1 == surprises.size()) {
    best.is_beyond = std::ranges::max(surprises) - best.surprise > kLeastSurprise;
    return best;
  }
  // Each shift has its own best limit, and the joint minimum is narrower than the steps above.
  const auto settled = [&](double shift_s) {
    way.settle(shift_s);
    turn.settle(shift_s);
    return way.fine(shift_s) + turn.fine(shift_s);
  };
  best.surprise = settled(best.shift_s);
  for (const double step : {kStep_s, kStep_s / 2, kFineStep_s}) {
    const double middle_s = best.shift_s;
    for (const double shift_s : {middle_s - step, middle_s + step}) {
      const double surprise = settled(shift_s);
      if (surprise < best.surprise) best = {.shift_s = shift_s, .surprise = surprise};
    }
  }
  for (const double step : {kStep_s, kFineStep_s, kFineStep_s}) {
    const auto at = [&](double by_s) { return settled(best.shift_s + by_s); };
    best.surprise = at(0);
    // Each call begins where the last one settled, so their order is part of the result.
    const double after = at(step);
    const double before = at(-step);
    const Parabola curve = parabola(before, best.surprise, after, step);
    // Within the time between frames the curve may be flat, although it bends over a whole frame.
    if (curve.curvature > 0) best.curvature = curve.curvature;
    if (step == kFineStep_s) best.shift_s += curve.off;
  }
  return best;
}

}  // namespace

Latency latency_of(std::span<const TimedCommand> commands, std::span<const Sample> seen) {
  if (commands.empty()) return not_told("its log has no commands");
  // All shifts are compared on the same intervals. These end where even the earliest shift,
  // `kLeast_s`, still finds a command; later intervals would favour some shifts.
  const std::vector<SeenInterval> intervals =
      intervals_of(seen, commands.back().time_s + kPeriod_s + kLeast_s);
  if (intervals.size() < kLeastIntervals) {
    return not_told(fmt::format(
        "the camera saw it in {} of frames while its log has commands, and {} are needed",
        counted(intervals.size(), "pair"), kLeastIntervals));
  }
  std::vector<double> speeds;
  std::vector<double> spins;
  for (const TimedCommand& command : commands) {
    speeds.push_back((command.left_mps + command.right_mps) / 2);
    spins.push_back((command.right_mps - command.left_mps) / kTreadDistance_m);
  }
  const bool is_to_turn = sum_of_sizes(spins) * kPeriod_s >= kLeastTurn_rad;
  if (!is_to_turn && sum_of_sizes(speeds) * kPeriod_s < kLeastWay_m) {
    return not_told("its commands did not move it");
  }
  Followed way(commands, std::move(speeds), Seen(intervals, false), kWayLimits);
  Followed turn(commands, std::move(spins), Seen(intervals, true), kTurnLimits);
  // If commands always change at the same phase between frames, a limit and a shift can replace
  // each other, so a limit must improve the fit enough.
  const Shift unlimited = best_shift(way, turn, false);
  const Shift limited = best_shift(way, turn, true);
  const double worth = unlimited.surprise - limited.surprise;
  const bool is_limited = worth > kLeastSurprise;
  way.limit(is_limited);
  turn.limit(is_limited);
  const Shift& best = is_limited ? limited : unlimited;

  Latency latency;
  const Followed& telling = is_to_turn ? turn : way;
  latency.agreement = telling.seen()
                          .fit(telling.response_of(telling.best_limit(best.shift_s)), best.shift_s)
                          .agreement;
  // A shift says nothing about a robot that does not follow its log, so this reason comes before
  // those of the shift.
  if (*latency.agreement < kLeastAgreement) {
    latency.reason = fmt::format(
        "what the camera saw does not follow its commands (agreement "
        "{:.2f}, at least {:g} is needed)",
        *latency.agreement, kLeastAgreement);
    return latency;
  }
  if (best.is_beyond) {
    latency.beyond = true;
    latency.reason = fmt::format(
        "its motion is {:.1f} s or more from its commands; is the start of the run "
        "right?",
        best.shift_s);
    return latency;
  }
  if (!(best.curvature > 0)) {
    latency.reason = "its commands do not change";
    return latency;
  }
  latency.error_s = std::sqrt(
      std::max(1 / best.curvature, sandwich_variance(way, turn, intervals, best.shift_s)));
  if (latency.error_s > kLargestError_s) {
    latency.reason = fmt::format(
        "its commands change too little: it would be known to {:.0f} ms, and {:.0f} "
        "are allowed",
        1000 * latency.error_s, 1000 * kLargestError_s);
    return latency;
  }
  // In this case the time that treads need to reach their speed is unknown, and may be a part of
  // the latency.
  if (!is_limited && worth > kLeastDoubt && !limited.is_beyond)
    latency.error_s = std::hypot(latency.error_s, limited.shift_s - unlimited.shift_s);
  latency.seconds = best.shift_s;
  return latency;
}

}  // namespace swarmsmith
