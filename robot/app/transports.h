#pragma once

#include <memory>
#include <string>
#include <vector>

#include "console/options.h"
#include "console/output.h"
#include "robot/transport/ends.h"

namespace swarmsmith {

/// The words that say how messages travel.
struct TransportWords {
  std::string transport;  ///< `ros` or `zeromq`
  std::vector<std::string> topics;
  // Of ZeroMQ:
  std::string bind;             ///< where a node listens
  std::string keys;             ///< folder with a node's keys
  std::vector<std::string> at;  ///< NAME=tcp://HOST:PORT of each robot
  std::string key;              ///< file with a client's key

  void declare_node(Options& options);
  /// Of worlds and operators.
  void declare_client(Options& options);

 private:
  void declare(Options& options);
};

/// The ends by those words. `end` is what both ends must agree on. Where a node listens is printed.
Expected<std::unique_ptr<RobotEnd>> open_robot_end(const TransportWords& words,
                                                   const std::string& name, const EndOptions& end,
                                                   Output& output);
Expected<std::unique_ptr<WorldEnd>> open_world_end(const TransportWords& words,
                                                   const std::vector<std::string>& names,
                                                   const EndOptions& end);
Expected<std::unique_ptr<OperatorEnd>> open_operator_end(const TransportWords& words,
                                                         const std::vector<std::string>& names);

/// `--wheels`.
void declare_wheels(Options& options, WheelsForm& wheels);

/// What to exit with when an end cannot be opened: 2 for wrong words, else 5.
ExitCode exit_code_of_transport(const Error& error);

}  // namespace swarmsmith
