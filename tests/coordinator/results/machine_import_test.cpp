#include "coordinator/results/machine_import.h"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

namespace swarmsmith {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(std::string(SWARMSMITH_TEST_DATA) + "/argos/" + file).rdbuf();
  return text.str();
}

MachineImport into_empty_store() {
  MachineImport known;
  known.campaign = "theirs";
  known.flavour = watermelon_argos3();
  known.method = "thesis";
  return known;
}

TEST(MachineImport, ReadsATextALineWithNamesOrWithout) {
  const auto machines = read_machine_lines(
      "# best of all\n--nstates 1 --s0 1\n\n hA1: --fsm-config --nstates 1 --s0 1\r\n", "m.txt");
  ASSERT_TRUE(machines);
  ASSERT_EQ(machines->size(), 2U);
  EXPECT_EQ(machines->at(0).name, "");
  EXPECT_EQ(machines->at(0).text, "--nstates 1 --s0 1");
  EXPECT_EQ(machines->at(1).name, "hA1");
  EXPECT_EQ(machines->at(1).place, "m.txt:4");
  EXPECT_EQ(to_string(read_machine_lines("stop\n", "m.txt").error().front()),
            "m.txt:1: control software begins with one of --nstates, --fsm-config, --nroot, "
            "--bt-config, --network");
  EXPECT_FALSE(read_machine_lines("# nothing\n", "m.txt"));
}

TEST(MachineImport, TakesTheFlavourThatFilesSay) {
  const std::string argos3 = "#: format = 1\n#: flavour = \"watermelon-argos3\"\n";
  const std::string machine = "--nstates 1 --s0 1\n";
  const auto all = read_machine_lines(argos3 + machine + argos3 + machine, "m.fsm");
  ASSERT_TRUE(all);
  EXPECT_EQ(flavour_of(*all, "").value(), "watermelon-argos3");
  EXPECT_EQ(flavour_of(*all, "watermelon-argos3").value(), "watermelon-argos3");
  EXPECT_EQ(to_string(flavour_of(*all, "watermelon").error()),
            "m.fsm:3: the machine is of the flavour watermelon-argos3, not watermelon; leave "
            "--flavour out");
  const auto some = read_machine_lines(argos3 + machine + machine, "m.fsm");
  EXPECT_THAT(to_string(flavour_of(*some, "").error()),
              HasSubstr("m.fsm:4: the machine's flavour is unknown"));
  EXPECT_EQ(flavour_of(*some, "watermelon-argos3").value(), "watermelon-argos3");
  const auto two = read_machine_lines(
      argos3 + machine + "#: format = 1\n#: flavour = \"chocolate\"\n" + machine, "m.fsm");
  EXPECT_THAT(to_string(flavour_of(*two, "").error()), HasSubstr("m.fsm:6: "));
}

TEST(MachineImport, RefusesATurnClockThatAStoreWouldForget) {
  const auto machines = read_machine_lines(
      "#: format = 1\n#: flavour = \"watermelon\"\n#: turn_clock = \"seconds\"\n--nstates 1 --s0 "
      "1\n",
      "m.fsm");
  ASSERT_FALSE(machines);
  EXPECT_THAT(to_string(machines.error().front()), HasSubstr("m.fsm:4: its turn clock"));
}

TEST(MachineImport, MakesAFinishedDesignOfEachMachine) {
  MachineImport known = into_empty_store();
  known.missions.of_all = "aggregation";
  known.designs = {{.id = {4}, .mission = "aggregation", .method = "thesis", .repetition = 2}};
  const auto machines =
      read_machine_lines("a --nstates 2 --s0 1 --n0 1 --n0x0 0 --c0x0 0 --p0x0 0.5 --s1 1\n", "m");
  const auto addition = import_machines(*machines, known);
  ASSERT_TRUE(addition) << to_string(addition.error().front());
  const auto& [design, name] = addition->designs.front();
  EXPECT_EQ(design.id, DesignId{5});
  EXPECT_EQ(design.repetition, 3);
  EXPECT_EQ(design.flavour, "watermelon-argos3");
  EXPECT_EQ(name, "a");
  const auto& candidate = std::get<CandidateRow>(addition->rows[0]);
  EXPECT_EQ(candidate.id, candidate_id({5}, 1));
  EXPECT_EQ(candidate.states, 2);
  EXPECT_EQ(candidate.transitions, 1);
  EXPECT_EQ(candidate.modules, R"({"stop":2,"black_floor":1})");
  const auto& state = std::get<DesignStateRow>(addition->rows[1]);
  EXPECT_EQ(state.state, DesignState::Finished);
  EXPECT_EQ(state.best, candidate.id);
}

TEST(MachineImport, NamesEveryBadRowByItsLine) {
  const auto table = parse_csv(
      "name,mission,fsm\na,aggregation,--nstates 1 --s0 99\n"
      "b,,--nstates 1 --s0 1\nc,two words,--nstates 1 --s0 1\n"
      "d,aggregation,--nstates 1 --s0 1\nd,aggregation,--nstates 1 --s0 1\n",
      "m.csv");
  const auto addition = import_machines(*read_machine_table(*table), into_empty_store());
  ASSERT_FALSE(addition);
  std::vector<std::string> texts;
  for (const Error& error : addition.error())
    texts.push_back(to_string(error));
  EXPECT_THAT(texts, ElementsAre(HasSubstr("m.csv:2, token 4"), HasSubstr("m.csv:3: no mission"),
                                 HasSubstr("m.csv:4: `two words` is not a valid mission name"),
                                 "m.csv:6: d is the name of the machine of m.csv:5, too"));
}

/// The thesis' thirty designs, its missions by the names that they have here.
OrErrors<Addition> thesis_designs(const MachineImport& known) {
  const auto table = parse_csv(text_of("argos-thesis-designs.csv"), "thesis.csv");
  return import_machines(*read_machine_table(*table), known);
}

TEST(MachineImport, KnowsTheSameMachinesAgainWhateverTheStoreHolds) {
  MachineImport known = into_empty_store();
  const auto unknown = thesis_designs(known);
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().front().message,
            "there is no mission `grid` here; is it grid_exploration? Then --mission "
            "grid=grid_exploration, or --mission grid=grid to keep the name");
  known.missions.renamed = {{"grid", "grid"}, {"color", "color"}};
  const auto first = thesis_designs(known);
  ASSERT_TRUE(first) << to_string(first.error().front());
  EXPECT_EQ(first->designs.size(), 30U);
  known.designs = {{.id = {9}, .mission = "grid", .method = "thesis", .repetition = 7}};
  const auto second = thesis_designs(known);
  EXPECT_EQ(first->campaign->digest, second->campaign->digest);
  EXPECT_EQ(second->designs.front().row.id, DesignId{10});
  known.missions.renamed["grid"] = "grid_exploration";
  EXPECT_NE(thesis_designs(known)->campaign->digest, first->campaign->digest);
}

}  // namespace
}  // namespace swarmsmith
