#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "proto/curve.h"
#include "robot/transport/ends.h"

namespace swarmsmith {

/// The three ends over ZeroMQ, for laboratories without ROS: each node listens at its own address,
/// and drivers, worlds and operators connect to it (docs/robot-messages.md). With keys, connections
/// are encrypted, and the key decides what a client may do: with a worker's key it sends sensor
/// readings and gets commands, with an operator's key it gives orders. Without keys all clients may
/// do everything, and only loopback addresses are allowed.

struct NodeServerOptions {
  EndOptions end{};
  std::string endpoint = "tcp://127.0.0.1:*";
  std::optional<ServerKeys> keys{};
  /// If set, called several times a second by the end's thread: the new list of clients, if it has
  /// changed. Clients that are no longer in it are disconnected.
  std::function<std::optional<std::vector<ListedClient>>()> new_clients{};
};

/// A node's end, with the actual address at which it listens.
struct NodeServer {
  std::unique_ptr<RobotEnd> end;
  std::string endpoint;
};

/// Conflict: the address is in use, for example by another node of this robot. BadInput: other
/// hosts can reach the address, and there are no keys.
Expected<NodeServer> zmq_robot_end(const std::string& name, NodeServerOptions options);

/// The address of a robot's node.
struct RobotPlace {
  std::string name;
  std::string endpoint;  ///< tcp://HOST:PORT
};

struct NodeClientOptions {
  EndOptions end{};
  std::optional<ClientKeys> keys{};
};

/// Broken connections are made again.
Expected<std::unique_ptr<WorldEnd>> zmq_world_end(std::vector<RobotPlace> robots,
                                                  const NodeClientOptions& options);
Expected<std::unique_ptr<OperatorEnd>> zmq_operator_end(std::vector<RobotPlace> robots,
                                                        const NodeClientOptions& options);

}  // namespace swarmsmith
