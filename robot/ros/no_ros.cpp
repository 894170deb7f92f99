#include "robot/ros/ros_ends.h"

namespace swarmsmith {

namespace {

Unexpected missing() {
  return unexpected(ErrorKind::Unavailable,
                    "this program was built without ROS; install libroscpp-dev, libstd-msgs-dev, "
                    "libsensor-msgs-dev and libgeometry-msgs-dev, build it again, "
                    "or connect over ZeroMQ");
}

}  // namespace

bool has_ros() {
  return false;
}

Expected<std::unique_ptr<RobotEnd>> ros_robot_end(const std::string& /*name*/,
                                                  const RosOptions& /*options*/) {
  return missing();
}

Expected<std::unique_ptr<WorldEnd>> ros_world_end(const std::vector<std::string>& /*names*/,
                                                  const RosOptions& /*options*/) {
  return missing();
}

Expected<std::unique_ptr<OperatorEnd>> ros_operator_end(const std::vector<std::string>& /*names*/,
                                                        const RosOptions& /*options*/) {
  return missing();
}

}  // namespace swarmsmith
