#include "coordinator/campaign/argos_experiment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>

#include "sim/control/flavour.h"
#include "sim/control/machine_text.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"
#include "sim/files/robot_file.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

Machine explorer() {
  return {{State{.behaviour = Exploration{20}, .transitions = {{BlackFloor{0.5}, 1}}},
           State{.behaviour = Attraction{2.5}, .transitions = {}}}};
}

std::string text_for(const std::string& mission) {
  return value_of(argos_experiment(
      {.controller = explorer(), .mission = *built_in_mission(mission), .seed = 7, .title = "t"}));
}

TEST(ArgosExperiment, HasTheOriginalsLoopFunctions) {
  const std::string aggregation = text_for("aggregation");
  EXPECT_THAT(aggregation, HasSubstr("library=\"librvr_pow_aggregation_loopfunc.so\" "
                                     "label=\"aggregation_one_spot_loop_functions\""));
  EXPECT_THAT(aggregation, HasSubstr("length=\"120\" ticks_per_second=\"10\" random_seed=\"7\""));
  EXPECT_THAT(text_for("grid_exploration"), HasSubstr("label=\"grid_exploration_loop_functions\""));
  EXPECT_THAT(text_for("color_selection"), HasSubstr("label=\"color_aggregation_loop_functions\""));
}

TEST(ArgosExperiment, HasTheWallsThatOurArenaHas) {
  const std::string text = text_for("aggregation");
  const std::regex wall(
      R"(<body position="(-?[0-9.]+),(-?[0-9.]+),0" orientation="(-?[0-9]+),0,0"/>\n    </box>)");
  std::vector<Point> centres;
  for (auto found = std::sregex_iterator(text.begin(), text.end(), wall);
       found != std::sregex_iterator(); ++found) {
    centres.push_back({std::stod((*found)[1]), std::stod((*found)[2])});
  }
  ASSERT_EQ(centres.size(), 12U);
  // The middle of each inner face lies 5 mm, half a wall, before the middle of a box.
  for (const Wall& face : dodecagon_of_the_thesis().walls) {
    const Point middle{(face.from.x + face.to.x) / 2, (face.from.y + face.to.y) / 2};
    const auto near = [&](const Point& centre) {
      const double distance = std::hypot(centre.x - middle.x, centre.y - middle.y);
      return distance > 0.0045 && distance < 0.0055;
    };
    EXPECT_EQ(std::ranges::count_if(centres, near), 1) << middle.x << " " << middle.y;
  }
}

TEST(ArgosExperiment, NumbersModulesAsTheOriginalDoes) {
  // Attraction is 4 in chocolate and 2 in the original.
  const auto machine = value_of(
      parse_machine("--nstates 2 --s0 4 --att0 2.5 --n0 1 --n0x0 0 --c0x0 3 --p0x0 4 --w0x0 5.5 "
                    "--s1 5 --rep1 3",
                    chocolate()));
  const auto text = value_of(argos_experiment(
      {.controller = machine, .mission = *built_in_mission("aggregation"), .title = "t"}));
  EXPECT_THAT(text, HasSubstr("fsm-config=\"--nstates 2 --s0 2 --att0 2.5 --n0 1 --n0x0 0 --c0x0 3 "
                              "--p0x0 4 --w0x0 5.5 --s1 3 --rep1 3\" real-robot=\"false\""));
}

TEST(ArgosExperiment, RefusesModulesThatTheOriginalLacks) {
  const Machine machine{{State{.behaviour = Phototaxis{}, .transitions = {}}}};
  const Error text = why_not(
      argos_experiment({.controller = machine, .mission = *built_in_mission("aggregation")}));
  EXPECT_THAT(text.message, HasSubstr("original AutoMoDe cannot run this machine"));
  EXPECT_THAT(text.message, HasSubstr("no module phototaxis"));
  EXPECT_EQ(text.where, "state 0");
}

