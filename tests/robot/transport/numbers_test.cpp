#include "robot/transport/numbers.h"

#include <limits>

#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

TEST(Numbers, SensesOfAnotherLengthOrWithAHalfCycleAreNone) {
  std::vector<double> numbers = numbers_of(SensesMessage{.neighbours = {{0.5, 1, 0}}});
  SensesMessage came;
  came.cycle = 7;
  numbers.pop_back();
  EXPECT_FALSE(read_numbers(numbers, came));
  numbers = numbers_of(SensesMessage{.neighbours = {{0.5, 1, 0}}});
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
  EXPECT_THAT(numbers_of(WheelsMessage{{}, 0.3, 0.2, {}, {}}), ElementsAre(0.3, 0.2));
  EXPECT_THAT(numbers_of(WheelsMessage{{}, 0.3, 0.2, 1, {}}), ElementsAre(0.3, 0.2, 1));
  WheelsMessage came;
  ASSERT_TRUE(read_numbers({0.3, 0.2, 2}, came));
  EXPECT_EQ(came.state, 2);
  ASSERT_TRUE(read_numbers({0.3, 0.2}, came));
  EXPECT_EQ(came.state, std::nullopt);
  EXPECT_FALSE(read_numbers({0.3}, came));
  EXPECT_FALSE(read_numbers({0.3, 0.2, 1, 1}, came));
}

TEST(Numbers, TooFewOrTooManyAreNone) {
  ScanMessage scan;
  EXPECT_FALSE(read_numbers({1, 2, 3, 4}, scan));
  EXPECT_TRUE(read_numbers({1, 2, 3, 4, 5}, scan));
  LedsMessage leds;
  EXPECT_FALSE(read_numbers({1, 2, 3}, leds));
  EXPECT_TRUE(read_numbers(std::vector<double>(15, 255), leds));
  EXPECT_FALSE(read_numbers(std::vector<double>(16, 255), leds));
  NeighboursMessage neighbours;
  EXPECT_FALSE(read_numbers({1, 2}, neighbours));
  EXPECT_TRUE(read_numbers({}, neighbours));
}

}  // namespace
}  // namespace swarmsmith
