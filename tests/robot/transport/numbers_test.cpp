#include "robot/transport/numbers.h"

#include <gmock/gmock.h>

#include <limits>

namespace swarmsmith {
namespace {

using testing::ElementsAre;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

SensesMessage some_senses() {
  SensesMessage senses;
  senses.seed = 2'147'483'647;
  senses.cycle = 1200;
  senses.time_s = 0.1 + 0.2;
  senses.ranges_m = {0.1, kInfinity, -kInfinity, 0.39, 0.05, 1e-300, 0.2, 0.3};
  senses.color = {0, 127, 255};
  senses.light_lux = {1, 2, 3, 4, 5, 6, 7, 16000};
  senses.neighbours = {{0.5, 1, 0}, {0.7, -0.6, 0.8}};
  return senses;
}

TEST(Numbers, SensesComeBackWithTheirBits) {
  const SensesMessage sent = some_senses();
  SensesMessage came;
  ASSERT_TRUE(read_numbers(numbers_of(sent), came));
  EXPECT_EQ(came.seed, sent.seed);
  EXPECT_EQ(came.cycle, sent.cycle);
  EXPECT_EQ(came.time_s, sent.time_s);
  EXPECT_EQ(came.ranges_m, sent.ranges_m);
  EXPECT_EQ(came.color, sent.color);
  EXPECT_EQ(came.light_lux, sent.light_lux);
  ASSERT_EQ(came.neighbours.size(), 2U);
  EXPECT_EQ(came.neighbours[1].distance_m, 0.7);
  EXPECT_EQ(came.neighbours[1].direction_x, -0.6);
  EXPECT_EQ(came.neighbours[1].direction_y, 0.8);
}

TEST(Numbers, SensesOfAnotherLengthOrWithAHalfCycleAreNone) {
  std::vector<double> numbers = numbers_of(some_senses());
  SensesMessage came;
  came.cycle = 7;
  numbers.pop_back();
  EXPECT_FALSE(read_numbers(numbers, came));
  numbers = numbers_of(some_senses());
  numbers[1] = 1.5;
  EXPECT_FALSE(read_numbers(numbers, came));
  numbers[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(read_numbers(numbers, came));
  numbers[1] = 1e300;
  EXPECT_FALSE(read_numbers(numbers, came));
  EXPECT_FALSE(read_numbers({}, came));
  EXPECT_EQ(came.cycle, 7) << "the message is untouched";
}

TEST(Numbers, AnAnswerNamesItsQuestion) {
  const AnswerMessage sent{{}, 7, 12, 0.3, -0.1, 3};
  EXPECT_THAT(numbers_of(sent), ElementsAre(7, 12, 0.3, -0.1, 3));
  AnswerMessage came;
  ASSERT_TRUE(read_numbers(numbers_of(sent), came));
  EXPECT_EQ(came.cycle, 12);
  EXPECT_EQ(came.state, 3);
  EXPECT_FALSE(read_numbers({7, 12, 0.3, -0.1}, came));
  EXPECT_FALSE(read_numbers({7, 12, 0.3, -0.1, -1}, came));
}

TEST(Numbers, WheelsHaveAStateInLockStepAlone) {
  EXPECT_THAT(numbers_of(WheelsMessage{{}, 0.3, 0.2, -1, {}}), ElementsAre(0.3, 0.2));
  EXPECT_THAT(numbers_of(WheelsMessage{{}, 0.3, 0.2, 1, {}}), ElementsAre(0.3, 0.2, 1));
  WheelsMessage came;
  ASSERT_TRUE(read_numbers({0.3, 0.2, 2}, came));
  EXPECT_EQ(came.state, 2);
  ASSERT_TRUE(read_numbers({0.3, 0.2}, came));
  EXPECT_EQ(came.state, -1);
  EXPECT_FALSE(read_numbers({0.3}, came));
  EXPECT_FALSE(read_numbers({0.3, 0.2, 1, 1}, came));
}

TEST(Numbers, AllOtherMessagesComeBack) {
  ScanMessage scan{{}, -1, 1, 0.5, 0.1, 12, {0, 1, kInfinity, 2, 3}};
  ScanMessage scan_came;
  ASSERT_TRUE(read_numbers(numbers_of(scan), scan_came));
  EXPECT_EQ(scan_came.ranges_m, scan.ranges_m);
  EXPECT_EQ(scan_came.angle_increment_rad, 0.5);
  EXPECT_EQ(scan_came.range_max_m, 12);
  EXPECT_FALSE(read_numbers({1, 2}, scan_came));

  OdometryMessage odometry_came;
  ASSERT_TRUE(read_numbers(numbers_of(OdometryMessage{{}, 1, 2, 3, 4, 5, 6}), odometry_came));
  EXPECT_EQ(odometry_came.turn_radps, 6);

  ImuMessage imu_came;
  ASSERT_TRUE(read_numbers({0, 0, 0, 1, 1, 2, 3, 4, 5, 6}, imu_came));
  EXPECT_EQ(imu_came.acceleration_mps2[2], 6);

  LedsMessage leds_came;
  EXPECT_FALSE(read_numbers({1, 2, 3}, leds_came));
  EXPECT_TRUE(read_numbers(std::vector<double>(15, 255), leds_came));

  NeighboursMessage neighbours_came;
  EXPECT_FALSE(read_numbers({1, 2}, neighbours_came));
  EXPECT_TRUE(read_numbers({}, neighbours_came));
}

}  // namespace
}  // namespace swarmsmith
