#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/expected.h"
#include "robot/transport/ends.h"

namespace swarmsmith {

/// The three ends over ROS 1 topics (docs/robot-messages.md has their names and types). A process
/// can have only one end, because ROS allows one node per process. The address of the master comes
/// from ROS_MASTER_URI, as usual in ROS; others find this node by ROS_IP or ROS_HOSTNAME.

struct RosOptions {
  EndOptions end{};
  /// Such as `ranges:=/teraranger/ranges`: the name in this program, then the driver's name.
  std::vector<std::string> remappings{};
  /// How long to wait for a master.
  Duration master_patience = std::chrono::seconds(10);
};

/// Whether this program was built with ROS. Without it, the functions below return Unavailable with
/// this reason.
bool has_ros();

/// The node /NAME/control. BadInput: ROS does not accept a name or remapping. Unavailable: no
/// master answers. Conflict: this process already has an end.
Expected<std::unique_ptr<RobotEnd>> ros_robot_end(const std::string& name,
                                                  const RosOptions& options);

/// The node /world, with the topics of all robots.
Expected<std::unique_ptr<WorldEnd>> ros_world_end(const std::vector<std::string>& names,
                                                  const RosOptions& options);

/// A node /operator_..., with a unique name.
Expected<std::unique_ptr<OperatorEnd>> ros_operator_end(const std::vector<std::string>& names,
                                                        const RosOptions& options);

}  // namespace swarmsmith
