#include "sim/assessment/internal/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "base/math.h"
#include "sim/assessment/internal/statistics.h"

namespace swarmsmith::assessment {
namespace {

constexpr double kBeta = 0.3;
constexpr double kEta = 5;
constexpr int kXi = 1;

struct Tally {
  std::int64_t trials = 0;
  std::int64_t firings = 0;
  double expected = 0;  ///< expected number of firings
};

Rate rate_of(std::string setting, const Tally& tally, double expected) {
  const Interval interval = wilson_interval(tally.firings, tally.trials);
  return {.setting = std::move(setting),
          .trials = tally.trials,
          .firings = tally.firings,
          .expected = expected,
          .low = interval.low,
          .high = interval.high};
}

/// Eq. 5.7 of the thesis; with unsigned counts a negative xi - n becomes a huge number.
double sigmoid(int neighbours, bool unsigned_count) {
  if (unsigned_count && neighbours > kXi) return 0;
  return 1 / (1 + exp(kEta * (kXi - neighbours)));
}

}  // namespace

std::vector<Rate> rates_of(const ConditionTest& test, const Subject& subject) {
  const Flavour& flavour = subject.flavour;
  const Condition condition =
      make_condition(test, *flavour.find(test.module), {.beta = kBeta, .eta = kEta, .xi = kXi});
  const Machine machine{
      {{Exploration{kTau}, {{condition, 1}}}, {Exploration{kTau}, {{condition, 0}}}}};
  const bool counts = is_of_neighbours(test);
  std::array<Tally, kRobots> tallies{};  // by number of neighbours; for other conditions only the
                                         // first is used
  for_each_cycle(test, machine, subject, [&](const ObservedCycle& cycle) {
    const Readings& readings = *cycle.record.readings;
    if (!cycle.tested) return;
    const double probability = due_probability(test, condition, kBeta, readings, flavour);
    if (probability == 0) return;
    const std::size_t neighbours = counts ? static_cast<std::size_t>(readings.neighbour_count) : 0;
    if (neighbours >= tallies.size())
      return;  // a lidar may report more neighbours than there are
               // robots
    ++tallies[neighbours].trials;
    tallies[neighbours].firings += cycle.fired ? 1 : 0;
    tallies[neighbours].expected += probability;
  });
  if (test.trigger == Trigger::Readings) {
    const Tally& tally = tallies[0];
    const auto trials = static_cast<double>(std::max<std::int64_t>(1, tally.trials));
    return {rate_of(test.floor, tally, tally.expected / trials)};
  }
  if (!counts) return {rate_of(fmt::format("{}, p = {}", test.floor, kBeta), tallies[0], kBeta)};
  std::vector<Rate> rates;
  for (int n = 0; n < kRobots; ++n) {
    const double z = sigmoid(n, flavour.neighbours.unsigned_count);
    rates.push_back(rate_of(fmt::format("eta = {}, xi = {}, n = {}", kEta, kXi, n),
                            tallies[static_cast<std::size_t>(n)],
                            test.trigger == Trigger::Neighbours ? z : 1 - z));
  }
  return rates;
}

}  // namespace swarmsmith::assessment
