#include "coordinator/results/machine_import.h"

#include "sim/control/flavour_file.h"
#include "sim/files/machine_file.h"
#include "sim/files/profile_file.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

std::string text_of(const std::string& file) {
  return whole_file(SWARMSMITH_TEST_DATA "/argos/" + file);
}

MachineImport into_empty_store() {
  MachineImport known;
  known.campaign = "theirs";
  known.flavour = watermelon_argos3();
  known.method = "thesis";
  return known;
}

TEST(MachineImport, ReadsATextALineWithNamesOrWithout) {
  const auto machines = value_of(read_machine_lines(
      "# best of all\n--nstates 1 --s0 1\n\n hA1: --fsm-config --nstates 1 --s0 1\r\n", "m.txt"));
  ASSERT_EQ(machines.size(), 2U);
  EXPECT_EQ(machines.at(0).name, "");
  EXPECT_EQ(machines.at(0).text, "--nstates 1 --s0 1");
  EXPECT_EQ(machines.at(1).name, "hA1");
  EXPECT_EQ(machines.at(1).place, "m.txt:4");
  EXPECT_EQ(to_string(read_machine_lines("stop\n", "m.txt").error().front()),
            "m.txt:1: control software begins with one of --nstates, --fsm-config, --nroot, "
            "--rootnode, --bt-config, --network, genomestart");
  EXPECT_FALSE(read_machine_lines("# nothing\n", "m.txt"));
}

TEST(MachineImport, TakesTheFlavourThatFilesSay) {
  const std::string argos3 = "#: format = 1\n#: flavour = \"watermelon-argos3\"\n";
  const std::string machine = "--nstates 1 --s0 1\n";
  const auto all = value_of(read_machine_lines(argos3 + machine + argos3 + machine, "m.fsm"));
  EXPECT_EQ(flavour_of(all, std::nullopt).value(), watermelon_argos3());
  EXPECT_EQ(flavour_of(all, watermelon_argos3()).value(), watermelon_argos3());
  EXPECT_EQ(to_string(flavour_of(all, watermelon()).error()),
            "m.fsm:3: the machine is of the flavour watermelon-argos3, not watermelon; leave "
            "--flavour out");
  const auto some = read_machine_lines(argos3 + machine + machine, "m.fsm");
  EXPECT_THAT(to_string(flavour_of(*some, std::nullopt).error()),
              HasSubstr("m.fsm:4: the machine's flavour is unknown"));
  EXPECT_EQ(flavour_of(*some, watermelon_argos3()).value(), watermelon_argos3());
  const auto two = read_machine_lines(
      argos3 + machine + "#: format = 1\n#: flavour = \"chocolate\"\n" + machine, "m.fsm");
  EXPECT_THAT(to_string(flavour_of(*two, std::nullopt).error()), HasSubstr("m.fsm:6: "));
}

/// Of one's own, of more states than the built-in ones have.
Flavour mine(int states = 6) {
  Flavour flavour = watermelon();
  flavour.name = "mine";
  flavour.most_states = states;
  return flavour;
}

std::string filed(const Flavour& flavour) {
  return head_text({.flavour = flavour.name, .own_flavour = kept_flavour(flavour)}) +
         "--nstates 1 --s0 1\n";
}

TEST(MachineImport, KeepsAFlavourOfOnesOwn) {
  const auto machines = value_of(read_machine_lines(filed(mine()), "m.fsm"));
  MachineImport known = into_empty_store();
  known.missions.of_all = "aggregation";
  known.flavour = flavour_of(machines, std::nullopt).value();
  EXPECT_EQ(known.flavour, mine());
  const auto addition = value_of(import_machines(machines, known));
  EXPECT_EQ(addition.designs.front().row.flavour, "mine");
  const std::string& file = addition.campaign->file;
  EXPECT_THAT(own_flavours_in(file), ElementsAre(kept_flavour(mine())));
  EXPECT_EQ(read_imported_world(file).value().own_flavour, kept_flavour(mine()));
  known.flavour = mine(7);
  EXPECT_NE(import_machines(machines, known)->campaign->digest, addition.campaign->digest);
}

