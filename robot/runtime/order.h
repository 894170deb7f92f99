#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "robot/runtime/sensed.h"

namespace swarmsmith {

/// An operator's order to the robots. Orders only begin and end runs: control software does not
/// receive them.
struct Order {
  enum class Kind {
    Start,
    Stop,   ///< ends the run
    Kill,   ///< ends the run; the node then refuses to start until it is restarted
    Alive,  ///< sign of life of the operator, several times a second during a run
    Echo,   ///< requests the state immediately
  };
  Kind kind = Kind::Echo;
  std::string id;                    ///< of the order; never reused
  std::string run;                   ///< "run07"; if empty, Stop is for any run
  std::vector<std::string> robots;   ///< the robots that must obey it; empty: all
  double sent_unix_s = 0;            ///< by the operator's clock
  double valid_s = 1;                ///< seconds after which it is refused
  double at_unix_s = 0;              ///< of Start: the agreed instant
  double seconds = 0;                ///< of Start: duration of the run
  std::optional<std::int64_t> seed;  ///< of Start: replaces the nodes' own seeds
  /// Of Start: the robot that the run is for, as the text of `own_robot_text`; empty: RVRs.
  std::string own_robot;
  /// Of Start: each robot's wall clock minus the operator's, as measured.
  std::map<std::string, double> clock_offsets_s;

  std::string unknown_keys;  ///< unknown keys in an order that was read, such as "`sed`"; empty:
                             ///< none

  friend bool operator==(const Order&, const Order&) = default;
};

constexpr auto names_of(Order::Kind) {
  return std::to_array<std::string_view>({"start", "stop", "kill", "alive", "echo"});
}

/// Visits the fields in the order in which they are sent, each with its key and whether it is
/// written.
template <class AnyOrder, class Field>
void visit_order_fields(AnyOrder& order, Field& field) {
  const bool starts = order.kind == Order::Kind::Start;
  field("order", order.kind);
  field("id", order.id);
  field("run", order.run);
  field("robots", order.robots, !order.robots.empty());
  field("sent_unix_s", order.sent_unix_s);
  field("valid_s", order.valid_s);
  field("at_unix_s", order.at_unix_s, starts);
  field("seconds", order.seconds, starts);
  field("seed", order.seed, starts && order.seed);
  field("own_robot", order.own_robot, starts && !order.own_robot.empty());
  field("clock_offsets_s", order.clock_offsets_s, starts);
}

/// Converts an order to JSON, and back.
std::string order_text(const Order& order);
Expected<Order> parse_order(std::string_view text);

/// Whether the name of a run or a robot can be part of a file name: letters, digits, - and _.
bool is_plain_name(std::string_view name);

/// Decides which orders a node may obey at all, in any phase.
class OrderDoor {
 public:
  explicit OrderDoor(std::string robot) : robot_(std::move(robot)) {}

  /// The reason for refusing the order: it is too old, comes from a clock far ahead, or is a start
  /// that was given before. Orders that stop a robot are obeyed at any age. Remembers starts.
  std::optional<std::string> refusal(const Order& order, double now_unix_s);
  bool is_for_this_robot(const Order& order) const;

 private:
  std::string robot_;
  std::set<std::string, std::less<>> starts_;  ///< their ids
};

}  // namespace swarmsmith
