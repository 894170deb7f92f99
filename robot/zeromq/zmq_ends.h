#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "proto/curve.h"
#include "robot/transport/ends.h"

namespace swarmsmith {

/// The three ends over ZeroMQ, for laboratories without ROS: each node listens at an address of its
/// own, and drivers, worlds and operators connect to it (docs/robot-messages.md). With keys,
/// connections are encrypted, and the key says who may do what: a worker's feeds sensors and gets
/// commands, an operator's gives orders. Without, all clients may do all; loopback only.

struct NodeServerOptions {
  EndOptions end{};
  std::string endpoint = "tcp://127.0.0.1:*";
  std::optional<ServerKeys> keys{};
};

/// A node's end, and where it really listens.
struct NodeServer {
  std::unique_ptr<RobotEnd> end;
  std::string endpoint;
};

/// Conflict: the address is taken, by another node of this robot, say. BadInput: it is reachable
/// from other hosts, and there are no keys.
Expected<NodeServer> zmq_robot_end(const std::string& name, NodeServerOptions options);

/// Where a robot's node listens.
struct RobotPlace {
  std::string name;
  std::string endpoint;  ///< tcp://HOST:PORT
};

struct NodeClientOptions {
  EndOptions end{};
  std::optional<ClientKeys> keys{};
};

/// Connections are made again whenever they break.
Expected<std::unique_ptr<WorldEnd>> zmq_world_end(std::vector<RobotPlace> robots,
                                                  const NodeClientOptions& options);
Expected<std::unique_ptr<OperatorEnd>> zmq_operator_end(std::vector<RobotPlace> robots,
                                                        const NodeClientOptions& options);

}  // namespace swarmsmith
