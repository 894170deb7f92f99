#include <fcntl.h>
#include <unistd.h>
#include <fstream>
#include <optional>
#include <string>

#include "robot/app/commands.h"
#include "robot/app/input_end.h"
#include "robot/app/machine_word.h"
#include "robot/app/robot_names.h"
#include "robot/runtime/robot_kind.h"
#include "sim/files/machine_file.h"
#include "sim/files/mission_file.h"
#include "sim/files/robot_file.h"
#include "tests/robot/runtime/rover.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

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

/// As `--index`, which has this limit; logs with an index of more than a million are refused.
TEST(RobotNames, WithTooLargeANumberGiveNoIndex) {
  EXPECT_EQ(index_in_name("rvr100001"), 100'000);
  EXPECT_EQ(index_in_name("rvr100002"), std::nullopt);
  EXPECT_EQ(index_in_name("rvr2000000"), std::nullopt);
}

/// `yes | swarmsmith-robot run --pipe`: the node must not read for ever.
TEST(InputEnd, IsNotWaitedForWhileInputKeepsComing) {
  const int usual = ::dup(STDIN_FILENO);
  const int endless = ::open("/dev/zero", O_RDONLY);
  ASSERT_GE(endless, 0);
  ::dup2(endless, STDIN_FILENO);
  EXPECT_FALSE(input_has_ended());
  const int empty = ::open("/dev/null", O_RDONLY);
  ::dup2(empty, STDIN_FILENO);
  EXPECT_TRUE(input_has_ended());
  ::dup2(usual, STDIN_FILENO);
  for (const int descriptor : {usual, endless, empty})
    ::close(descriptor);
}

TEST(RosWords, AreOptionsOfOurs) {
  EXPECT_THAT(without_ros_words({"--robot", "1", "_seed:=7", "_turn_clock:=seconds",
                                 "ranges:=/teraranger/ranges", "__name:=x", "--topic", "a:=b"}),
              ElementsAre("--robot", "1", "--seed", "7", "--turn-clock", "seconds", "--topic",
                          "ranges:=/teraranger/ranges", "--topic", "a:=b"));
}

TEST(MachineWord, NeedsAFlavour) {
  EXPECT_THAT(complaint_of(robot_machine("--nstates 1 --s0 1", "", {}, rvr())),
              HasSubstr("give --flavour"));
  const auto with =
      value_of(robot_machine("--nstates 1 --s0 1", "watermelon", TurnClock::Seconds, rvr()));
  EXPECT_EQ(with.flavour.exploration.turn_clock, TurnClock::Seconds);
  EXPECT_FALSE(robot_machine("--nstates 9 --s0 1", "watermelon", {}, rvr()));
  EXPECT_FALSE(robot_machine("/no/such/file.fsm", "watermelon", {}, rvr()));
}

TEST(MachineWord, HasTheTurnClockOfItsFlavour) {
  const TemporaryFolder folder;
  const std::string mine = (folder / "mine.toml").string();
  std::ofstream(mine)
      << "format = 1\nbase = \"watermelon\"\n[exploration]\nturn_clock = \"seconds\"\n";
  const auto clock = [&](std::optional<TurnClock> given) {
    return value_of(robot_machine("--nstates 1 --s0 1", mine, given, rvr()))
        .flavour.exploration.turn_clock;
  };
  EXPECT_EQ(clock({}), TurnClock::Seconds);
  EXPECT_EQ(clock(TurnClock::Cycles), TurnClock::Cycles);
}

TEST(MachineWord, IsForTheRobotOfTheNode) {
  const TemporaryFolder folder;
  const auto complaint = [&](const std::string& mission_robot, const Robot& kind) {
    MachineHead head{.flavour = "watermelon"};
    if (!mission_robot.empty()) {
      head.mission = MissionEntry{value_of(built_in_mission("aggregation"))};
      head.mission->mission.name = "mine";
      head.mission->mission.robot =
          mission_robot == "rover" ? rover() : find_robot(mission_robot, {}).value();
    }
    std::ofstream(folder / "best.fsm") << head_text(head) << "--nstates 1 --s0 1\n";
    const auto machine = robot_machine((folder / "best.fsm").string(), "", {}, kind);
    return machine ? "" : to_string(machine.error());
  };
  EXPECT_EQ(complaint("", rvr()), "");
  EXPECT_EQ(complaint("rvr", rvr()), "");
  EXPECT_EQ(complaint("rover", rover()), "");
  EXPECT_EQ(complaint("", rover()), "") << "its flavour fits";
  EXPECT_THAT(complaint("rover", rvr()),
              HasSubstr(other_robot("the machine", rover(), rvr()).value()));
  EXPECT_THAT(complaint("rvr", rover()),
              HasSubstr(other_robot("the machine", rvr(), rover()).value()));
  EXPECT_THAT(complaint("epuck", rvr()), HasSubstr("the machine is for the robot `epuck`"));
}

TEST(Kinds, AreRobotsThatNodesDrive) {
  EXPECT_EQ(value_of(find_kind("rvr")), rvr());
  EXPECT_THAT(complaint_of(find_kind("epuck")), HasSubstr("give strengths"));
  EXPECT_THAT(complaint_of(find_kind("rower")), HasSubstr("there is no robot `rower`"));
}

}  // namespace
}  // namespace swarmsmith
