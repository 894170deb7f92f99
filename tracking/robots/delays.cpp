#include "tracking/robots/delays.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/math.h"
#include "sim/control/treads.h"

namespace swarmsmith {
namespace {

/// Values of the simulator: the RVR's drive (1.5 Nm on 0.0273 kg m^2), and half of a simulation
/// step.
constexpr double kSpinRate_radps2 = 55.0;
constexpr double kHalfStep_s = 0.005;
/// Smallest change of the rotation speed that is measured, and largest difference of equal speeds.
constexpr double kLeastChange_radps = 1.5;
constexpr double kSame_radps = 0.1;
/// Commands must be steady for this long before and after the change, plus the latency.
constexpr double kBefore_s = 0.4;
constexpr double kAfter_s = 0.6;
constexpr double kLongestGap_s = 0.25;
/// Assumed if the latency is unknown.
constexpr double kLongestLatency_s = 0.5;

constexpr double kStep_s = 0.01;
constexpr double kLeastProbability = 0.01;
/// A step of the distribution must be this many standard errors higher than the step before it.
constexpr double kLeastRise = 3;

double spin_of(const TimedCommand& command) {
  return (command.right_mps - command.left_mps) / kTreadDistance_m;
}

/// The samples of the camera that has the most samples.
std::vector<Sample> best_seen(std::span<const Sample> seen) {
  std::map<int, int> counts;
  for (const Sample& sample : seen)
    if (sample.use == Sample::Use::Used) ++counts[sample.camera];
  std::vector<Sample> best;
  if (counts.empty()) return best;
  const int camera =
      std::ranges::max_element(counts, {}, [](const auto& one) { return one.second; })->first;
  for (const Sample& sample : seen)
    if (sample.use == Sample::Use::Used && sample.camera == camera) best.push_back(sample);
  return best;
}

/// The angle turned between the first and the last sample; nothing if there is a gap between them.
std::optional<double> turned(std::span<const Sample> samples) {
  double sum = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (samples[i].time_s - samples[i - 1].time_s > kLongestGap_s) return std::nullopt;
    sum += wrap_angle(samples[i].pose.theta - samples[i - 1].pose.theta);
  }
  return sum;
}

/// Whether all commands from `first` until `until_s` turn as fast as `first` does.
bool is_steady(std::span<const TimedCommand> commands, std::size_t first, double until_s) {
  for (std::size_t i = first; i < commands.size() && commands[i].time_s < until_s; ++i)
    if (std::fabs(spin_of(commands[i]) - spin_of(commands[first])) > kSame_radps) return false;
  return true;
}

/// A level of the distribution: from this step on, `had` of those `of` commands had acted whose
/// successors had acted.
struct Level {
  int step = 0;
  double had = 0;
  double of = 0;

  double arrived() const { return of > 0 ? had / of : 0; }
};

/// The height of the second level above the first, in standard errors.
double rise(const Level& low, const Level& high) {
  if (low.of <= 0 || high.of <= 0) return low.of <= 0 && high.had > 0 ? kLeastRise : 0;
  const double both = (low.had + high.had + 0.5) / (low.of + high.of + 1);
  return (high.arrived() - low.arrived()) /
         std::sqrt(both * (1 - both) * (1 / low.of + 1 / high.of));
}

/// Joins neighbouring levels, the most similar first, until every level is clearly higher than the
/// one before: a distribution never falls, and chance splits a large step into many small ones.
void join_levels(std::vector<Level>& levels) {
  while (levels.size() > 1) {
    std::size_t least = 1;
    for (std::size_t i = 2; i < levels.size(); ++i) {
      if (rise(levels[i - 1], levels[i]) < rise(levels[least - 1], levels[least])) least = i;
    }
    if (rise(levels[least - 1], levels[least]) >= kLeastRise) return;
    levels[least - 1].had += levels[least].had;
    levels[least - 1].of += levels[least].of;
    levels.erase(levels.begin() + static_cast<std::ptrdiff_t>(least));
  }
}

}  // namespace

std::vector<double> delays_of(std::span<const TimedCommand> commands, std::span<const Sample> seen,
                              std::optional<double> latency_s, double turn_gain,
                              const std::function<bool(double, double)>& is_free) {
  std::vector<double> delays;
  const std::vector<Sample> samples = best_seen(seen);
  const double known_s = std::max(latency_s.value_or(kLongestLatency_s), 0.0);
  const double before_s = known_s + kBefore_s;
  const double after_s = known_s + kAfter_s;
  std::size_t first = 0;  // first of the commands that turn as fast as the last one
  for (std::size_t i = 1; i < commands.size(); ++i) {
    const double change = spin_of(commands[i]) - spin_of(commands[first]);
    if (std::fabs(change) <= kSame_radps) continue;
    const double since_s = commands[first].time_s;
    const double old = turn_gain * spin_of(commands[first]);
    const double now_s = commands[i].time_s;
    first = i;
    if (std::fabs(change) < kLeastChange_radps || now_s - since_s < before_s) continue;
    if (commands.back().time_s < now_s + after_s || !is_steady(commands, i, now_s + after_s))
      continue;
    const auto from = std::ranges::upper_bound(samples, now_s, {}, &Sample::time_s);
    const auto to = std::ranges::lower_bound(samples, now_s + after_s, {}, &Sample::time_s);
    if (from == samples.begin() || to == samples.end()) continue;
    const Sample& begin = *std::prev(from);
    if (now_s - begin.time_s > kLongestGap_s || !is_free(begin.time_s, to->time_s)) continue;
    const auto angle = turned({std::prev(from), std::next(to)});
    if (!angle) continue;
    const double wanted = turn_gain * spin_of(commands[i]);
    const double late_s =
        (wanted * (to->time_s - now_s) + old * (now_s - begin.time_s) - *angle) / (wanted - old);
    delays.push_back(late_s - std::fabs(wanted - old) / (2 * kSpinRate_radps2) - kHalfStep_s);
  }
  return delays;
}

std::vector<DrawnDelay> drawn_delays(std::vector<double> acted_s, double period_s) {
  std::vector<DrawnDelay> drawn;
  if (acted_s.empty()) return drawn;
  std::ranges::sort(acted_s);
  const auto acted = [&](double seconds) {
    const auto end = std::ranges::upper_bound(acted_s, seconds + kStep_s / 2);
    return static_cast<double>(end - acted_s.begin());
  };
  std::vector<Level> levels;
  const int last = std::max(0, static_cast<int>(std::ceil(acted_s.back() / kStep_s)));
  for (int step = 0; step <= last; ++step) {
    // Steps within one period count the same commands.
    const double share = kStep_s / period_s;
    levels.push_back(
        {step, share * acted(step * kStep_s), share * acted(step * kStep_s + period_s)});
  }
  join_levels(levels);
  double before = 0;
  for (const Level& level : levels) {
    if (level.arrived() - before < kLeastProbability) continue;
    drawn.push_back({level.step * kStep_s, level.arrived() - before});
    before = level.arrived();
  }
  for (DrawnDelay& delay : drawn)
    delay.probability /= before;
  return drawn;
}

}  // namespace swarmsmith
