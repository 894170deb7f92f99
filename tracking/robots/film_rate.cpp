#include "tracking/robots/film_rate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/math.h"
#include "sim/control/treads.h"

namespace swarmsmith {
namespace {

constexpr double kPeriod_s = 0.1;
constexpr double kTable_s = 0.02;
constexpr double kLongestGap_s = 0.25;
constexpr double kLeastRate = 0.5;
constexpr double kMostRate = 2.0;
constexpr double kLeastShift_s = -0.2;
constexpr double kMostShift_s = 0.8;
/// Difference of log-likelihoods that counts as "far likelier".
constexpr double kFarLikelier = 20;
constexpr double kLeastCorrelation = 0.5;
/// Errors of sample pairs closer in time than this are correlated.
constexpr double kIndependent_s = 0.5;

/// The integral of a commanded speed until a time.
class Told {
 public:
  Told(const std::vector<TimedCommand>& commands, bool is_turn)
      : begin_s_(commands.front().time_s) {
    const double end_s = commands.back().time_s + kPeriod_s;
    std::size_t at = 0;
    double way = 0;
    for (double time = begin_s_; time < end_s; time += kTable_s) {
      while (at + 1 < commands.size() && commands[at + 1].time_s <= time)
        ++at;
      ways_.push_back(way);
      const TimedCommand& told = commands[at];
      way += kTable_s * (is_turn ? (told.right_mps - told.left_mps) / kTreadDistance_m
                                 : (told.right_mps + told.left_mps) / 2);
    }
    ways_.push_back(way);
  }

  double until(double time_s) const {
    const double place = (time_s - begin_s_) / kTable_s;
    if (place <= 0) return 0;
    if (place >= static_cast<double>(ways_.size() - 1)) return ways_.back();
    const auto i = static_cast<std::size_t>(place);
    return ways_[i] + (place - static_cast<double>(i)) * (ways_[i + 1] - ways_[i]);
  }

