#pragma once

#include <memory>
#include <string>
#include <vector>

#include "robot/transport/ends.h"

namespace swarmsmith {

/// All ends of a swarm in one process, for tests: messages arrive immediately, with the same bits.
/// Each end may be used by its own thread; ends must not outlive the swarm.
class InProcessSwarm {
 public:
  explicit InProcessSwarm(std::vector<std::string> names, Keep keep = Keep::All);
  ~InProcessSwarm();

  RobotEnd& robot(std::size_t robot);
  WorldEnd& world();
  OperatorEnd& operator_end();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swarmsmith
