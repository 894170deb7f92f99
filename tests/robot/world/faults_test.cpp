#include "robot/world/faults.h"

#include <cmath>
#include <limits>

#include "base/math.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

TEST(Faults, AreReadFromWords) {
  const auto silent = value_of(parse_fault("rvr1:ranges:silent:10-10.3"));
  EXPECT_EQ(silent, (Fault{.robot = "rvr1",
                           .sensor = "ranges",
                           .kind = Fault::Kind::Silent,
                           .from_s = 10,
                           .to_s = 10.3}));
  const auto scan = value_of(parse_fault("rvr2:scan:500:0-"));
  EXPECT_EQ(scan.length, 500);
  EXPECT_EQ(scan.to_s, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(parse_fault("rvr2:scan:turned:0-").has_value());
  EXPECT_TRUE(parse_fault("rvr2:light:nan:1-2").has_value());
}

TEST(Faults, WordsThatAreNoneSayHowTheyAreWritten) {
  for (const char* wrong :
       {"", "rvr1", "rvr1:ranges:silent", "rvr1:ranges:silent:10", "rvr1:ranges:silent:3-2",
        ":ranges:silent:1-2", "rvr1:radar:silent:1-2", "rvr1:ranges:loud:1-2",
        "rvr1:ranges:turned:1-2", "rvr1:ground_color:7:1-2", "rvr1:ranges:-7:1-2",
        "rvr1:ranges:silent:-1-2", "rvr1:ranges:silent:1-2:3"}) {
    const auto fault = parse_fault(wrong);
    ASSERT_FALSE(fault.has_value()) << wrong;
    EXPECT_THAT(fault.error().message, HasSubstr("ROBOT:SENSOR:WHAT:FROM-TO"));
  }
}

TEST(Faults, HitOneSensorOfOneRobotForTheirTime) {
  const std::vector<Fault> faults = {*parse_fault("rvr1:ranges:silent:1-2"),
                                     *parse_fault("rvr1:ground_color:nan:1-2")};
  const FaultySensors first(faults, "rvr1");
  const FaultySensors second(faults, "rvr2");
  const RangesMessage ranges{{}, std::vector<double>(8, 0.2)};
  EXPECT_TRUE(first.pass(ranges, 0.99).has_value());
  EXPECT_FALSE(first.pass(ranges, 1).has_value());
  EXPECT_FALSE(first.pass(ranges, 1.99).has_value());
  EXPECT_TRUE(first.pass(ranges, 2).has_value());
  EXPECT_TRUE(second.pass(ranges, 1.5).has_value());
  const auto green = [](const FaultySensors& sensors) {
    return std::get<GroundColorMessage>(*sensors.pass(GroundColorMessage{{}, 1, 2, 3}, 1.5)).g;
  };
  EXPECT_TRUE(std::isnan(green(first)));
  EXPECT_EQ(green(second), 2);
}

TEST(Faults, AScanOfAnotherLengthOrTurnSaysTheSameByItsAngles) {
  ScanMessage scan;
  scan.angle_min_rad = 0;
  scan.angle_increment_rad = 2 * kPi / 720;
  scan.ranges_m.assign(720, 5);
  scan.ranges_m[90] = 0.5;  // at 45 degrees
  const auto where = [](const ScanMessage& message) {
    for (std::size_t i = 0; i < message.ranges_m.size(); ++i) {
      if (message.ranges_m[i] == 0.5) {
        return std::remainder(
            message.angle_min_rad + static_cast<double>(i) * message.angle_increment_rad, 2 * kPi);
      }
    }
    return -99.0;
  };
  const auto passed = [&scan](const char* fault) {
    return std::get<ScanMessage>(*FaultySensors({*parse_fault(fault)}, "r").pass(scan, 0));
  };
  const ScanMessage shorter = passed("r:scan:360:0-");
  EXPECT_EQ(shorter.ranges_m.size(), 360U);
  EXPECT_NEAR(where(shorter), kPi / 4, 0.02);
  const ScanMessage turned = passed("r:scan:turned:0-");
  EXPECT_NE(turned.ranges_m, scan.ranges_m);
  EXPECT_NEAR(turned.angle_min_rad, -kPi, 0.01);
  EXPECT_NEAR(where(turned), kPi / 4, 1e-9);
}

}  // namespace
}  // namespace swarmsmith
