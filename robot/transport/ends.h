#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/clock.h"
#include "robot/transport/messages.h"

namespace swarmsmith {

/// The three ends of what connects control software, drivers and operator. `receive` gives the
/// oldest message that was not taken yet; if there is none, it waits for one until `until`, and
/// then gives nothing. Sending never blocks; what only a transport says (troubles, rivals)
/// is not sent. One thread receives, any thread may send.

/// Which messages are kept until they are taken.
enum class Keep {
  Newest,  ///< of sensors and commands the newest; orders and states all: control in real time
  All,     ///< lock-step: no message may be lost
};

/// How speeds travel, where there is a choice (ros facts, 1.2 and 3.3).
enum class WheelsForm {
  Doubles,  ///< `wheels`
  Floats,   ///< `wheels_speed`, rounded to float32: the published driver's
  Twist,    ///< `cmd_vel`: speed and turn rate
};

/// Which sensors a node listens to, or a world sends.
struct SensorTopics {
  bool ranges = true;
  /// Eight topics `range_0`..`range_7` in place of one.
  bool ranges_apart = false;
  bool ground_color = true;
  bool scan = false;
  bool neighbours = false;
  bool light = false;
  bool battery = false;
  bool driven = false;  ///< what the driver of the treads says
  bool senses = false;  ///< lock-step by number; then none of the others is needed
};

/// What both ends must agree on.
struct EndOptions {
  Keep keep = Keep::Newest;
  SensorTopics sensors{};
  WheelsForm wheels = WheelsForm::Doubles;
};

/// Who gets the speeds of the treads.
struct Listener {
  std::string name;    ///< another one for each connection
  TimePoint heard{};   ///< its last sign of life
  bool drives = true;  ///< says that it is a driver; else it may as well only listen
};

/// A robot's node.
class RobotEnd {
 public:
  virtual ~RobotEnd() = default;
  virtual std::optional<ToRobot> receive(TimePoint until) = 0;
  virtual void send(const FromRobot& message) = 0;
  /// Drivers, a world and all others that get what this node commands.
  virtual std::vector<Listener> listeners() = 0;
  /// Whether there is one: what was sent before is lost.
  bool connected() { return !listeners().empty(); }
  /// Waits no longer than `most` for what was sent to go out. For the last command of a node.
  virtual void flush(Duration most) = 0;
};

/// The drivers of all robots, played by a simulated world. Robots are counted from 0, in the order
/// of their names.
class WorldEnd {
 public:
  struct Received {
    std::size_t robot = 0;  ///< of TroubleMessage: of no meaning when `robots()` or above
    FromRobot message;
  };

  virtual ~WorldEnd() = default;
  virtual std::size_t robots() const = 0;
  virtual const std::string& name(std::size_t robot) const = 0;
  virtual std::optional<Received> receive(TimePoint until) = 0;
  virtual void send(std::size_t robot, const ToRobot& message) = 0;
  /// Whether the robot's node listens to all that it needs: what was sent before is lost.
  virtual bool connected(std::size_t robot) = 0;
  virtual void flush(Duration most) = 0;
};

/// Who starts and stops the robots.
class OperatorEnd {
 public:
  struct Received {
    std::size_t robot = 0;  ///< as in WorldEnd
    std::variant<StateMessage, TroubleMessage> message;
  };

  virtual ~OperatorEnd() = default;
  virtual std::size_t robots() const = 0;
  virtual const std::string& name(std::size_t robot) const = 0;
  virtual std::optional<Received> receive(TimePoint until) = 0;
  /// To all robots.
  virtual void send(const OrderMessage& order) = 0;
  /// Whether the robot's node listens to orders.
  virtual bool connected(std::size_t robot) = 0;
  virtual void flush(Duration most) = 0;
};

}  // namespace swarmsmith