 private:
  double begin_s_;
  std::vector<double> ways_;
};

struct Interval {
  double from_s = 0;
  double to_s = 0;
  double ahead_m = 0;
  double turn_rad = 0;
};

std::vector<Interval> intervals_of(std::span<const Sample> seen) {
  std::vector<Interval> intervals;
  std::map<int, const Sample*> last;
  for (const Sample& sample : seen) {
    if (sample.use != Sample::Use::Used || sample.time_s < 0) continue;
    const Sample* const before = last[sample.camera];
    // Take samples about a cycle apart, so that a film with many frames costs no more.
    if (before != nullptr && sample.time_s - before->time_s < 0.9 * kPeriod_s) continue;
    last[sample.camera] = &sample;
    if (before == nullptr || sample.time_s - before->time_s > kLongestGap_s) continue;
    const double turn = wrap_angle(sample.pose.theta - before->pose.theta);
    const SinCos heading = sin_cos(before->pose.theta + turn / 2);
    intervals.push_back({before->time_s, sample.time_s,
                         (sample.pose.x - before->pose.x) * heading.cos +
                             (sample.pose.y - before->pose.y) * heading.sin,
                         turn});
  }
  return intervals;
}

struct LoggedRobot {
  std::vector<Interval> seen;
  Told way;
  Told turn;
};

/// The log-likelihood of a stretch and shift, up to a constant, and the correlation.
struct Fit {
  double likelihood = 0;
  double correlation = 0;
};

Fit fit_of(const std::vector<LoggedRobot>& robots, double rate, double shift_s) {
  std::array<double, 2> told{};
  std::array<double, 2> seen{};
  std::array<double, 2> both{};
  double count = 0;
  double length = 0;
  for (const LoggedRobot& robot : robots) {
    for (const Interval& one : robot.seen) {
      const double from = rate * one.from_s - shift_s;
      const double to = rate * one.to_s - shift_s;
      const double way = robot.way.until(to) - robot.way.until(from);
      const double turn = robot.turn.until(to) - robot.turn.until(from);
      told[0] += way * way;
      told[1] += turn * turn;
      seen[0] += one.ahead_m * one.ahead_m;
      seen[1] += one.turn_rad * one.turn_rad;
      both[0] += way * one.ahead_m;
      both[1] += turn * one.turn_rad;
      length += one.to_s - one.from_s;
    }
  }
  // The likelihood counts independent pairs, not all; otherwise a film with many frames would be
  // too sure of its rate.
  count = length / kIndependent_s;
  Fit fit;
  for (std::size_t i = 0; i < told.size(); ++i) {
    if (!(told.at(i) > 0 && seen.at(i) > 0)) continue;
    const double correlation = both.at(i) / std::sqrt(told.at(i) * seen.at(i));
    fit.correlation = std::max(fit.correlation, correlation);
    // 1 - r^2 is the share of the motion that the commands do not explain. A negative r is worse
    // than none, because no robot drives against its own commands.
    const double left = std::max(1 - correlation * std::fabs(correlation), 1e-4);
    fit.likelihood -= count / 2 * std::log(left);
  }
  return fit;
}

struct Best {
  double rate = 1;
  Fit fit;
};

/// The best fit at one rate, over all shifts.
Fit best_fit(const std::vector<LoggedRobot>& robots, double rate, double start_s) {
  Fit best{-1e300, 0};
  const double stretched_s = (1 - rate) * start_s;
  for (double shift = kLeastShift_s; shift < kMostShift_s + kTable_s; shift += kPeriod_s) {
    for (const double whole_shift : {shift, shift + stretched_s}) {
      const Fit fit = fit_of(robots, rate, whole_shift);
      if (fit.likelihood > best.likelihood) best = fit;
      if (std::fabs(stretched_s) < kTable_s) break;
    }
  }
  return best;
}

Best best_of(const std::vector<LoggedRobot>& robots, double start_s, double least, double most,
             double step) {
  Best best{1, {-1e300, 0}};
  for (double rate = least; rate <= most; rate *= 1 + step) {
    const Fit fit = best_fit(robots, rate, start_s);
    if (fit.likelihood > best.fit.likelihood) best = {rate, fit};
  }
  return best;
}

}  // namespace

FilmRate film_rate(std::span<const ToldAndSeen> all, double start_s) {
  constexpr std::size_t kLeastIntervals = 50;
  std::vector<LoggedRobot> robots;
  FilmRate found;
  double end_s = 0;
  for (const ToldAndSeen& one : all) {
    if (one.commands.empty()) continue;
    LoggedRobot robot{intervals_of(one.seen), Told(one.commands, false), Told(one.commands, true)};
    if (robot.seen.size() < kLeastIntervals) continue;
    end_s = std::max(end_s, one.commands.back().time_s);
    robots.push_back(std::move(robot));
  }
  if (robots.empty()) {
    found.reason = "no robot's log has commands while the camera saw it";
    return found;
  }
  // With this step, two neighbouring rates differ by less than a cycle at the end of the run.
  const double step = std::clamp(kPeriod_s / std::max(end_s, 1.0), 0.001, 0.005);
  const Best coarse = best_of(robots, start_s, kLeastRate, kMostRate, step);
  const Best best =
      best_of(robots, start_s, coarse.rate * (1 - step), coarse.rate * (1 + step), step / 5);
  if (best.fit.correlation < kLeastCorrelation) {
    found.reason = "robots did not move as their logs command, at no speed of the film";
    return found;
  }
  // A rate far from 1 may be less precise: it is compared with rates half way to 1, and must also
  // be far likelier than 1.
  constexpr double kAside = 0.01;
  const double away = std::max(kAside, std::fabs(best.rate - 1) / 2);
  double aside = std::max(best_fit(robots, best.rate * (1 + away), start_s).likelihood,
                          best_fit(robots, best.rate * (1 - away), start_s).likelihood);
  if (away > kAside) aside = std::max(aside, best_fit(robots, 1, start_s).likelihood);
  if (best.fit.likelihood - aside < kFarLikelier) {
    found.reason = "commands change too little";
    return found;
  }
  found.rate = best.rate;
  found.off_s = std::fabs(best.rate - 1) * end_s / best.rate;
  return found;
}

}  // namespace swarmsmith
