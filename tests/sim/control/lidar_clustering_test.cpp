#include "sim/control/lidar_clustering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/math.h"

namespace swarmsmith {
namespace {

constexpr double kSpacing = 2 * kPi / kLidarRays;

/// A scan that a test fills; ray -1 is the last one.
struct Scan {
  std::vector<double> ranges =
      std::vector<double>(kLidarRays, std::numeric_limits<double>::infinity());

  Scan& set(int first, int last, double range) {
    for (int ray = first; ray <= last; ++ray)
      ranges.at(static_cast<std::size_t>((ray + kLidarRays) % kLidarRays)) = range;
    return *this;
  }
  std::vector<Neighbour> neighbours() const {
    std::vector<Neighbour> found = {Neighbour{}};  // what was there goes
    cluster_lidar(ranges, found);
    return found;
  }
};

void expect_at(const Neighbour& neighbour, double distance, double ray) {
  EXPECT_NEAR(neighbour.distance_m, distance, 1e-12);
  EXPECT_NEAR(neighbour.direction_x, std::cos(ray * kSpacing), 1e-12);
  EXPECT_NEAR(neighbour.direction_y, std::sin(ray * kSpacing), 1e-12);
}

TEST(LidarClustering, AnEmptyScanHasNoNeighbours) {
  EXPECT_TRUE(Scan().neighbours().empty());
  EXPECT_TRUE(Scan().set(0, 718, -std::numeric_limits<double>::infinity()).neighbours().empty());
}

TEST(LidarClustering, ARobotIsTheMeanOfItsPoints) {
  const auto found = Scan()
                         .set(100, 102, 0.50)
                         .set(103, 104, 0.51)
                         .set(105, 107, 0.50)
                         .set(300, 309, 0.3)
                         .neighbours();
  ASSERT_EQ(found.size(), 2);
  expect_at(found[0], (6 * 0.50 + 2 * 0.51) / 8, 103.5);
  expect_at(found[1], 0.3, 304.5);
}

TEST(LidarClustering, ClustersOfFewerThanFivePointsAreDropped) {
  EXPECT_EQ(Scan().set(100, 103, 0.5).neighbours().size(), 0);
  EXPECT_EQ(Scan().set(100, 104, 0.5).neighbours().size(), 1);
}

TEST(LidarClustering, ReadingsOutOfBoundsAreDropped) {
  EXPECT_EQ(Scan().set(100, 109, 0.0999).neighbours().size(), 0);
  EXPECT_EQ(Scan().set(100, 109, 0.10).neighbours().size(), 1);
  EXPECT_EQ(Scan().set(100, 109, 0.75).neighbours().size(), 1);
  EXPECT_EQ(Scan().set(100, 109, 0.7501).neighbours().size(), 0);
}

TEST(LidarClustering, AJumpOfTwoCentimetresIsAnotherRobot) {
  EXPECT_EQ(Scan().set(100, 104, 0.5).set(105, 109, 0.5199).neighbours().size(), 1);
  EXPECT_EQ(Scan().set(100, 104, 0.5).set(105, 109, 0.5201).neighbours().size(), 2);
}

TEST(LidarClustering, ComparesWithTheReadingBeforeNotWithTheFirst) {
  Scan scan;
  for (int i = 0; i < 20; ++i)
    scan.set(100 + i, 100 + i, 0.3 + 0.015 * i);
  EXPECT_EQ(scan.neighbours().size(), 1);
}

TEST(LidarClustering, TheReadingBeforeIsTheOneThatWasKept) {
  // 19 rays are 9.51 degrees, 20 are 10.01; between them nothing was in range.
  const auto near = Scan().set(100, 104, 0.5).set(123, 127, 0.5).neighbours();
  ASSERT_EQ(near.size(), 1);
  expect_at(near[0], 0.5, 113.5);
  EXPECT_EQ(Scan().set(100, 104, 0.5).set(124, 128, 0.5).neighbours().size(), 2);
}

TEST(LidarClustering, ARobotAcrossTheSeamIsOne) {
  // Neither half would have five points.
  const auto found = Scan().set(-4, 3, 0.5).set(200, 210, 0.6).neighbours();
  ASSERT_EQ(found.size(), 2);
  expect_at(found[0], 0.5, -0.5);
  expect_at(found[1], 0.6, 205);
}

TEST(LidarClustering, TheSeamHasTheSameThresholds) {
  EXPECT_EQ(Scan().set(-5, -1, 0.5).set(0, 4, 0.5199).neighbours().size(), 1);
  EXPECT_EQ(Scan().set(-5, -1, 0.5).set(0, 4, 0.5201).neighbours().size(), 2);
  EXPECT_EQ(Scan().set(-14, -10, 0.5).set(9, 13, 0.5).neighbours().size(), 1) << "19 rays";
  EXPECT_EQ(Scan().set(-14, -10, 0.5).set(10, 14, 0.5).neighbours().size(), 2) << "20 rays";
}

TEST(LidarClustering, ARingIsOneCluster) {
  const auto found = Scan().set(0, 718, 0.5).neighbours();
  ASSERT_EQ(found.size(), 1);
  EXPECT_NEAR(found[0].distance_m, 0.5, 1e-12);
}

}  // namespace
}  // namespace swarmsmith
