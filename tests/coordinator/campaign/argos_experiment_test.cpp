#include "coordinator/campaign/argos_experiment.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "sim/control/flavour.h"
#include "sim/control/machine_text.h"

namespace swarmsmith {
namespace {

using testing::HasSubstr;
using testing::Not;

Machine explorer() {
  return {{State{.behaviour = Exploration{20}, .transitions = {{BlackFloor{0.5}, 1}}},
           State{.behaviour = Attraction{2.5}, .transitions = {}}}};
}

std::string text_for(const std::string& mission) {
  const auto text = argos_experiment(
      {.machine = explorer(), .mission = *built_in_mission(mission), .seed = 7, .title = "t"});
  EXPECT_TRUE(text) << (text ? "" : to_string(text.error()));
  return text.value_or("");
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
  const auto machine = parse_machine(
      "--nstates 2 --s0 4 --att0 2.5 --n0 1 --n0x0 0 --c0x0 3 --p0x0 4 --w0x0 5.5 "
      "--s1 5 --rep1 3",
      chocolate());
  ASSERT_TRUE(machine);
  const auto text = argos_experiment(
      {.machine = *machine, .mission = *built_in_mission("aggregation"), .title = "t"});
  ASSERT_TRUE(text);
  EXPECT_THAT(*text,
              HasSubstr("fsm-config=\"--nstates 2 --s0 2 --att0 2.5 --n0 1 --n0x0 0 --c0x0 3 "
                        "--p0x0 4 --w0x0 5.5 --s1 3 --rep1 3\" real-robot=\"false\""));
}

TEST(ArgosExperiment, RefusesModulesThatTheOriginalLacks) {
  const Machine machine{{State{.behaviour = Phototaxis{}, .transitions = {}}}};
  const auto text =
      argos_experiment({.machine = machine, .mission = *built_in_mission("aggregation")});
  ASSERT_FALSE(text);
  EXPECT_THAT(text.error().message, HasSubstr("original AutoMoDe cannot run this machine"));
  EXPECT_THAT(text.error().message, HasSubstr("no module phototaxis"));
  EXPECT_EQ(text.error().where, "state 0");
}

TEST(ArgosExperiment, TakesNameDurationAndRobotsAndNothingElseOfAMission) {
  Mission mission = *built_in_mission("color_selection");
  mission.name = "mine";
  mission.cycles = 605;
  mission.robots = 5;
  const auto text = argos_experiment({.machine = explorer(), .mission = mission});
  ASSERT_TRUE(text);
  EXPECT_THAT(*text, HasSubstr("length=\"60.5\""));
  EXPECT_THAT(*text, HasSubstr("<rvr id=\"rvr_05_55\">"));
  EXPECT_THAT(*text, Not(HasSubstr("rvr_06")));
  mission.arena.floor = {1, 2, 3};
  const auto other = argos_experiment({.machine = explorer(), .mission = mission});
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().message, HasSubstr("mine is not one of the thesis' three"));
  mission = *built_in_mission("aggregation");
  mission.robots = 10;
  EXPECT_FALSE(argos_experiment({.machine = explorer(), .mission = mission}));
}

TEST(ArgosExperiment, KeepsItsCommentWellFormed) {
  const auto text = argos_experiment(
      {.machine = explorer(), .mission = *built_in_mission("aggregation"), .title = "a--b---c\n"});
  ASSERT_TRUE(text);
  EXPECT_THAT(*text, HasSubstr("<!-- a- -b- - -c\\n\n     For"));
}

}  // namespace
}  // namespace swarmsmith
