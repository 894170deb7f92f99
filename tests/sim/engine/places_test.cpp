#include "sim/engine/internal/places.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "base/rng.h"

namespace swarmsmith {
namespace {

std::vector<Mover> scattered(std::size_t count, double side_m, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Mover> movers(count);
  for (Mover& mover : movers) {
    mover.body.x = rng.uniform(-side_m / 2, side_m / 2);
    mover.body.y = rng.uniform(0, side_m);
  }
  return movers;
}

std::vector<int> near(const Places& places, const std::vector<Mover>& movers, std::size_t mover,
                      double radius_m, std::size_t first = 0) {
  std::vector<int> found;
  std::vector<int> room;
  places.visit_near(movers, mover, radius_m, first, room,
                    [&](int other) { found.push_back(other); });
  return found;
}

std::vector<int> near_one_by_one(const std::vector<Mover>& movers, std::size_t mover,
                                 double radius_m) {
  std::vector<int> found;
  for (std::size_t other = 0; other < movers.size(); ++other) {
    const double distance2 = distance2_of(movers[mover].body, movers[other].body);
    if (other != mover && distance2 <= radius_m * radius_m)
      found.push_back(static_cast<int>(other));
  }
  return found;
}

/// How many movers there are, and the side of the square that they are in, in metres.
class PlacesOf : public testing::TestWithParam<std::pair<std::size_t, double>> {};
INSTANTIATE_TEST_SUITE_P(Swarms, PlacesOf,
                         testing::Values(std::pair{1, 2.0}, std::pair{16, 2.0}, std::pair{17, 2.0},
                                         std::pair{33, 2.0}, std::pair{100, 0.1},
                                         std::pair{100, 12.0}, std::pair{300, 200.0}));

TEST_P(PlacesOf, FindWhatIsNearInTheOrderOfNumbers) {
  const auto [count, side] = GetParam();
  const std::vector<Mover> movers = scattered(count, side, 7);
  Places places(count);
  places.update(movers);
  for (const double radius : {0.05, 0.7, 3.0, 50.0}) {
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<int> expected = near_one_by_one(movers, i, radius);
      ASSERT_EQ(near(places, movers, i, radius), expected);
      std::erase_if(expected, [&](int j) { return j <= static_cast<int>(i); });
      ASSERT_EQ(near(places, movers, i, radius, i + 1), expected);
    }
  }
}

TEST(Places, AnswersAreOfWhereMoversAreNowHoweverFarTheyWent) {
  Rng rng(3);
  std::vector<Mover> movers = scattered(60, 6, 2);
  Places places(movers.size());
  for (int step = 0; step < 100; ++step) {
    for (Mover& mover : movers) {
      mover.body.x += rng.uniform(-0.1, 0.1);
      mover.body.y += rng.uniform(-0.1, 0.1);
    }
    movers[0].body.x += 0.05;  // out of the grid of the start
    places.update(movers);
    for (const double radius : {0.4, 0.75, 2.0}) {
      for (std::size_t i = 0; i < movers.size(); ++i) {
        ASSERT_EQ(near(places, movers, i, radius), near_one_by_one(movers, i, radius));
      }
    }
  }
}

TEST(Places, WhatIsNoNumberIsNowhereAndHarmsNoOther) {
  std::vector<Mover> movers = scattered(40, 3, 1);
  movers[4].body.x = std::numeric_limits<double>::quiet_NaN();
  movers[5].body.y = std::numeric_limits<double>::infinity();
  movers[6].body.x = 1e300;
  movers[7].body.x = std::numeric_limits<double>::infinity();
  Places places(movers.size());
  places.update(movers);
  EXPECT_TRUE(near(places, movers, 4, 1).empty());
  EXPECT_EQ(near(places, movers, 0, 100).size(), 35);
}

}  // namespace
}  // namespace swarmsmith
