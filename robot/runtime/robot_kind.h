#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sim/robot/robot.h"

namespace swarmsmith {

/// Which robot a node drives, as data (docs/robots.md): a machine, an order or a mission for
/// another robot is refused. Outlines of RVRs do not count.

/// The reason, as a sentence, why the node of a robot refuses something for the robot `wanted`,
/// with both names and what to do; nothing when it is the same robot. `what` is refused: "the
/// order".
std::optional<std::string> other_robot(std::string_view what, const Robot& wanted,
                                       const Robot& driven);

/// The reason, as a sentence, why nodes cannot drive the robot; nothing when they can: its sensors
/// must give the readings of docs/robot-messages.md.
std::optional<std::string> no_node_drives(const Robot& robot);

}  // namespace swarmsmith
