#include "tracking/robots/slip.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/math.h"
#include "base/plain_text.h"
#include "sim/control/treads.h"
#include "tracking/robots/intervals.h"

namespace swarmsmith {
namespace {

/// Duration of the last command.
constexpr double kPeriod_s = 0.1;
/// Commands that differ by less than this count as equal, m/s.
constexpr double kSame_mps = 0.01;
/// Time that treads need to reach a speed: an RVR accelerates at 0.75 m/s^2, and may reverse from
/// 0.35 m/s.
constexpr double kWaySettles_s = 1.0;
constexpr double kTurnSettles_s = 0.25;
constexpr double kLatencySpread_s = 0.15;
constexpr double kLongestLatency_s = 0.5;
/// Slower motion shows little about slip; turns of straight motion are slower than
/// `kMostSpin_radps`.
constexpr double kLeastSpeed_mps = 0.03;
constexpr double kLeastSpin_radps = 0.3;
constexpr double kMostSpin_radps = 0.3;
constexpr double kBlock_s = 2;
constexpr double kLeastSeconds = 2;
constexpr std::size_t kLeastBlocks = 4;
constexpr double kLargestError = 0.05;

/// Finds periods with constant commands.
class Steady {
 public:
  explicit Steady(std::span<const TimedCommand> commands) : commands_(commands) {}

  /// The mean command of a period, if the command is constant in it. `from_s` must not decrease
  /// from call to call.
  std::optional<TimedCommand> within(double from_s, double to_s) {
    while (first_ + 1 < commands_.size() && commands_[first_ + 1].time_s <= from_s)
      ++first_;
    if (commands_[first_].time_s > from_s || to_s > commands_.back().time_s + kPeriod_s) return {};
    TimedCommand mean;
    std::size_t last = first_;
    for (; last < commands_.size() && commands_[last].time_s < to_s; ++last) {
      const TimedCommand& here = commands_[last];
      if (std::fabs(here.left_mps - commands_[first_].left_mps) > kSame_mps) return {};
      if (std::fabs(here.right_mps - commands_[first_].right_mps) > kSame_mps) return {};
      mean.left_mps += here.left_mps;
      mean.right_mps += here.right_mps;
    }
    const auto count = static_cast<double>(last - first_);
    mean.left_mps /= count;
    mean.right_mps /= count;
    return mean;
  }

 private:
  std::span<const TimedCommand> commands_;
  std::size_t first_ = 0;
};

/// Commanded and seen motion of one kind; seen motion also has a component to the side.
struct Pair {
  double time_s = 0;
  double seconds = 0;
  double told = 0;
  std::array<double, 2> seen{};
};

Gain gain_of(const std::vector<Pair>& pairs, const std::string& what) {
  Gain gain;
  double told = 0;
  std::array<double, 2> both{};
  for (const Pair& pair : pairs) {
    told += pair.told * pair.told;
    both[0] += pair.told * pair.seen[0];
    both[1] += pair.told * pair.seen[1];
    gain.seconds += pair.seconds;
  }
  std::map<std::int64_t, double> blocks;
  if (told > 0) {
    // If the heading is off by a constant angle, a part of the distance ahead appears as distance
    // to the side.
    const double size = both[1] == 0 ? both[0] / told : hypot(both[0], both[1]) / told;
    const double scale = size == 0 ? 0 : 1 / (size * told);
    for (const Pair& pair : pairs) {
      const double along = (pair.seen[0] * both[0] + pair.seen[1] * both[1]) * scale;
      blocks[static_cast<std::int64_t>(std::floor(pair.time_s / kBlock_s))] +=
          pair.told * (along - size * pair.told);
    }
    double squares = 0;
    for (const auto& [block, slope] : blocks)
      squares += slope * slope;
    const auto count = static_cast<double>(blocks.size());
    gain.gain = size;
    gain.is_against = both[0] < 0;
    gain.error = std::sqrt(squares * count / std::max(count - 1, 1.0)) / told;
  }
  const auto not_told = [&](std::string reason) {
    gain.gain.reset();
    gain.reason = std::move(reason);
    return gain;
  };
  if (gain.seconds < kLeastSeconds || blocks.size() < kLeastBlocks) {
    return not_told(fmt::format(
        "it {} steadily and free of walls and other robots for {:.1f} s in {} of the run, "
        "and {:g} s in {} are needed",
        what, gain.seconds, counted(blocks.size(), "place"), kLeastSeconds, kLeastBlocks));
  }
  if (gain.error > kLargestError) {
    return not_told(fmt::format("it would be known to {:.1f} %, and {:g} % are allowed",
                                100 * gain.error, 100 * kLargestError));
  }
  return gain;
}

}  // namespace

Slip slip_of(std::span<const TimedCommand> commands, std::span<const Sample> seen,
             std::optional<double> latency_s, const std::function<bool(double, double)>& is_free) {
  if (commands.empty()) {
    const Gain none{.gain = {}, .error = 0, .seconds = 0, .reason = "its log has no commands"};
    return {none, none};
  }
  const double least_s = latency_s ? *latency_s - kLatencySpread_s : 0;
  const double most_s = latency_s ? *latency_s + kLatencySpread_s : kLongestLatency_s;
  Steady of_way(commands);
  Steady of_turn(commands);
  std::vector<Pair> ways;
  std::vector<Pair> turns;
  auto intervals = intervals_of(seen, commands.back().time_s + kPeriod_s + most_s);
  std::ranges::sort(intervals, {}, &SeenInterval::from_s);  // the intervals of several cameras
  for (const SeenInterval& interval : intervals) {
    const double seconds = interval.to_s - interval.from_s;
    const auto told_of = [&](Steady& steady, double settles_s) {
      return steady.within(interval.from_s - most_s - settles_s, interval.to_s - least_s);
    };
    const auto way = told_of(of_way, kWaySettles_s);
    const auto turn = told_of(of_turn, kTurnSettles_s);
    if ((!way && !turn) || !is_free(interval.from_s, interval.to_s)) continue;
    if (way) {
      const double speed = (way->left_mps + way->right_mps) / 2;
      const double spin = (way->right_mps - way->left_mps) / kTreadDistance_m;
      if (std::fabs(speed) >= kLeastSpeed_mps && std::fabs(spin) <= kMostSpin_radps) {
        ways.push_back(
            {interval.to_s, seconds, speed * seconds, {interval.ahead_m, interval.aside_m}});
      }
    }
    if (turn) {
      const double spin = (turn->right_mps - turn->left_mps) / kTreadDistance_m;
      if (std::fabs(spin) >= kLeastSpin_radps)
        turns.push_back({interval.to_s, seconds, spin * seconds, {interval.turn_rad, 0}});
    }
  }
  return {gain_of(ways, "drove straight"), gain_of(turns, "turned")};
}

}  // namespace swarmsmith
