#include "robot/runtime/scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>

#include "base/math.h"

namespace swarmsmith {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A scan of a room in which the distance depends on the angle from the robot's head alone. The
/// lidar's zero is `turn_rad` from the head.
double distance_at(double angle_rad) {
  return 2 + std::cos(angle_rad - 0.3);
}

ScanMessage scan_of(std::size_t values, double first_rad, double increment_rad, double turn_rad) {
  ScanMessage scan{.angle_min_rad = first_rad,
                   .angle_max_rad = first_rad + static_cast<double>(values - 1) * increment_rad,
                   .angle_increment_rad = increment_rad,
                   .range_min_m = 0.1,
                   .range_max_m = 12};
  for (std::size_t i = 0; i < values; ++i)
    scan.ranges_m.push_back(
        distance_at(first_rad + static_cast<double>(i) * increment_rad + turn_rad));
  return scan;
}

/// The largest difference from what is there, and how many rays met nothing.
struct Misses {
  double most_m = 0;
  int nothing = 0;
};

Misses misses(const ScanMessage& scan, double turn_rad) {
  RayRanges rays{};
  EXPECT_EQ(resample(scan, turn_rad, rays), std::nullopt);
  Misses found;
  for (int ray = 0; ray < kLidarRays; ++ray) {
    const double range = rays[static_cast<std::size_t>(ray)];
    if (std::isinf(range)) {
      ++found.nothing;
    } else {
      found.most_m =
          std::fmax(found.most_m, std::fabs(range - distance_at(2 * kPi * ray / kLidarRays)));
    }
  }
  return found;
}

TEST(Scan, OfAnyLengthCoversAllRaysToHalfAnIncrement) {
  for (const std::size_t values : {100U, 360U, 500U, 719U, 720U, 1440U, 2000U}) {
    const double increment = 2 * kPi / static_cast<double>(values);
    for (const double first : {0.0, -kPi, 1.0}) {
      for (const double turn : {0.0, kPi, -1.3}) {
        for (const double direction : {1.0, -1.0}) {
          const Misses found = misses(scan_of(values, first, direction * increment, turn), turn);
          EXPECT_EQ(found.nothing, 0) << values << " " << first << " " << turn;
          EXPECT_LE(found.most_m, 0.51 * increment) << values << " " << first << " " << turn;
        }
      }
    }
  }
}

TEST(Scan, OfOurOwnRaysKeepsEachValue) {
  ScanMessage scan = scan_of(kLidarRays, 0, 2 * kPi / kLidarRays, 0);
  RayRanges rays{};
  ASSERT_EQ(resample(scan, 0, rays), std::nullopt);
  for (std::size_t i = 0; i < kLidarRays; ++i)
    EXPECT_EQ(rays[i], scan.ranges_m[i]) << i;
  // also when angles went as float32
  scan.angle_increment_rad = static_cast<float>(scan.angle_increment_rad);
  ASSERT_EQ(resample(scan, 0, rays), std::nullopt);
  for (std::size_t i = 0; i < kLidarRays; ++i)
    EXPECT_EQ(rays[i], scan.ranges_m[i]) << i;
}

TEST(Scan, ThatIndexesFromBehindIsReadByItsAngles) {  // as the published driver does
  ScanMessage scan = scan_of(720, -kPi, 2 * kPi / 719, 0);
  EXPECT_EQ(misses(scan, 0).nothing, 0);
  EXPECT_LE(misses(scan, 0).most_m, 0.51 * 2 * kPi / 719);
}

TEST(Scan, ThatLooksAheadAloneMeetsNothingBehind) {
  const ScanMessage scan = scan_of(181, -kPi / 2, kPi / 180, 0);
  RayRanges rays{};
  ASSERT_EQ(resample(scan, 0, rays), std::nullopt);
  EXPECT_FALSE(std::isinf(rays[0]));
  EXPECT_TRUE(std::isinf(rays[kLidarRays / 2]));
  EXPECT_NEAR(misses(scan, 0).nothing, kLidarRays / 2, 3);
}

TEST(Scan, TakesWhatIsNoReturnAsNothing) {
  ScanMessage scan = scan_of(kLidarRays, 0, 2 * kPi / kLidarRays, 0);
  scan.ranges_m[1] = 0;
  scan.ranges_m[2] = std::nan("");
  scan.ranges_m[3] = 0.05;
  scan.ranges_m[4] = 13;
  scan.ranges_m[5] = -kInfinity;
  scan.ranges_m[6] = kInfinity;
  RayRanges rays{};
  ASSERT_EQ(resample(scan, 0, rays), std::nullopt);
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_EQ(std::isinf(rays[i]) && rays[i] > 0, i >= 1 && i <= 6) << i;
}

TEST(Scan, WithoutASenseIsRefused) {
  const auto refusal = [](const auto& change) {
    RayRanges rays{};
    ScanMessage scan = scan_of(10, 0, 0.1, 0);
    change(scan);
    return resample(scan, 0, rays).value_or("");
  };
  EXPECT_EQ(refusal([](ScanMessage& of) { of.ranges_m.clear(); }), "a scan without values");
  const auto by_increment = [&refusal](double increment) {
    return refusal([increment](ScanMessage& of) { of.angle_increment_rad = increment; });
  };
  const std::string step = "a scan with an angle_increment of ";
  EXPECT_EQ(by_increment(0), step + "0.000000 rad");
  EXPECT_EQ(by_increment(std::nan("")), step + "nan rad");
  EXPECT_EQ(by_increment(-1e-5), step + "-0.000010 rad");
  EXPECT_EQ(by_increment(1.1e-5), "");
  EXPECT_EQ(by_increment(-0.99), "");
  EXPECT_EQ(by_increment(1), step + "1.000000 rad");
  EXPECT_EQ(by_increment(-4), step + "-4.000000 rad");
  const auto by_first = [&refusal](double first) {
    return refusal([first](ScanMessage& of) { of.angle_min_rad = first; });
  };
  EXPECT_EQ(by_first(1e6), "");
  EXPECT_EQ(by_first(-1e6), "");
  EXPECT_EQ(by_first(1.01e6), "a scan whose angle_min is too large for an angle");
  EXPECT_EQ(by_first(-1e300), "a scan whose angle_min is too large for an angle");
  EXPECT_EQ(by_first(kInfinity), "a scan whose angle_min is not a number");
  EXPECT_EQ(by_first(std::nan("")), "a scan whose angle_min is not a number");
}

TEST(Scan, HasRangesWithinItsLimits) {
  ScanMessage scan = scan_of(kLidarRays, 0, 2 * kPi / kLidarRays, 0);
  scan.range_min_m = 0.5;
  scan.range_max_m = 4;
  scan.ranges_m[0] = 0.5;
  scan.ranges_m[1] = 0.49;
  scan.ranges_m[2] = 4;
  scan.ranges_m[3] = 4.01;
  RayRanges rays{};
  ASSERT_EQ(resample(scan, 0, rays), std::nullopt);
  EXPECT_EQ(rays[0], 0.5);
  EXPECT_EQ(rays[1], kInfinity);
  EXPECT_EQ(rays[2], 4);
  EXPECT_EQ(rays[3], kInfinity);
  scan.range_min_m = 0;
  scan.ranges_m[1] = 0;
  ASSERT_EQ(resample(scan, 0, rays), std::nullopt);
  EXPECT_EQ(rays[1], kInfinity) << "0 means no return";
}

/// The value nearest to a ray, among all values of several turns.
TEST(Scan, OfMoreThanOneTurnGivesTheNearestValue) {
  for (const double increment : {0.0131, -0.0131, 0.0377}) {
    for (const double turns : {0.3, 1.4, 2.6}) {
      const auto values = static_cast<std::size_t>(turns * 2 * kPi / std::fabs(increment));
      ScanMessage scan = scan_of(values, 0.71, increment, 0);
      for (std::size_t i = 0; i < values; ++i)
        scan.ranges_m[i] = 0.5 + 0.001 * static_cast<double>(i);
      RayRanges rays{};
      ASSERT_EQ(resample(scan, 0, rays), std::nullopt);
      for (int ray = 0; ray < kLidarRays; ++ray) {
        double least = 0.5 * std::fabs(increment);
        double wanted = kInfinity;
        for (std::size_t i = 0; i < values; ++i) {
          const double away = std::fabs(std::remainder(
              0.71 + static_cast<double>(i) * increment - 2 * kPi * ray / kLidarRays, 2 * kPi));
          if (away >= least) continue;
          least = away;
          wanted = scan.ranges_m[i];
        }
        EXPECT_EQ(rays[static_cast<std::size_t>(ray)], wanted) << increment << turns << ray;
      }
    }
  }
}

TEST(Scan, OfTwoTurnsGivesTheEarlierOfTwoEqualDistances) {
  constexpr std::size_t kValues = 8;
  ScanMessage scan = scan_of(2 * kValues, 0, 2 * kPi / kValues, 0);
  scan.ranges_m.assign(kValues, 1);
  scan.ranges_m.resize(2 * kValues, 2);
  RayRanges rays{};
  ASSERT_EQ(resample(scan, 0, rays), std::nullopt);
  EXPECT_EQ(rays[0], 1);  // the angles of other rays are rounded
}

}  // namespace
}  // namespace swarmsmith
