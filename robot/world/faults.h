#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/expected.h"
#include "robot/transport/messages.h"

namespace swarmsmith {

/// A temporary fault of one sensor of one robot in a simulated world, so that people and tests can
/// see how robots react.
struct Fault {
  enum class Kind {
    Silent,  ///< no messages
    Nan,     ///< values are NaN
    Length,  ///< `length` values
    Turned,  ///< the lidar's zero is at the back: its values begin at -pi
  };

  std::string robot;
  std::string sensor;  ///< its topic
  Kind kind = Kind::Silent;
  int length = 0;
  double from_s = 0;  ///< in the time of the run, inclusive
  double to_s = 0;    ///< exclusive; infinity: permanent

  bool at(double time_s) const { return from_s <= time_s && time_s < to_s; }
  friend bool operator==(const Fault&, const Fault&) = default;
};

/// Parses a fault such as "rvr1:ranges:silent:10-10.3" or "rvr2:scan:500:0-": robot, sensor
/// (ranges, ground_color, scan, neighbours, light), kind (silent, nan, turned or a number of
/// values), and start and end in seconds of the run.
Expected<Fault> parse_fault(std::string_view text);

/// Applies the faults of a robot to its messages; nothing: the message is not sent.
class FaultySensors {
 public:
  FaultySensors(std::vector<Fault> faults, const std::string& robot);

  std::optional<ToRobot> pass(ToRobot message, double time_s) const;

 private:
  std::vector<Fault> faults_;
};

}  // namespace swarmsmith
