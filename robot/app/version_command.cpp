#include "base/text/json.h"
#include "robot/app/commands.h"
#include "robot/ros/ros_ends.h"

namespace swarmsmith {

std::string robot_program_name() {
  return "swarmsmith-robot " SWARMSMITH_VERSION;
}

CommandRun declare_robot_version(Options&) {
  return [](Output& output) {
    if (output.json) {
      output.out << JsonObject()
                        .add("name", "swarmsmith-robot")
                        .add("version", SWARMSMITH_VERSION)
                        .add("ros", has_ros())
                        .text()
                 << "\n";
    } else {
      output.out << robot_program_name() << (has_ros() ? ", with ROS 1" : ", without ROS") << "\n";
    }
    return ExitCode::Done;
  };
}

}  // namespace swarmsmith
