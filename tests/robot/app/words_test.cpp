#include "robot/app/commands.h"
#include "robot/app/machine_word.h"
#include "robot/app/robot_names.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

TEST(RobotNames, AreNumbersOrNames) {
  EXPECT_EQ(robot_name("2").value(), "rvr2");
  EXPECT_EQ(robot_name("leo7").value(), "leo7");
  EXPECT_FALSE(robot_name("0"));
  EXPECT_FALSE(robot_name(""));
  EXPECT_FALSE(robot_name("../x"));
  EXPECT_EQ(index_in_name("rvr1"), 0);
  EXPECT_EQ(index_in_name("leo17"), 16);
  EXPECT_EQ(index_in_name("leo"), std::nullopt);
  EXPECT_THAT(robot_names("1-3").value(), ElementsAre("rvr1", "rvr2", "rvr3"));
  EXPECT_THAT(robot_names("2,leo1,4-5").value(), ElementsAre("rvr2", "leo1", "rvr4", "rvr5"));
  for (const char* wrong : {"", "3-1", "1,1", "1-3,2", "1,,2", "0-2", "1-99999"})
    EXPECT_FALSE(robot_names(wrong)) << wrong;
}

TEST(RosWords, AreOptionsOfOurs) {
  EXPECT_THAT(without_ros_words({"--robot", "1", "_seed:=7", "_turn_clock:=seconds",
                                 "ranges:=/teraranger/ranges", "__name:=x", "--topic", "a:=b"}),
              ElementsAre("--robot", "1", "--seed", "7", "--turn-clock", "seconds", "--topic",
                          "ranges:=/teraranger/ranges", "--topic", "a:=b"));
}

TEST(MachineWord, NeedsAFlavour) {
  EXPECT_THAT(complaint_of(robot_machine("--nstates 1 --s0 1", "", {})),
              HasSubstr("give --flavour"));
  const auto with = value_of(robot_machine("--nstates 1 --s0 1", "watermelon", TurnClock::Seconds));
  EXPECT_EQ(with.flavour.exploration.turn_clock, TurnClock::Seconds);
  EXPECT_FALSE(robot_machine("--nstates 9 --s0 1", "watermelon", {}));
  EXPECT_FALSE(robot_machine("/no/such/file.fsm", "watermelon", {}));
}

}  // namespace
}  // namespace swarmsmith