TEST(ArgosExperiment, TakesNameDurationAndRobotsAndNothingElseOfAMission) {
  Mission mission = *built_in_mission("color_selection");
  mission.name = "mine";
  mission.cycles = 605;
  mission.robots = 5;
  mission.robot.name = "ours";
  const auto text = value_of(argos_experiment({.controller = explorer(), .mission = mission}));
  EXPECT_THAT(text, HasSubstr("length=\"60.5\""));
  EXPECT_THAT(text, HasSubstr("<rvr id=\"rvr_05_55\">"));
  EXPECT_THAT(text, Not(HasSubstr("rvr_06")));
  mission.arena.floor = {1, 2, 3};
  EXPECT_THAT(complaint_of(argos_experiment({.controller = explorer(), .mission = mission})),
              HasSubstr("mine is not one of the thesis' three"));
  mission = *built_in_mission("aggregation");
  mission.robots = 10;
  EXPECT_FALSE(argos_experiment({.controller = explorer(), .mission = mission}));
}

class ArgosExperimentOfEPucks : public testing::Test {
 protected:
  static ArgosExperiment experiment(const std::string& file) {
    const auto read = read_mission_file(SWARMSMITH_SOURCE_DIR "/examples/missions/epuck/" + file);
    return {.controller = explorer(),
            .mission = read.value().mission,
            .profile = *built_in_profile("epuck"),
            .seed = 7,
            .title = "t"};
  }
};

// As the files of Results-Transferability have them.
TEST_F(ArgosExperimentOfEPucks, HasThePublishedDevicesAndNoise) {
  const std::string text = argos_experiment(experiment("rt-aac.toml")).value();
  for (const char* line :
       {"library=\"libchocolate_aac_loopfunc.so\" label=\"chocolate_aac_loop_functions\"",
        "functions of experiments-loop-functions. ARGOS_PLUGIN_PATH",
        "<params dist_radius=\"1.2\" number_robots=\"20\"/>",
        "<epuck_wheels implementation=\"default\" noise_std_dev=\"0.05\"/>",
        "medium=\"rab\" data_size=\"4\" range=\"0.5\"/>", "loss_probability=\"0.85\"",
        "<epuck_proximity implementation=\"default\" show_rays=\"false\" noise_level=\"0.05\"",
        "position=\"0,-1.25,0.75\" orientation=\"0,0,0\" color=\"yellow\" intensity=\"5\"",
        "<entity quantity=\"20\" max_trials=\"100\">", "<e-puck id=\"epuck\">",
        "<params fsm-config=\"--nstates 2 --s0 0 --rwm0 20 --n0 1 --n0x0 0 --c0x0 0 --p0x0 0.5 "
        "--s1 4 --att1 2.5\"/>"}) {
    EXPECT_THAT(text, HasSubstr(line));
  }
}

TEST_F(ArgosExperimentOfEPucks, HasTheLoopFunctionsOfEachMission) {
  const std::array<std::array<const char*, 2>, 5> missions = {
      {{"oc-aac.toml", "chocolate_aac_loop_functions"},
       {"oc-sca.toml", "chocolate_sca_loop_functions"},
       {"rt-for.toml", "foraging_loop_functions"},
       {"rt-grid.toml", "grid_exploration"},
       {"na-xor2.toml", "aggregation_xor2"}}};
  for (const auto& [file, label] : missions) {
    EXPECT_THAT(argos_experiment(experiment(file)).value(),
                HasSubstr("label=\"" + std::string(label) + "\""));
  }
  EXPECT_THAT(argos_experiment(experiment("rt-grid.toml")).value(), HasSubstr("intensity=\"0\""));
  EXPECT_THAT(argos_experiment(experiment("na-xor2.toml")).value(), HasSubstr("range=\"0.6\""));
}

