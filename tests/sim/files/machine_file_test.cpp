#include "sim/files/machine_file.h"

#include "sim/files/profile_file.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

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
  return complaints_of(parse_machine_file(text, "m.fsm"));
}

TEST(MachineFile, SaysWhatItsMachineWasDesignedFor) {
  const MachineHead head = head_of_a_winner();
  const auto read = value_of(parse_machine_file("# the best\n" + head_text(head) + kStop, "m.fsm"));
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read.front().head, head);
  EXPECT_EQ(read.front().text, "--nstates 1 --s0 1");
  EXPECT_THAT(head_text(head), HasSubstr("#: mission = \"grid_exploration\"\n"));
}

TEST(MachineFile, MayBeginWithAByteOrderMark) {
  const MachineHead head = head_of_a_winner();
  const auto read = value_of(parse_machine_file("\xef\xbb\xbf" + head_text(head) + kStop, "m.fsm"));
  EXPECT_EQ(read.front().head, head);
}

TEST(MachineFile, HasMissionsAndProfilesOfOnesOwnWhole) {
  MachineHead head = head_of_a_winner();
  head.mission->mission.name = "shelter";
  head.mission->mission.robots = 5;
  head.mission->mission.rule = RobotsOn{};
  head.profile->name = "mine";
  const auto read = value_of(parse_machine_file(head_text(head) + kStop, "m.fsm"));
  EXPECT_EQ(read.front().head, head);
}

TEST(MachineFile, HasAFlavourOfOnesOwnWhole) {
  Flavour mine = chocolate();
  mine.name = "mine";
  mine.most_states = 7;
  const MachineHead head{.flavour = mine.name, .own_flavour = kept_flavour(mine)};
  EXPECT_THAT(head_text(head), HasSubstr("#: [flavour]\n#: name = \"mine\"\n"));
  const auto read = value_of(parse_machine_file(head_text(head) + kStop, "m.fsm"));
  EXPECT_EQ(read.front().head, head);
}

TEST(MachineFile, HasABuiltInMissionWholeThatWasChanged) {
  MachineHead head = head_of_a_winner();
  head.mission->mission.cycles = 100;
  EXPECT_THAT(head_text(head), HasSubstr("#: [[mission]]\n"));
  const auto read = value_of(parse_machine_file(head_text(head) + kStop, "m.fsm"));
  EXPECT_EQ(read.front().head, head);
}

TEST(MachineFile, ANumberOfMachinesEachHaveTheirHead) {
  const auto read = value_of(parse_machine_file(
      "#: format = 1\n#: flavour = \"chocolate\"\nfirst: --fsm-config --nstates 1\n  --s0 1\n"
      "# nothing\n\n#: format = 1\n#: flavour = \"watermelon\"\n--nstates 1 --s0 1\n"
      "third --nstates 1 --s0 1\r\n",
      "m.fsm"));
  ASSERT_EQ(read.size(), 3U);
  EXPECT_EQ(read.at(0).name, "first");
  EXPECT_EQ(read.at(0).text, "--fsm-config --nstates 1 --s0 1");
  EXPECT_EQ(read.at(0).head.flavour, "chocolate");
  EXPECT_EQ(read.at(1).head.flavour, "watermelon");
  EXPECT_EQ(read.at(2).head.flavour, "");
  EXPECT_EQ(read.at(2).name, "third");
  EXPECT_EQ(read.at(2).place, "m.fsm:10");
}

TEST(MachineFile, NamesThePlaceOfWhatIsWrong) {
  EXPECT_THAT(
      complaints_about(std::string("# x\n#: format = 1\n#: flavour = \"melon\"\n") + kStop),
      ElementsAre(AllOf(StartsWith("m.fsm:3:14: "), HasSubstr("name its file with --flavour"))));
  EXPECT_THAT(complaints_about(std::string("#: format = 1\n#: flavor = \"watermelon\"\n") + kStop),
              ElementsAre(HasSubstr("m.fsm:2:4: ")));
  EXPECT_THAT(complaints_about(std::string("#: format = 2\n") + kStop),
              ElementsAre(HasSubstr("newer than this program")));
  EXPECT_THAT(complaints_about(std::string("#: format = \n") + kStop),
              ElementsAre(HasSubstr("m.fsm:1:")));
  EXPECT_THAT(complaints_about("stop\n"),
              ElementsAre("m.fsm:1: control software begins with one of --nstates, --fsm-config, "
                          "--nroot, --rootnode, --bt-config, --network, genomestart"));
  EXPECT_THAT(complaints_about("--s0 1\n"), ElementsAre(HasSubstr("m.fsm:1: ")));
  EXPECT_THAT(complaints_about("# nothing\n"), ElementsAre("m.fsm: the file contains no machine"));
  EXPECT_THAT(complaints_about(kStop), IsEmpty());
}

TEST(MachineFile, ANameHasNoOptions) {
  // As AutoMoDe-private, branch HardwareOptimization, Results/controllers: the options before the
  // machine say how many robots there are, and what their sensors cost.
  const std::string waffle = " --robots 22 --rabsi 2 --rabar 0.7 --nstates 1 --s0 1\n";
  EXPECT_THAT(complaints_about(waffle),
              ElementsAre(AllOf(HasSubstr("m.fsm:1: unknown options before the machine: "),
                                HasSubstr("`--robots`, `--rabsi`, `--rabar`"))));
  EXPECT_THAT(complaints_about(waffle + waffle + waffle),
              ElementsAre(AllOf(HasSubstr("m.fsm:1: "), HasSubstr("2 more lines"))));
  EXPECT_THAT(complaints_about("best: --robots 22 --nstates 1 --s0 1\n"),
              ElementsAre(HasSubstr("`--robots`")));
  EXPECT_THAT(
      complaints_about("automode_main -n -c x.argos --seed 3 --fsm-config " + std::string(kStop)),
      ElementsAre(HasSubstr("`-n`, `-c`, `--seed`")));
  EXPECT_THAT(complaints_about("hA1 - the best, of 10: " + std::string(kStop)), IsEmpty());
}

