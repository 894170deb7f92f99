#pragma once

#include <memory>
#include <string>
#include <vector>

#include "console/options.h"
#include "robot/transport/ends.h"

namespace swarmsmith::cli {

/// The words that say how messages travel.
struct TransportWords {
  std::string transport = "ros";             ///< or `zmq`
  std::vector<std::string> topics;           ///< of ROS: `ranges:=/teraranger/ranges`
  std::string listen = "tcp://127.0.0.1:*";  ///< of ZeroMQ, a node's address
  std::string keys;                          ///< folder, of a node; empty: none
  std::vector<std::string> places;           ///< of nodes: `rvr1=tcp://10.0.0.11:5611`
  std::string key;                           ///< file, of an operator or a world

  void declare_for_node(Options& options);
  void declare_for_others(Options& options);
};

struct OpenedRobot {
  std::unique_ptr<RobotEnd> end;
  std::string endpoint;  ///< where it listens; empty over ROS
};

/// The ends by those words; `options` is what both ends must agree on. Errors of kind BadInput are
/// wrong words, all others are trouble on the way.
Expected<OpenedRobot> open_robot_end(const TransportWords& words, const std::string& name,
                                     const EndOptions& options);
Expected<std::unique_ptr<WorldEnd>> open_world_end(const TransportWords& words,
                                                   const std::vector<std::string>& names,
                                                   const EndOptions& options);
Expected<std::unique_ptr<OperatorEnd>> open_operator_end(const TransportWords& words,
                                                         const std::vector<std::string>& names);

/// What to exit with when an end cannot be opened.
ExitCode exit_code_of_transport(const Error& error);

}  // namespace swarmsmith::cli