TEST_F(ArgosExperimentOfEPucks, TakesTreesAndTheNoiseOfAProfile) {
  ArgosExperiment tree = experiment("rt-for.toml");
  tree.profile = *built_in_profile("epuck-pseudo-reality");
  tree.controller = parse_controller(
                        "--nroot 3 --nchildroot 1 --n0 0 --nchild0 2 --n00 6 --c00 0 "
                        "--p00 0.28 --n01 5 --a01 0 --rwm01 5 --p01 0",
                        *find_flavour("maple-epuck").value())
                        .value();
  const auto text = value_of(argos_experiment(tree));
  EXPECT_THAT(text, HasSubstr("<automode_controller_bt id=\"automode\" "
                              "library=\"libautomode_bt.so\">"));
  EXPECT_THAT(text, HasSubstr("<params bt-config=\"--nroot 3"));
  EXPECT_THAT(text, HasSubstr("noise_std_dev=\"0.15\""));
  EXPECT_THAT(text, HasSubstr("loss_probability=\"0.9\""));
}

TEST_F(ArgosExperimentOfEPucks, RefusesWhatTheOriginalHasNot) {
  const auto refusal = [](const ArgosExperiment& experiment) {
    const auto text = argos_experiment(experiment);
    return text ? "" : text.error().message;
  };
  EXPECT_THAT(refusal(experiment("mp-agg.toml")),
              HasSubstr("has no loop functions for the mission "));
  ArgosExperiment changed = experiment("rt-aac.toml");
  changed.mission.arena.patches[0].color = {1, 2, 3};
  EXPECT_THAT(refusal(changed), HasSubstr("has no loop functions for the mission rt-aac: "));
  changed = experiment("rt-aac.toml");
  changed.mission.robot.drive.track_m = 0.06;
  EXPECT_THAT(refusal(changed), HasSubstr("differs from the built-in epuck in `drive.track`"));
  changed.mission = *built_in_mission("aggregation");
  changed.mission.robot.body.mass_kg = 3;
  EXPECT_EQ(refusal(changed),
            ".argos files are for the robots rvr and epuck; the robot `rvr` of the mission "
            "aggregation differs from the built-in rvr in `body.mass`");
  changed.mission.robot = rvr_with(CircleOutline{0.1});
  EXPECT_THAT(refusal(changed), HasSubstr("differs from the built-in rvr in `body.shape`"));
  const auto turtlebot =
      find_robot(SWARMSMITH_SOURCE_DIR "/examples/missions/robots/turtlebot4.toml", {});
  changed.mission.robot = turtlebot.value();
  EXPECT_THAT(refusal(changed), HasSubstr("the robot `turtlebot4` of the mission aggregation "));
  changed = experiment("rt-aac.toml");
  changed.mission.arena.lights.push_back({});
  EXPECT_THAT(refusal(changed), HasSubstr("has one light"));
  changed = experiment("rt-aac.toml");
  changed.controller = Network{};
  EXPECT_THAT(refusal(changed), HasSubstr("is a network"));
  changed.controller = Machine{{State{.behaviour = LevyWalk{}, .transitions = {}}}};
  EXPECT_THAT(refusal(changed), HasSubstr("the original AutoMoDe cannot run this machine"));
}

TEST_F(ArgosExperimentOfEPucks, KnowsWhatOfAProfileItCannotSay) {
  EXPECT_THAT(left_out_of_argos(*built_in_profile("epuck")), IsEmpty());
  EXPECT_THAT(left_out_of_argos(*built_in_profile("epuck-pseudo-reality")), IsEmpty());
  Profile profile = *built_in_profile("epuck");
  profile.timing.jitter = 0.05;
  profile.treads.way = 0.5;
  EXPECT_THAT(left_out_of_argos(profile), ElementsAre("timing.jitter", "treads.way"));
  ArgosExperiment ranges = experiment("rt-aac.toml");
  ranges.profile =
      parse_profile("format = 1\nbase = \"epuck\"\n[treads]\nsd = [0, 0.2]\n", "p.toml").value();
  EXPECT_THAT(argos_experiment(ranges).error().message, HasSubstr("the profile p has ranges"));
}

TEST(ArgosExperiment, KeepsItsCommentWellFormed) {
  const auto text = value_of(argos_experiment({.controller = explorer(),
                                               .mission = *built_in_mission("aggregation"),
                                               .title = "a--b---c\n"}));
  EXPECT_THAT(text, HasSubstr("<!-- a- -b- - -c\\n\n     For"));
}

}  // namespace
}  // namespace swarmsmith
