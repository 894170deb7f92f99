#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/clock.h"
#include "robot/transport/messages.h"

namespace swarmsmith {

/// The three ends of a connection between control software, drivers and operator. `receive` gives
/// the oldest message that was not yet taken; if there is none, it waits for one until `until`, and
/// then gives nothing. Sending never blocks. Messages that originate in the transport (troubles,
/// rivals) cannot be sent. One thread receives, any thread may send.

/// Which messages are kept until they are taken.
enum class Keep {
  Newest,  ///< the newest of sensors and commands, and all orders and states: for control in real
           ///< time
  All,     ///< all messages: for lock-step, in which none may be lost
};

/// The format of wheel speeds, if there is a choice (ros facts, 1.2 and 3.3).
enum class WheelsForm {
  Doubles,  ///< `wheels`
  Floats,   ///< `wheels_speed`, rounded to float32, as in the published driver
  Twist,    ///< `cmd_vel`: speed and turn rate
};

/// The sensors to which a node subscribes, or which a world sends.
struct SensorTopics {
  bool ranges = true;
  /// Eight topics `range_0`..`range_7` instead of one.
  bool ranges_apart = false;
  bool ground_color = true;
  bool scan = false;
  bool neighbours = false;
  bool light = false;
  bool battery = false;
  bool driven = false;  ///< the reports of the treads' driver
  bool senses = false;  ///< numbered lock-step; it needs none of the others
};

/// Options on which both ends must agree.
struct EndOptions {
  Keep keep = Keep::Newest;
  SensorTopics sensors{};
  WheelsForm wheels = WheelsForm::Doubles;
};

/// A receiver of the tread speeds.
struct Listener {
  std::string name;    ///< different for each connection
  TimePoint heard{};   ///< time of its last sign of life
  bool drives = true;  ///< it declares itself a driver; otherwise it may be a mere listener
};

/// A robot's node.
class RobotEnd {
 public:
  virtual ~RobotEnd() = default;
  virtual std::optional<ToRobot> receive(TimePoint until) = 0;
  virtual void send(const FromRobot& message) = 0;
  /// Drivers, a world and all others that receive the commands of this node.
  virtual std::vector<Listener> listeners() = 0;
  /// Whether there is a listener; messages sent before were lost.
  bool connected() { return !listeners().empty(); }
  /// Waits at most `most` until sent messages have gone out. For the last command of a node.
  virtual void flush(Duration most) = 0;
};

/// A simulated world that replaces the drivers of all robots. Robots are numbered from 0, in the
/// order of their names.
class WorldEnd {
 public:
  struct Received {
    std::size_t robot = 0;  ///< meaningless for a TroubleMessage if it is `robots()` or above
    FromRobot message;
  };

  virtual ~WorldEnd() = default;
  virtual std::size_t robots() const = 0;
  virtual const std::string& name(std::size_t robot) const = 0;
  virtual std::optional<Received> receive(TimePoint until) = 0;
  virtual void send(std::size_t robot, const ToRobot& message) = 0;
  /// Whether the robot's node is subscribed to all the topics it needs; messages sent before were
  /// lost.
  virtual bool connected(std::size_t robot) = 0;
  virtual void flush(Duration most) = 0;
};

/// The operator, who starts and stops the robots.
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
  /// Sends an order to all robots.
  virtual void send(const OrderMessage& order) = 0;
  /// Whether the robot's node is subscribed to orders.
  virtual bool connected(std::size_t robot) = 0;
  virtual void flush(Duration most) = 0;
};

}  // namespace swarmsmith