TEST(MachineImport, TellsFlavoursOfOneNameApart) {
  const auto two = value_of(read_machine_lines(filed(mine()) + filed(mine(7)), "m.fsm"));
  EXPECT_THAT(to_string(flavour_of(two, std::nullopt).error()),
              HasSubstr("of the flavour mine, one before it of another of this name"));
  EXPECT_THAT(to_string(flavour_of(two, mine()).error()),
              HasSubstr("of the flavour mine, not another of this name; leave --flavour out"));
  // A table has the name alone.
  const auto table = parse_csv("flavour,fsm\nmine,--nstates 1 --s0 1\n", "m.csv");
  EXPECT_EQ(flavour_of(*read_machine_table(*table), mine()).value(), mine());
  EXPECT_THAT(to_string(flavour_of(*read_machine_table(*table), std::nullopt).error()),
              HasSubstr("m.csv:2: "));
}

TEST(MachineImport, RefusesATurnClockThatAStoreWouldForget) {
  EXPECT_THAT(complaint_of(read_machine_lines("#: format = 1\n#: flavour = \"watermelon\"\n#: "
                                              "turn_clock = \"seconds\"\n--nstates 1 --s0 "
                                              "1\n",
                                              "m.fsm")),
              HasSubstr("m.fsm:4: its turn clock"));
}

TEST(MachineImport, MakesAFinishedDesignOfEachMachine) {
  MachineImport known = into_empty_store();
  known.missions.of_all = "aggregation";
  known.designs = {{.id = {4}, .mission = "aggregation", .method = "thesis", .repetition = 2}};
  const auto machines =
      read_machine_lines("a --nstates 2 --s0 1 --n0 1 --n0x0 0 --c0x0 0 --p0x0 0.5 --s1 1\n", "m");
  const auto addition = value_of(import_machines(*machines, known));
  const auto& [design, name] = addition.designs.front();
  EXPECT_EQ(design.id, DesignId{5});
  EXPECT_EQ(design.repetition, 3);
  EXPECT_EQ(design.flavour, "watermelon-argos3");
  EXPECT_EQ(name, "a");
  const auto& candidate = std::get<CandidateRow>(addition.rows[0]);
  EXPECT_EQ(candidate.id, candidate_id({5}, 1));
  EXPECT_EQ(candidate.states, 2);
  EXPECT_EQ(candidate.transitions, 1);
  EXPECT_EQ(candidate.modules, R"({"stop":2,"black_floor":1})");
  const auto& state = std::get<DesignStateRow>(addition.rows[1]);
  EXPECT_EQ(state.state, DesignState::Finished);
  EXPECT_EQ(state.best, candidate.id);
}

/// A mission of one's own, as heads of files have it.
MissionEntry shelter(int robots = 5) {
  MissionEntry entry{built_in_mission("aggregation").value()};
  entry.mission.name = "shelter";
  entry.mission.robots = robots;
  return entry;
}

std::string filed(const MissionEntry& mission, const std::string& profile = "rvr") {
  return head_text({.flavour = "watermelon-argos3",
                    .profile = built_in_profile(profile).value(),
                    .mission = mission}) +
         "--nstates 1 --s0 1\n";
}

TEST(MachineImport, KeepsTheWorldThatHeadsDescribe) {
  const auto machines = value_of(read_machine_lines(filed(shelter(), "argos3"), "m.fsm"));
  const auto addition = value_of(import_machines(machines, into_empty_store()));
  EXPECT_EQ(addition.designs.front().row.mission, "shelter");
  const auto world = value_of(read_imported_world(addition.campaign->file));
  EXPECT_THAT(world.missions, ElementsAre(shelter()));
  EXPECT_EQ(world.profile, built_in_profile("argos3").value());
  EXPECT_THAT(addition.campaign->deciding, HasSubstr("\"mission.shelter.score.kind\":"));
  // Nothing is kept that each program knows.
  const auto built_in =
      read_machine_lines(filed(MissionEntry{built_in_mission("aggregation").value()}), "m.fsm");
  EXPECT_EQ(import_machines(*built_in, into_empty_store())->campaign->file, "");
}

