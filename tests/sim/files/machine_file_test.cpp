#include "sim/files/machine_file.h"

#include <gmock/gmock.h>

#include "sim/files/profile_file.h"

namespace swarmsmith {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kStop = "--nstates 1 --s0 1\n";

MachineHead head_of_a_winner() {
  MachineHead head;
  head.flavour = "watermelon-argos3";
  head.turn_clock = TurnClock::Seconds;
  head.profile = built_in_profile("argos3").value();
  head.mission = MissionEntry{built_in_mission("grid_exploration").value()};
  head.seeds = "4,7-9";
  head.method = "mine";
  head.design = "d3";
  head.candidate = "c2000812";
  head.campaign = "5d1f";
  return head;
}

std::vector<std::string> complaints_about(const std::string& text) {
  std::vector<std::string> said;
  const auto machines = parse_machine_file(text, "m.fsm");
  if (machines) return said;
  for (const Error& error : machines.error())
    said.push_back(to_string(error));
  return said;
}

TEST(MachineFile, SaysWhatItsMachineWasDesignedFor) {
  const MachineHead head = head_of_a_winner();
  const auto read = parse_machine_file("# the best\n" + head_text(head) + kStop, "m.fsm");
  ASSERT_TRUE(read) << to_string(read.error().front());
  ASSERT_EQ(read->size(), 1U);
  EXPECT_EQ(read->front().head, head);
  EXPECT_EQ(read->front().text, "--nstates 1 --s0 1");
  EXPECT_THAT(head_text(head), HasSubstr("#: mission = \"grid_exploration\"\n"));
}

TEST(MachineFile, HasMissionsAndProfilesOfOnesOwnWhole) {
  MachineHead head = head_of_a_winner();
  head.mission->mission.name = "shelter";
  head.mission->mission.robots = 5;
  head.mission->mission.rule = RobotsOn{};
  head.profile->name = "mine";
  const auto read = parse_machine_file(head_text(head) + kStop, "m.fsm");
  ASSERT_TRUE(read) << to_string(read.error().front());
  EXPECT_EQ(read->front().head, head);
}

TEST(MachineFile, HasABuiltInMissionWholeThatWasChanged) {
  MachineHead head = head_of_a_winner();
  head.mission->mission.cycles = 100;
  EXPECT_THAT(head_text(head), HasSubstr("#: [[mission]]\n"));
  const auto read = parse_machine_file(head_text(head) + kStop, "m.fsm");
  ASSERT_TRUE(read) << to_string(read.error().front());
  EXPECT_EQ(read->front().head, head);
}

TEST(MachineFile, ANumberOfMachinesEachHaveTheirHead) {
  const auto read = parse_machine_file(
      "#: format = 1\n#: flavour = \"chocolate\"\nfirst: --fsm-config --nstates 1\n  --s0 1\n"
      "# nothing\n\n#: format = 1\n#: flavour = \"watermelon\"\n--nstates 1 --s0 1\n"
      "third --nstates 1 --s0 1\r\n",
      "m.fsm");
  ASSERT_TRUE(read) << to_string(read.error().front());
  ASSERT_EQ(read->size(), 3U);
  EXPECT_EQ(read->at(0).name, "first");
  EXPECT_EQ(read->at(0).text, "--fsm-config --nstates 1 --s0 1");
  EXPECT_EQ(read->at(0).head.flavour, "chocolate");
  EXPECT_EQ(read->at(1).head.flavour, "watermelon");
  EXPECT_EQ(read->at(2).head.flavour, "");
  EXPECT_EQ(read->at(2).name, "third");
  EXPECT_EQ(read->at(2).place, "m.fsm:10");
}

TEST(MachineFile, NamesThePlaceOfWhatIsWrong) {
  EXPECT_THAT(complaints_about(std::string("# x\n#: format = 1\n#: flavour = \"melon\"\n") + kStop),
              ElementsAre(HasSubstr("m.fsm:3:14: ")));
  EXPECT_THAT(complaints_about(std::string("#: format = 1\n#: flavor = \"watermelon\"\n") + kStop),
              ElementsAre(HasSubstr("m.fsm:2:4: ")));
  EXPECT_THAT(complaints_about(std::string("#: format = 2\n") + kStop),
              ElementsAre(HasSubstr("newer than this program")));
  EXPECT_THAT(complaints_about(std::string("#: format = \n") + kStop),
              ElementsAre(HasSubstr("m.fsm:1:")));
  EXPECT_THAT(complaints_about("stop\n"),
              ElementsAre("m.fsm:1: control software begins with one of --nstates, --fsm-config, "
                          "--nroot, --bt-config, --network"));
  EXPECT_THAT(complaints_about("--s0 1\n"), ElementsAre(HasSubstr("m.fsm:1: ")));
  EXPECT_THAT(complaints_about("# nothing\n"), ElementsAre("m.fsm: the file holds no machine"));
  EXPECT_THAT(complaints_about(kStop), testing::IsEmpty());
}

}  // namespace
}  // namespace swarmsmith
