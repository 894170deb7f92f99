#include "robot/runtime/feeds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Arrival at_ms(int when) {
  return {.at = TimePoint(milliseconds(when)), .stamp_ns = 0};
}

TEST(Feeds, MapProximityToItsRange) {
  Feeds feeds({});
  feeds.hear(RangesMessage{at_ms(5), {0.0, 0.049, 0.05, 0.4, 0.41, kInfinity, -kInfinity, 2.0}});
  const EightReadings wanted = {-kInfinity, -kInfinity, 0.05,       0.4,
                                kInfinity,  kInfinity,  -kInfinity, kInfinity};
  EXPECT_EQ(feeds.sensed().proximity_m, wanted);
  EXPECT_EQ(feeds.age(Feed::Proximity, TimePoint(milliseconds(12))), milliseconds(7));
  EXPECT_EQ(feeds.age(Feed::Ground, TimePoint(milliseconds(12))), std::nullopt);
}

TEST(Feeds, TakeAMissingSensorForSilenceAndNameIt) {
  Feeds feeds({});
  const std::vector<double> free(8, kInfinity);
  feeds.hear(RangesMessage{at_ms(0), std::vector<double>(8, 0.2)});
  std::vector<double> broken;
  for (const auto& [sensor, name] :
       {std::pair{0U, "0 (45"}, std::pair{7U, "7 (90"}, std::pair{3U, "3 (-90"}}) {
    broken = free;
    broken[sensor] = std::nan("");
    feeds.hear(RangesMessage{at_ms(100), broken});
    EXPECT_EQ(feeds.heard(Feed::Proximity), 1) << sensor;
    EXPECT_EQ(feeds.trouble(Feed::Proximity),
              std::string("proximity sensor ") + name + " degrees) is missing: its value is NaN");
  }
  EXPECT_EQ(feeds.sensed().proximity_m[0], 0.2) << "not free";
  EXPECT_EQ(feeds.age(Feed::Proximity, TimePoint(milliseconds(100))), milliseconds(100));
  feeds.hear(RangesMessage{at_ms(200), free});
  EXPECT_EQ(feeds.trouble(Feed::Proximity), "");
  EXPECT_EQ(feeds.age(Feed::Proximity, TimePoint(milliseconds(200))), milliseconds(0));
  feeds.hear(RangesMessage{at_ms(300), {0.1, 0.2}});
  EXPECT_EQ(feeds.trouble(Feed::Proximity), "expected 8 values, got 2");
  feeds.hear(RangesMessage{at_ms(300), std::vector<double>(9, 0.2)});
  EXPECT_EQ(feeds.trouble(Feed::Proximity), "expected 8 values, got 9");
  broken[3] = -0.3;
  feeds.hear(RangesMessage{at_ms(300), broken});
  EXPECT_EQ(feeds.trouble(Feed::Proximity),
            "proximity sensor 3 (-90 degrees) has the negative range -0.300000 m");
  EXPECT_EQ(feeds.heard(Feed::Proximity), 2);
  EXPECT_EQ(feeds.sensed().proximity_m[0], kInfinity) << "the last usable message";
}

TEST(Feeds, ScaleAndLabelTheFloor) {
  Feeds of_255({});
  of_255.hear(GroundColorMessage{at_ms(0), 254.6, -3, 300});
  EXPECT_EQ(of_255.sensed().ground, (Rgb{255, 0, 255}));
  EXPECT_EQ(of_255.ground_as_sent(), (RawColor{254.6, -3, 300}));
  Feeds of_1({.color_scale = 1, .labels = {}});
  of_1.hear(GroundColorMessage{at_ms(0), 0.5, 1, 0});
  EXPECT_EQ(of_1.sensed().ground, (Rgb{128, 255, 0}));
  Feeds labelled({.labels = {{0, 0, 0}, {127, 127, 127}, {255, 0, 0}}});
  labelled.hear(GroundColorMessage{at_ms(0), 30, 20, 10});
  EXPECT_EQ(labelled.sensed().ground, (Rgb{0, 0, 0}));
  for (double GroundColorMessage::*part :
       {&GroundColorMessage::r, &GroundColorMessage::g, &GroundColorMessage::b}) {
    GroundColorMessage wrong{at_ms(9), 120, 120, 120};
    wrong.*part = std::nan("");
    labelled.hear(wrong);
    EXPECT_EQ(labelled.heard(Feed::Ground), 1);
    EXPECT_EQ(labelled.trouble(Feed::Ground), "a colour that is not a number");
    EXPECT_EQ(labelled.ground_as_sent(), (RawColor{30, 20, 10}));
    EXPECT_EQ(labelled.sensed().ground, (Rgb{0, 0, 0}));
  }
  labelled.hear(GroundColorMessage{at_ms(9), 120, 120, 120});
  EXPECT_EQ(labelled.sensed().ground, (Rgb{127, 127, 127}));
}