/// NEAT's form (tests/sim/control/network_test.cpp); too short to be a controller of ours.
constexpr const char* kGenome =
    "/* Organism #2 Fitness: 8483.2 Time: 0 */\ngenomestart 2\ntrait 1 0.1 0 0 0 0 0 0 0 \n"
    "node 1 1 1 3\nnode 2 1 0 2\ngene 1 1 2 -0.5 0 1 -0.5 1\ngenomeend 2\n";

TEST(MachineFile, TakesGenomesAsTheyAre) {
  const auto read = value_of(parse_machine_file(kGenome + std::string(kStop) + kGenome, "gen_0"));
  ASSERT_EQ(read.size(), 3U);
  EXPECT_EQ(read.at(0).text,
            "genomestart 2 trait 1 0.1 0 0 0 0 0 0 0 node 1 1 1 3 node 2 1 0 2 gene 1 1 2 -0.5 0 1 "
            "-0.5 1 genomeend 2");
  EXPECT_EQ(read.at(0).place, "gen_0:2");
  EXPECT_EQ(read.at(0).name, "");
  EXPECT_EQ(read.at(1).text, "--nstates 1 --s0 1");
  EXPECT_EQ(read.at(2).place, "gen_0:10");
}

TEST(MachineFile, TakesGenomesOnOneLine) {
  const std::string genome = "genomestart 2 node 1 1 1 3 gene 1 1 2 -0.5 0 1 -0.5 1 genomeend 2";
  const auto read = value_of(parse_machine_file(genome + "\n" + kStop, "gen_0"));
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read.at(0).text, genome);
  EXPECT_EQ(read.at(1).text, "--nstates 1 --s0 1");
  const auto two_lines = value_of(parse_machine_file(
      "genomestart 2 node 1 1 1 3\ngene 1 1 2 -0.5 0 1 -0.5 1 genomeend 2\n" + std::string(kStop),
      "gen_0"));
  ASSERT_EQ(two_lines.size(), 2U);
  EXPECT_EQ(two_lines.at(0).text, genome);
}

TEST(MachineFile, AHeadWithoutAMachineIsAnError) {
  EXPECT_THAT(complaints_about(kStop + std::string("#: format = 1\n#: flavor = \"watermelon\"\n")),
              ElementsAre(HasSubstr("m.fsm:3:4: ")));
  EXPECT_THAT(complaints_about(kStop + std::string("#: format = 1\n")),
              ElementsAre("m.fsm: no machine follows the lines `#:` at the end of the file"));
  EXPECT_THAT(complaints_about("#: format = 1\n"),
              ElementsAre("m.fsm: the file contains no machine"));
  EXPECT_THAT(complaints_about("#: format = 1\nstop\n"),
              ElementsAre(HasSubstr("m.fsm:2: control software begins with one of")));
}

TEST(MachineFile, SaysOnceWhatAWrongFileSeemsToBe) {
  const auto about = [](const std::string& text) {
    const auto said = complaints_about(text);
    return said.size() == 1 ? said.front() : std::to_string(said.size()) + " lines";
  };
  const std::string expected = "; expected machines, trees or networks as texts";
  for (const auto& [text, kind] : std::vector<std::pair<std::string, std::string>>{
           {std::string("SQLite format 3\0..", 18), "a store"},
           {"\x89PNG\r\n\x1a\n....", "a picture (PNG)"},
           {"\xff\xd8\xff\xe0....", "a picture (JPEG)"},
           {"%PDF-1.4\n....", "a PDF"},
           {"<?xml version=\"1.0\"?>\n<argos-configuration>\n</argos-configuration>\n",
            "an experiment of ARGoS"},
           {"<svg xmlns=\"http://www.w3.org/2000/svg\">\n</svg>\n", "a picture (SVG)"},
           {"# mine\nformat = 1\nname = \"x\"\n\n[arena]\nside = 3\n", "a mission file"},
           {"format = 1\n[campaign]\n[[mission]]\nname = \"aggregation\"\n[[method]]\nbaseline "
            "= \"--nstates 1 --s0 1\"\n",
            "a campaign file"},
           {"format = 1\n[proximity]\nrange = 0.4\n", "a profile"},
           {"{\"a\": 1,\n\"b\": 2}\n", "JSON"},
           {"fsm_id,mission,fsm\nhA1,aggregation,--nstates 1 --s0 1\n", "a table (CSV)"},
           {std::string("a\0b\nc\n", 6), "a binary file"}}) {
    EXPECT_THAT(about(text), AllOf(HasSubstr("m.fsm: this is " + kind), HasSubstr(expected)));
  }
  std::string lines;
  for (int i = 0; i < 80; ++i)
    lines += "line " + std::to_string(i) + "\n";
  EXPECT_THAT(about(lines), AllOf(HasSubstr("m.fsm:1: control software begins with"),
                                  HasSubstr("79 more lines")));
}

}  // namespace
}  // namespace swarmsmith
