#include "robot/runtime/robot_kind.h"

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
  EXPECT_THAT(no_node_drives(value_of(find_robot("epuck", {}))).value_or(""),
              AllOf(HasSubstr("the robot `epuck` has proximity sensors that give strengths"),
                    HasSubstr("swarmsmith evaluate")));
  Robot robot = rover();
  robot.proximity.rays_deg.pop_back();
  EXPECT_THAT(no_node_drives(robot).value_or(""), HasSubstr("7 proximity and 7 light sensors"));
  robot.proximity.rays_deg.resize(24);
  EXPECT_THAT(no_node_drives(robot).value_or(""), HasSubstr("24 proximity and 24 light sensors"));
  robot = rover();
  robot.light.reading = LightRing::Reading::Strength;
  EXPECT_THAT(no_node_drives(robot).value_or(""), HasSubstr("light sensors that give strengths"));
  robot = rover();
  robot.ground.reading = GroundSensor::Reading::Vote;
  EXPECT_THAT(no_node_drives(robot).value_or(""), HasSubstr("ground sensors that vote"));
  robot = rover();
  robot.neighbours.source = NeighbourSensor::Source::Radio;
  EXPECT_THAT(no_node_drives(robot).value_or(""), HasSubstr("a radio"));
}

}  // namespace
}  // namespace swarmsmith
