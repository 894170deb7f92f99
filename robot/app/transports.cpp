#include "robot/app/transports.h"

#include "robot/ros/ros_ends.h"

namespace swarmsmith::cli {
namespace {

RosOptions ros_options(const TransportWords& words, const EndOptions& end) {
  return {.end = end, .remappings = words.topics};
}

}  // namespace

void TransportWords::declare(Options& options) {
  transport = "ros";
  options.choice("--transport", transport, {"ros"}, "How messages travel");
  options.texts("--topic", topics, "A topic's name of ours, :=, and the name it has, repeatable");
}

Expected<std::unique_ptr<RobotEnd>> open_robot_end(const TransportWords& words,
                                                   const std::string& name, const EndOptions& end) {
  return ros_robot_end(name, ros_options(words, end));
}

Expected<std::unique_ptr<OperatorEnd>> open_operator_end(const TransportWords& words,
                                                         const std::vector<std::string>& names) {
  return ros_operator_end(names, ros_options(words, {}));
}

}  // namespace swarmsmith::cli
