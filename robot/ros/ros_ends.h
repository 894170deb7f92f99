#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/expected.h"
#include "robot/transport/ends.h"

namespace swarmsmith {

/// The three ends over ROS 1 topics (docs/robot-messages.md has their names and types). A process
/// can have one end: ROS keeps one node a process. The master is found as ROS has it, by
/// ROS_MASTER_URI; others find this node by ROS_IP or ROS_HOSTNAME.

struct RosOptions {
  EndOptions end{};
  /// `ranges:=/teraranger/ranges`: ours, then whatever name the driver uses.
  std::vector<std::string> remappings{};
  /// Until a master answers.
  Duration master_patience = std::chrono::seconds(10);
};

/// Whether this program was built with ROS; without, all that follow are Unavailable, and say so.
bool has_ros();

/// The node /NAME/control. BadInput: a name or remapping that ROS does not take. Unavailable: no
/// master answers. Conflict: this process has an end.
Expected<std::unique_ptr<RobotEnd>> ros_robot_end(const std::string& name,
                                                  const RosOptions& options);

/// The node /world, with the topics of all robots.
Expected<std::unique_ptr<WorldEnd>> ros_world_end(const std::vector<std::string>& names,
                                                  const RosOptions& options);

/// A node /operator_..., whose name no other node has.
Expected<std::unique_ptr<OperatorEnd>> ros_operator_end(const std::vector<std::string>& names,
                                                        const RosOptions& options);

}  // namespace swarmsmith
