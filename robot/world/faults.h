#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/expected.h"
#include "robot/transport/messages.h"

namespace swarmsmith {

/// What a simulated world does to one sensor of one robot for a while, so that people and tests see
/// what their robots do then.
struct Fault {
  enum class Kind {
    Silent,  ///< sends nothing
    Nan,     ///< sends no numbers
    Length,  ///< sends `length` values
    Turned,  ///< the lidar's zero is behind: its values begin at -pi
  };

  std::string robot;
  std::string sensor;  ///< its topic
  Kind kind = Kind::Silent;
  int length = 0;
  double from_s = 0;  ///< of the run, inclusive
  double to_s = 0;    ///< exclusive; infinity: for good

  bool at(double time_s) const { return from_s <= time_s && time_s < to_s; }
  friend bool operator==(const Fault&, const Fault&) = default;
};

/// "rvr1:ranges:silent:10-10.3", "rvr2:scan:500:0-": robot, sensor (ranges, ground_color, scan,
/// neighbours, light), what happens to it (silent, nan, turned or a number of values), and from
/// when until when, in seconds of the run.
Expected<Fault> parse_fault(std::string_view text);

/// The messages as a robot's faults leave them; nothing: it is not sent.
class FaultySensors {
 public:
  FaultySensors(std::vector<Fault> faults, const std::string& robot);

  std::optional<ToRobot> pass(ToRobot message, double time_s) const;

 private:
  std::vector<Fault> faults_;
};

}  // namespace swarmsmith
