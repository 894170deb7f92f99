#include "robot/ros/ros_ends.h"

namespace swarmsmith {

namespace {

tl::unexpected<RosError> missing() {
  return tl::unexpected<RosError>(
      {RosError::Kind::Unavailable,
       "this program was built without ROS; install libroscpp-dev, libstd-msgs-dev, "
       "libsensor-msgs-dev, libgeometry-msgs-dev and libnav-msgs-dev, build it again, "
       "or connect over ZeroMQ",
       {}});
}

}  // namespace

bool has_ros() {
  return false;
}

RosExpected<std::unique_ptr<RobotEnd>> ros_robot_end(const std::string& /*name*/,
                                                     const RosOptions& /*options*/) {
  return missing();
}

RosExpected<std::unique_ptr<WorldEnd>> ros_world_end(const std::vector<std::string>& /*names*/,
                                                     const RosOptions& /*options*/) {
  return missing();
}

RosExpected<std::unique_ptr<OperatorEnd>> ros_operator_end(
    const std::vector<std::string>& /*names*/, const RosOptions& /*options*/) {
  return missing();
}

}  // namespace swarmsmith
