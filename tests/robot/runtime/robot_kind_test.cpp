#include "robot/runtime/robot_kind.h"

#include <optional>
#include <string>

#include "sim/files/robot_file.h"
#include "tests/robot/runtime/rover.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

TEST(RobotKind, OfAnotherNameIsRefusedWithBothNamesAndWhatToDo) {
  EXPECT_EQ(other_robot("the order", rover(), rvr()),
            "the order is for the robot `rover`, and the node drives the robot `rvr`; use one for "
            "`rvr`, or a node of `rover` (`swarmsmith robot run --kind`)");
  EXPECT_EQ(other_robot("the machine", value_of(find_robot("epuck", {})), rover()),
            "the machine is for the robot `epuck`, and the node drives the robot `rover`; use one "
            "for `rover`")
      << "no node drives an e-puck";
}

TEST(RobotKind, OfTheSameNameSaysWhichNumberDiffers) {
  Robot wide = rover();
  wide.drive.track_m = 0.3;
  EXPECT_EQ(other_robot("the run", wide, rover()),
            "the run is for a robot `rover` with `drive.track` = 0.3, and the node's robot has "
            "0.2; use the same robot file for both");
  wide = rover();
  wide.ground.reading = GroundSensor::Reading::Vote;
  EXPECT_THAT(other_robot("the run", wide, rover()).value_or(""), HasSubstr("`ground.reading`"));
}

TEST(RobotKind, IsTheSameForRvrsOfAnyOutline) {
  EXPECT_EQ(other_robot("the order", rvr_with(CircleOutline{0.1}), rvr()), std::nullopt);
  EXPECT_EQ(other_robot("the order", rover(), rover()), std::nullopt);
  Robot round = rover();
  round.body.outline = CircleOutline{0.09};
  EXPECT_THAT(other_robot("the order", round, rover()).value_or(""), HasSubstr("`body.shape`"));
}

TEST(RobotKind, IsDrivenWhenItsSensorsGiveWhatMessagesCarry) {
  EXPECT_EQ(no_node_drives(rvr()), std::nullopt);
  EXPECT_EQ(no_node_drives(rover()), std::nullopt);
  EXPECT_EQ(no_node_drives(value_of(find_robot("epuck", {}))),
            "the robot `epuck` has proximity sensors that give strengths, and nodes drive robots "
            "that measure 8 distances, 8 values in lux, the colour of the floor and the places of "
            "others; `swarmsmith evaluate` simulates it");
  const auto of_rover = [](const auto& change) {
    Robot robot = rover();
    change(robot);
    const std::string why = no_node_drives(robot).value_or("the robot `rover` has nothing, and");
    const std::string begin = "the robot `rover` has ";
    EXPECT_THAT(why, StartsWith(begin));
    return why.substr(begin.size(), why.find(", and") - begin.size());
  };
  EXPECT_EQ(of_rover([](Robot& of) { of.proximity.rays_deg.pop_back(); }),
            "7 proximity and 7 light sensors");
  EXPECT_EQ(of_rover([](Robot& of) { of.proximity.rays_deg.resize(24); }),
            "24 proximity and 24 light sensors");
  EXPECT_EQ(of_rover([](Robot& of) { of.light.angles_deg = {0}; }),
            "8 proximity and 1 light sensor");
  EXPECT_EQ(of_rover([](Robot& of) {
              of.light.angles_deg = of.proximity.rays_deg;
              of.proximity.rays_deg.pop_back();
            }),
            "7 proximity and 8 light sensors");
  EXPECT_EQ(of_rover([](Robot& of) { of.light.angles_deg = of.proximity.rays_deg; }), "nothing");
  EXPECT_EQ(of_rover([](Robot& of) { of.light.reading = LightRing::Reading::Strength; }),
            "light sensors that give strengths");
  EXPECT_EQ(of_rover([](Robot& of) { of.ground.reading = GroundSensor::Reading::Vote; }),
            "ground sensors that vote");
  EXPECT_EQ(of_rover([](Robot& of) { of.neighbours.source = NeighbourSensor::Source::Radio; }),
            "a radio for neighbours");
}

}  // namespace
}  // namespace swarmsmith
