#include "analysis/arena/reading_columns.h"

#include <algorithm>
#include <limits>
#include <set>

#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using testing::IsSupersetOf;

TEST(SensorNames, NameEverySensorOnce) {
  Sensors all;
  for (const std::string& name : sensor_names()) {
    const auto sensors = sensors_from_names(name);
    ASSERT_TRUE(sensors) << name;
    EXPECT_NE(all | *sensors, all) << name;
    all = all | *sensors;
  }
  EXPECT_EQ(all, Sensors::all());
}

TEST(SensorNames, AllLeavesTheLidarOutUnlessItIsNamed) {
  EXPECT_FALSE(sensors_from_names("all")->has(Sensor::Lidar));
  EXPECT_EQ(*sensors_from_names("all,lidar"), Sensors::all());
  EXPECT_EQ(*sensors_from_names("proximity,ground_color"), Sensor::Proximity | Sensor::GroundColor);
}

TEST(SensorNames, SuggestTheOneThatWasMeant) {
  const auto sensors = sensors_from_names("proximty");
  ASSERT_FALSE(sensors);
  EXPECT_THAT(
      sensors.error().message,
      HasSubstr("there is no sensor `proximty` (did you mean \"proximity\"?); known: all, "));
  EXPECT_FALSE(sensors_from_names(""));
  EXPECT_FALSE(sensors_from_names("imu,"));
}

TEST(ReadingColumns, HaveNamesWithUnitsAndOneCellEach) {
  const ReadingColumns columns(Sensor::GroundColor | Sensor::Neighbours, 3, rvr());
  EXPECT_THAT(columns.names(), ElementsAre("ground_r", "ground_g", "ground_b", "neighbours",
                                           "neighbour0_distance_m", "neighbour0_bearing_rad",
                                           "neighbour1_distance_m", "neighbour1_bearing_rad"));
  Readings readings;
  readings.ground_color = {1, 20, 255};
  readings.neighbours = {{.distance_m = 0.5, .direction_x = 0, .direction_y = -1}};
  readings.neighbour_count = 1;
  std::string line;
  columns.append_cells(line, &readings);
  EXPECT_EQ(line, ",1,20,255,1,0.5,-1.5707963267948966,,");
  line.clear();
  columns.append_cells(line, nullptr);
  EXPECT_EQ(line, ",,,,,,,,");
}

/// A radio's list has older packets first, more than the swarm has robots.
TEST(ReadingColumns, CountTheNeighboursOfThisCycleAlone) {
  const ReadingColumns columns(Sensor::Neighbours, 3, rvr());
  Readings readings;
  for (const double distance_m : {0.1, 0.2, 0.3, 0.4, 0.5})
    readings.neighbours.push_back({distance_m, 1, 0});
  const auto cells = [&](int heard_now) {
    readings.neighbour_count = heard_now;
    std::string line;
    columns.append_cells(line, &readings);
    return line;
  };
  EXPECT_EQ(cells(2), ",2,0.4,0,0.5,0");
  EXPECT_EQ(cells(1), ",1,0.5,0,,");
  EXPECT_EQ(cells(0), ",0,,,,");
}

TEST(ReadingColumns, SayWhatTheRobotsSensorsGive) {
  const auto names = [](const Robot& robot) {
    return ReadingColumns(Sensor::Proximity | Sensor::LightRing, 1, robot).names();
  };
  EXPECT_THAT(names(rvr()), IsSupersetOf({"proximity0_m", "light7_lux"}));
  Robot robot;
  robot.proximity.reading = ProximityRing::Reading::Strength;
  robot.light.reading = LightRing::Reading::Strength;
  EXPECT_THAT(names(robot), IsSupersetOf({"proximity0_strength", "light7_strength"}));
}

TEST(ReadingColumns, HaveAsManySensorsAsTheRobot) {
  Robot robot;
  robot.proximity.rays_deg = {40, 0, -40};
  EXPECT_THAT(ReadingColumns(Sensor::Proximity | Sensor::LightRing, 1, robot).names(),
              ElementsAre("light0_lux", "light1_lux", "light2_lux", "proximity0_m", "proximity1_m",
                          "proximity2_m"))
      << "the light sensors are where the rays are";
  robot.light.angles_deg = {90, -90};
  const ReadingColumns columns(Sensor::Proximity | Sensor::LightRing, 1, robot);
  EXPECT_THAT(columns.names(), ElementsAre("light0_lux", "light1_lux", "proximity0_m",
                                           "proximity1_m", "proximity2_m"));
  Readings readings;
  readings.light_lux = {1, 2, 3, 4};
  readings.proximity_m = {5, 6, 7, 8};
  std::string line;
  columns.append_cells(line, &readings);
  EXPECT_EQ(line, ",1,2,5,6,7");
}

TEST(ReadingColumns, OfAllSensorsAreDistinctAndFilled) {
  const ReadingColumns columns(Sensors::all(), 1, rvr());
  const std::set<std::string> distinct(columns.names().begin(), columns.names().end());
  EXPECT_EQ(distinct.size(), columns.names().size());
  EXPECT_TRUE(distinct.contains("lidar718_m"));
  Readings readings;
  readings.lidar_m.assign(719, 0.25);
  readings.light_lux.assign(kProximitySensors, 100);
  readings.proximity_m.assign(kProximitySensors, -std::numeric_limits<double>::infinity());
  std::string line;
  columns.append_cells(line, &readings);
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(line, ',')), columns.names().size());
  EXPECT_THAT(line, Not(HasSubstr(",,")));
  EXPECT_THAT(line, HasSubstr(",-inf,0.25,"));
}

TEST(LedsText, HasTheFiveInTheirOrder) {
  const Leds leds = {Rgb{255, 0, 0}, {0, 255, 16}, {}, {}, {1, 2, 3}};
  EXPECT_EQ(leds_text(leds), "#ff0000 #00ff10 #000000 #000000 #010203");
}

}  // namespace
}  // namespace swarmsmith