TEST(MachineImport, GivesAMissionANewNameAndKeepsWhatItIs) {
  MachineImport known = into_empty_store();
  known.missions.renamed = {{"shelter", "cave"}};
  const auto addition =
      value_of(import_machines(*read_machine_lines(filed(shelter()), "m.fsm"), known));
  EXPECT_EQ(addition.designs.front().row.mission, "cave");
  const auto world = value_of(read_imported_world(addition.campaign->file));
  ASSERT_EQ(world.missions.size(), 1U);
  EXPECT_EQ(world.missions[0].mission.name, "cave");
  EXPECT_EQ(world.missions[0].mission.robots, 5);
  // A built-in one is what it is.
  known.missions.renamed = {{"shelter", "aggregation"}};
  EXPECT_EQ(import_machines(*read_machine_lines(filed(shelter()), "m.fsm"), known)->campaign->file,
            "");
}

TEST(MachineImport, TakesMissionsOfFiles) {
  const auto machines = read_machine_lines("--nstates 1 --s0 1\n", "m.fsm");
  MachineImport known = into_empty_store();
  known.missions = {
      .of_all = "shelter", .renamed = {}, .of_files = {shelter()}, .all_of_file = true};
  const auto addition = value_of(import_machines(*machines, known));
  EXPECT_THAT(read_imported_world(addition.campaign->file)->missions, ElementsAre(shelter()));
  // It is that of all designs, whatever they call theirs; but not of two missions.
  const auto one =
      parse_csv("mission,fsm\nhole,--nstates 1 --s0 1\nhole,--nstates 1 --s0 1\n", "m.csv");
  EXPECT_EQ(import_machines(*read_machine_table(*one), known)->designs[1].row.mission, "shelter");
  const auto two =
      parse_csv("mission,fsm\nhole,--nstates 1 --s0 1\ncave,--nstates 1 --s0 1\n", "m.csv");
  EXPECT_THAT(complaint_of(import_machines(*read_machine_table(*two), known)),
              HasSubstr("m.csv:3: the file has the missions hole and cave"));
  known.missions = {.of_all = "",
                    .renamed = {{"hole", "shelter"}},
                    .of_files = {shelter()},
                    .all_of_file = false};
  EXPECT_THAT(import_machines(*read_machine_table(*two), known).error().front().message,
              HasSubstr("there is no mission `cave`"));
}

TEST(MachineImport, RefusesTwoWorldsOfOneName) {
  const auto of = [](const std::string& text) {
    const auto addition = import_machines(*read_machine_lines(text, "m.fsm"), into_empty_store());
    return addition ? "read" : to_string(addition.error().front());
  };
  EXPECT_EQ(of(filed(shelter()) + filed(shelter())), "read");
  EXPECT_THAT(of(filed(shelter()) + filed(shelter(6))), HasSubstr("another mission shelter"));
  EXPECT_THAT(of(filed(shelter()) + filed(shelter(), "argos3")), HasSubstr("the profile argos3"));
}

TEST(MachineImport, NamesEveryBadRowByItsLine) {
  const auto table = parse_csv(
      "name,mission,fsm\na,aggregation,--nstates 1 --s0 99\n"
      "b,,--nstates 1 --s0 1\nc,two words,--nstates 1 --s0 1\n"
      "d,aggregation,--nstates 1 --s0 1\nd,aggregation,--nstates 1 --s0 1\n",
      "m.csv");
  const auto addition = import_machines(*read_machine_table(*table), into_empty_store());
  ASSERT_FALSE(addition);
  EXPECT_THAT(lines_of(addition.error()),
              ElementsAre(HasSubstr("m.csv:2, token 4"), HasSubstr("m.csv:3: no mission"),
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
  const auto first = value_of(thesis_designs(known));
  EXPECT_EQ(first.designs.size(), 30U);
  known.designs = {{.id = {9}, .mission = "grid", .method = "thesis", .repetition = 7}};
  const auto second = thesis_designs(known);
  EXPECT_EQ(first.campaign->digest, second->campaign->digest);
  EXPECT_EQ(second->designs.front().row.id, DesignId{10});
  known.missions.renamed["grid"] = "grid_exploration";
  EXPECT_NE(thesis_designs(known)->campaign->digest, first.campaign->digest);
}

}  // namespace
}  // namespace swarmsmith
