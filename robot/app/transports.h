#pragma once

#include <memory>
#include <string>
#include <vector>

#include "console/options.h"
#include "console/output.h"
#include "robot/transport/ends.h"

namespace swarmsmith {

/// The arguments that select a transport.
struct TransportWords {
  std::string transport;  ///< `ros` or `zeromq`
  std::vector<std::string> topics;
  // For ZeroMQ:
  std::string bind;             ///< address at which a node listens
  std::string keys;             ///< folder with the keys of a node
  std::vector<std::string> at;  ///< NAME=tcp://HOST:PORT for each robot
  std::string key;              ///< file with the key of a client

  void declare_node(Options& options);
  /// For worlds and operators.
  void declare_client(Options& options);

 private:
  void declare(Options& options);
};

/// Opens the ends selected by these arguments. `end` holds the options on which both ends must
/// agree. The address at which a node listens is printed.
Expected<std::unique_ptr<RobotEnd>> open_robot_end(const TransportWords& words,
                                                   const std::string& name, const EndOptions& end,
                                                   Output& output);
Expected<std::unique_ptr<WorldEnd>> open_world_end(const TransportWords& words,
                                                   const std::vector<std::string>& names,
                                                   const EndOptions& end);
Expected<std::unique_ptr<OperatorEnd>> open_operator_end(const TransportWords& words,
                                                         const std::vector<std::string>& names);

/// Declares `--wheels`.
void declare_wheels(Options& options, WheelsForm& wheels);

/// Exit code when an end cannot be opened: 2 for wrong arguments, otherwise 5.
ExitCode exit_code_of_transport(const Error& error);

}  // namespace swarmsmith
