#include "sim/engine/internal/proximity_noise.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "base/math.h"
#include "tests/sim/engine/statistics.h"

namespace swarmsmith {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// All sensors at this distance, for so many cycles.
std::vector<double> readings_of(const ProximitySensing& sensing, double distance, int cycles,
                                std::uint64_t seed = 1, std::size_t sensors = kProximitySensors) {
  const ProximityNoise noise(sensing, Rng(seed), 0, sensors);
  std::vector<double> all;
  for (int cycle = 1; cycle <= cycles; ++cycle) {
    std::vector<double> readings(sensors, distance);
    noise.apply(readings, cycle);
    all.insert(all.end(), readings.begin(), readings.end());
  }
  return all;
}

TEST(ProximityNoise, WithoutFaultsThereAreOnlyTheLimits) {
  const ProximitySensing sensing;
  EXPECT_EQ(readings_of(sensing, 0.3, 1)[0], 0.3);
  EXPECT_EQ(readings_of(sensing, 0.0499, 1)[0], -kInfinity);
  EXPECT_EQ(readings_of(sensing, 0.4001, 1)[0], kInfinity);
}

TEST(ProximityNoise, IsNormal) {
  const std::vector<double> all = readings_of({.sd_m = 0.01}, 0.2, 2000);
  EXPECT_LT(ks_statistic(all, [](double x) { return normal_cdf((x - 0.2) / 0.01); }), kKsLimit);
}

TEST(ProximityNoise, ScalesWithTheDistance) {
  // Times N(1, 0.1) plus N(0, 0.01): of 0.2 m the standard deviation is sqrt(0.02^2 + 0.01^2).
  const double sd = std::sqrt(0.0005);
  const std::vector<double> all = readings_of({.sd_m = 0.01, .scale_sd = 0.1}, 0.2, 2000);
  EXPECT_LT(ks_statistic(all, [&](double x) { return normal_cdf((x - 0.2) / sd); }), kKsLimit);
}

TEST(ProximityNoise, MissesEachSensorAtARateOfItsOwn) {
  const ProximitySensing sensing = {.largest_miss_rate = 0.2};
  constexpr int kCycles = 5000;
  std::vector<double> rates;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const std::vector<double> all = readings_of(sensing, 0.2, kCycles, seed);
    std::array<int, kProximitySensors> missed{};
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i] == 0.2) continue;
      ASSERT_EQ(all[i], kInfinity);
      ++missed.at(i % kProximitySensors);
    }
    for (const int count : missed)
      rates.push_back(static_cast<double>(count) / kCycles);
  }
  // Counting blurs the rates by 0.006 at most.
  EXPECT_LT(ks_statistic(rates, [](double x) { return std::fmin(x / 0.2, 1); }), kKsLimit);
}

TEST(ProximityNoise, OfEachOf24SensorsIsItsOwn) {
  const std::vector<double> normal = readings_of({.sd_m = 0.01}, 0.2, 2, 1, 24);
  EXPECT_EQ(std::set(normal.begin(), normal.end()).size(), 48U) << "in two cycles";
  const std::vector<double> all = readings_of({.largest_miss_rate = 0.2}, 0.2, 2000, 1, 24);
  std::array<int, 24> missed{};
  for (std::size_t i = 0; i < all.size(); ++i)
    missed.at(i % 24) += all[i] == kInfinity ? 1 : 0;
  EXPECT_GT(std::set(missed.begin(), missed.end()).size(), 15U) << "each has a rate of its own";
}

TEST(ProximityNoise, AMissedHitIsOneOfTheBlindZoneToo) {
  const std::vector<double> all = readings_of({.largest_miss_rate = 0.2}, 0.01, 1000);
  int missed = 0;
  for (const double reading : all) {
    EXPECT_TRUE(std::isinf(reading));
    missed += reading > 0 ? 1 : 0;
  }
  EXPECT_GT(missed, 0);
  EXPECT_LT(missed, 2000);
}

TEST(ProximityNoise, InventsObstaclesWhateverIsThere) {
  const ProximitySensing sensing = {.range_m = 0.4, .phantom_rate = 0.005};
  std::vector<double> phantoms;
  for (const double truth : {0.2, kInfinity, 0.01}) {
    int invented = 0;
    const double real = limited(truth, 0.4);
    for (const double reading : readings_of(sensing, truth, 10'000)) {
      if (reading == real) continue;
      ++invented;
      phantoms.push_back(reading);
    }
    EXPECT_LT(std::fabs(binomial_z(invented, 80'000, 0.005)), 3.3);
  }
  phantoms.resize(phantoms.size() / 3);  // the same in all three, being of the same cycles
  EXPECT_LT(ks_statistic(phantoms, [](double x) { return (x - 0.05) / 0.35; }), kKsLimit);
}

TEST(ProximityNoise, EachKindIsDrawnWhetherOthersAreOnOrOff) {
  // Of the profile with everything on, the readings that are neither phantoms nor missed are those
  // of the profile with normal noise alone.
  const std::vector<double> plain = readings_of({.sd_m = 0.01}, 0.2, 1000);
  const std::vector<double> faulty =
      readings_of({.sd_m = 0.01, .largest_miss_rate = 0.2, .phantom_rate = 0.005}, 0.2, 1000);
  int differ = 0;
  for (std::size_t i = 0; i < plain.size(); ++i)
    differ += plain[i] == faulty[i] ? 0 : 1;
  EXPECT_GT(differ, 100);
  EXPECT_LT(differ, 1700);
}

}  // namespace
}  // namespace swarmsmith
