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

/// What an operator tells the robots. Orders only begin and end runs: control software hears
/// nothing of them.
struct Order {
  enum class Kind {
    Start,
    Stop,   ///< ends the run
    Kill,   ///< ends it, and nothing starts any more until the node is restarted
    Alive,  ///< the operator is there; comes several times a second during a run
    Echo,   ///< asks for the state at once
  };
  Kind kind = Kind::Echo;
  std::string id;                    ///< of the order, never used twice
  std::string run;                   ///< "run07"; of Stop empty: whatever run it is
  std::vector<std::string> robots;   ///< the robots it is for; empty: all
  double sent_unix_s = 0;            ///< by the operator's clock
  double valid_s = 1;                ///< who gets it later refuses it
  double at_unix_s = 0;              ///< of Start: the agreed instant
  double seconds = 0;                ///< of Start: how long the run lasts
  std::optional<std::int64_t> seed;  ///< of Start: in place of the nodes' own
  /// Of Start: a robot's wall clock minus the operator's, as measured.
  std::map<std::string, double> clock_offsets_s;

  std::string unknown_keys;  ///< of an order that was read: "`sed`"; empty: it has none

  friend bool operator==(const Order&, const Order&) = default;
};

constexpr auto names_of(Order::Kind) {
  return std::to_array<std::string_view>({"start", "stop", "kill", "alive", "echo"});
}

/// The fields in the order in which they travel, each with its key and whether it is written.
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
  field("clock_offsets_s", order.clock_offsets_s, starts);
}

/// As JSON, and back.
std::string order_text(const Order& order);
Expected<Order> parse_order(std::string_view text);

/// Whether a name of a run or a robot can be part of a file's name: letters, digits, - and _.
bool is_plain_name(std::string_view name);

/// Which orders a node may obey at all, whatever it is doing.
class OrderDoor {
 public:
  explicit OrderDoor(std::string robot) : robot_(std::move(robot)) {}

  /// Why not: too old, from a clock far ahead, or a start that was given before. What stops a robot
  /// is obeyed however old it is. Remembers starts.
  std::optional<std::string> refusal(const Order& order, double now_unix_s);
  bool is_for_this_robot(const Order& order) const;

 private:
  std::string robot_;
  std::set<std::string, std::less<>> starts_;  ///< their ids
};

}  // namespace swarmsmith
