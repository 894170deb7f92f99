#include "robot/world/simulated_driver.h"

#include <limits>

#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;

TimePoint at(int ms) {
  return TimePoint{} + std::chrono::hours(1) + milliseconds(ms);
}

WheelsMessage command(int ms, double speed, const std::string& sender = "/rvr1/control") {
  return {{at(ms), 0}, speed, speed, {}, sender};
}

/// Left tread after `act`, or the one before when nothing is new.
double left(SimulatedDriver& driver, int ms, double before) {
  const auto treads = driver.act(at(ms));
  return treads ? treads->left_mps : before;
}

TEST(SimulatedDriver, ObeysACommandOnce) {
  SimulatedDriver driver;
  EXPECT_FALSE(driver.act(at(0)).has_value());
  driver.hear(command(0, 0.3));
  EXPECT_EQ(left(driver, 0, 0), 0.3);
  EXPECT_FALSE(driver.act(at(10)).has_value());
}

TEST(SimulatedDriver, StopsWhenNoCommandCameFor300Milliseconds) {
  SimulatedDriver driver;
  driver.hear(command(0, 0.3));
  EXPECT_EQ(left(driver, 0, 0), 0.3);
  EXPECT_EQ(left(driver, 300, 0.3), 0.3);
  EXPECT_EQ(left(driver, 301, 0.3), 0);
  EXPECT_TRUE(driver.silent());
  EXPECT_THAT(driver.take_events(), ElementsAre("no command for 300 ms: treads stopped"));
  EXPECT_FALSE(driver.act(at(310)).has_value());
  driver.hear(command(400, 0.2));
  EXPECT_EQ(left(driver, 400, 0), 0.2);
  EXPECT_FALSE(driver.silent());
}

TEST(SimulatedDriver, RefusesTwoSenders) {
  SimulatedDriver driver;
  driver.hear(command(0, 0.3));
  EXPECT_EQ(left(driver, 0, 0), 0.3);
  driver.hear(command(50, 0.1, "/stranger"));
  EXPECT_EQ(left(driver, 50, 0.3), 0);
  EXPECT_TRUE(driver.has_rivals());
  EXPECT_THAT(driver.take_events(), ElementsAre(HasSubstr("/rvr1/control and /stranger")));
  for (int ms = 100; ms <= 1000; ms += 100) {
    driver.hear(command(ms, 0.3));
    EXPECT_EQ(left(driver, ms, 0), 0) << ms;
  }
  driver.hear(command(1100, 0.3));
  EXPECT_EQ(left(driver, 1100, 0), 0.3) << "the stranger has been silent for a second";
}

TEST(SimulatedDriver, ACommandThatIsNoNumberStops) {
  SimulatedDriver driver;
  driver.hear(command(0, 0.3));
  EXPECT_EQ(left(driver, 0, 0), 0.3);
  driver.hear(command(100, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(left(driver, 100, 0.3), 0);
  EXPECT_THAT(driver.take_events(), ElementsAre(HasSubstr("not a number")));
}

}  // namespace
}  // namespace swarmsmith