TEST(Feeds, HearNeighboursReadyOrByScan) {
  Feeds feeds({});
  feeds.hear(NeighboursMessage{at_ms(0), {{0.5, 0, 1}, {0.3, -1, 0}}});
  const auto neighbours = [&feeds] {
    std::vector<std::array<double, 3>> all;
    for (const Neighbour& one : feeds.sensed().neighbours)
      all.push_back({one.distance_m, one.direction_x, one.direction_y});
    return all;
  };
  const std::vector<std::array<double, 3>> heard{{0.5, 0, 1}, {0.3, -1, 0}};
  EXPECT_EQ(neighbours(), heard);
  const double nan = std::nan("");
  for (const SeenRobot& wrong :
       {SeenRobot{nan, 0, 1}, SeenRobot{kInfinity, 0, 1}, SeenRobot{-0.1, 0, 1},
        SeenRobot{0.4, nan, 1}, SeenRobot{0.4, 0, kInfinity}}) {
    feeds.hear(NeighboursMessage{at_ms(0), {{0.4, 1, 0}, wrong}});
    EXPECT_EQ(feeds.trouble(Feed::Neighbours), "a neighbour whose place is not a number");
    EXPECT_EQ(neighbours(), heard);
  }
  feeds.hear(NeighboursMessage{at_ms(0), {{0, 1, 0}}});
  EXPECT_EQ(neighbours().size(), 1U) << "instead of the earlier ones";
  ScanMessage scan{.arrival = at_ms(5),
                   .angle_min_rad = 0,
                   .angle_increment_rad = 6.283185307179586 / kLidarRays,
                   .range_min_m = 0.1,
                   .range_max_m = 12,
                   .ranges_m = std::vector<double>(kLidarRays, 5.0)};
  for (std::size_t ray = 100; ray < 110; ++ray)
    scan.ranges_m[ray] = 0.6;
  feeds.set_wall_offset(std::chrono::seconds(1000));
  scan.arrival.stamp_ns = 1'000'001'000'000;
  feeds.hear(scan);
  EXPECT_NEAR(feeds.stamp_ms(Feed::Neighbours).value_or(0), 4, 1e-6);
  ASSERT_EQ(feeds.sensed().neighbours.size(), 1U);
  EXPECT_NEAR(feeds.sensed().neighbours[0].distance_m, 0.6, 1e-12);
  EXPECT_EQ(feeds.heard(Feed::Neighbours), 3);
  EXPECT_EQ(feeds.age(Feed::Neighbours, TimePoint(milliseconds(6))), milliseconds(1));
  scan.ranges_m.clear();
  feeds.hear(scan);
  EXPECT_EQ(feeds.trouble(Feed::Neighbours), "a scan without values");
  EXPECT_EQ(neighbours().size(), 1U);
}

TEST(Feeds, TellTheDelayOfStampsByTheWallClock) {
  Feeds feeds({});
  feeds.set_wall_offset(std::chrono::seconds(1000));
  RangesMessage message{at_ms(500), std::vector<double>(8, 0.2)};
  message.arrival.stamp_ns = 1'000'488'000'000;  // 12 ms before
  feeds.hear(message);
  ASSERT_TRUE(feeds.stamp_ms(Feed::Proximity));
  EXPECT_NEAR(*feeds.stamp_ms(Feed::Proximity), 12, 1e-6);
  feeds.hear(RangesMessage{at_ms(600), std::vector<double>(8, 0.2)});
  EXPECT_EQ(feeds.stamp_ms(Feed::Proximity), std::nullopt);
}

TEST(Feeds, KeepLightWithinTheReferenceModel) {
  Feeds feeds({});
  feeds.hear(GroundColorMessage{at_ms(0), 30, 20, 10});
  feeds.hear(LightMessage{at_ms(0), {9, 1, 2, 3, 4, 5, 6, 1e9}});
  EXPECT_EQ(feeds.ground_as_sent(), (RawColor{30, 20, 10})) << "another reading";
  EXPECT_EQ(feeds.sensed().light_lux, (EightReadings{9, 1, 2, 3, 4, 5, 6, kMostLight_lux}));
  for (const double wrong : {-1.0, std::nan("")}) {
    feeds.hear(LightMessage{at_ms(0), {7, 1, 2, 3, 4, 5, 6, wrong}});
    EXPECT_EQ(feeds.trouble(Feed::Light), "a light sensor is missing: NaN or negative lux");
  }
  feeds.hear(LightMessage{at_ms(0), {0, 1}});
  EXPECT_EQ(feeds.trouble(Feed::Light), "expected 8 values, got 2");
  EXPECT_EQ(feeds.heard(Feed::Light), 1);
  EXPECT_EQ(feeds.sensed().light_lux[0], 9);
}

}  // namespace
}  // namespace swarmsmith
