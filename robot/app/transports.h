#pragma once

#include <memory>
#include <string>
#include <vector>

#include "console/options.h"
#include "robot/transport/ends.h"

namespace swarmsmith::cli {

/// The words that say how messages travel.
struct TransportWords {
  std::string transport;  ///< `ros`
  std::vector<std::string> topics;

  void declare(Options& options);
};

/// The ends by those words. `end` is what both ends must agree on.
Expected<std::unique_ptr<RobotEnd>> open_robot_end(const TransportWords& words,
                                                   const std::string& name, const EndOptions& end);
Expected<std::unique_ptr<OperatorEnd>> open_operator_end(const TransportWords& words,
                                                         const std::vector<std::string>& names);

}  // namespace swarmsmith::cli
