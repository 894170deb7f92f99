#include "robot/runtime/order.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "robot/runtime/internal/json_fields.h"

namespace swarmsmith {
namespace {

/// If clocks differ by more than this, robots cannot start at the same time.
constexpr double kMostAhead_s = 1;

/// Only a start is refused for an unknown key: an order that stops a robot must act even if a newer
/// program has added something to it.
Expected<void> check_start(const Order& order) {
  if (!order.unknown_keys.empty()) {
    return bad_input("a start has the unknown key " + order.unknown_keys +
                     "; the run does not begin, because it could be another one than was meant");
  }
  // The name becomes a part of file names.
  if (!is_plain_name(order.run))
    return bad_input("a start needs a run's name of letters, digits, - and _");
  // Written so that NaN is refused.
  if (!(order.seconds > 0 && order.seconds <= 86'400))
    return bad_input("a start needs `seconds`, more than 0 and at most a day");
  return {};
}

}  // namespace

std::string order_text(const Order& order) {
  JsonFieldWriter writer;
  visit_order_fields(order, writer);
  return writer.text();
}

Expected<Order> parse_order(std::string_view text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return bad_input("an order is a JSON object");
  JsonFieldReader reader(json);
  Order order;
  visit_order_fields(order, reader);
  if (!reader.error().empty()) return bad_input(reader.error());
  if (order.id.empty()) return bad_input("an order needs an `id`");
  // The robots and the seed of an order, and the kind of robot, must not be guessed.
  if (json.contains("robots") &&
      (!json["robots"].is_array() || json["robots"].size() != order.robots.size()))
    return bad_input("`robots` is a list of names");
  if (json.contains("seed") && !order.seed) return bad_input("`seed` is an integer");
  if (json.contains("own_robot") && !json["own_robot"].is_string())
    return bad_input("`own_robot` is a text, a robot as TOML");
  order.unknown_keys = reader.unknown_keys();
  // A sender cannot make an order that is valid for ever: it could be played back.
  order.valid_s = std::clamp(order.valid_s, 0.0, 10.0);
  if (order.kind == Order::Kind::Start) {
    if (const auto right = check_start(order); !right) return Unexpected(right.error());
  }
  return order;
}

bool is_plain_name(std::string_view name) {
  return !name.empty() && name.size() <= 100 && std::ranges::all_of(name, [](char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
           (letter >= '0' && letter <= '9') || letter == '-' || letter == '_';
  });
}

bool OrderDoor::is_for_this_robot(const Order& order) const {
  return order.robots.empty() || std::ranges::find(order.robots, robot_) != order.robots.end();
}

// ROS facts, 3.7: a message that is latched, delayed or played back must not move a robot.
std::optional<std::string> OrderDoor::refusal(const Order& order, double now_unix_s) {
  // What stops a robot is obeyed however old it is (decision 22).
  if (order.kind == Order::Kind::Stop || order.kind == Order::Kind::Kill) return std::nullopt;
  const double age_s = now_unix_s - order.sent_unix_s;
  if (!(age_s <= order.valid_s))
    return fmt::format("the order is {:.1f} s old and was valid for {:.1f} s", age_s,
                       order.valid_s);
  if (age_s < -kMostAhead_s)
    return fmt::format("the order's time is {:.1f} s in the future: the clocks differ", -age_s);
  // The id is used up, also if the node then refuses the start for another reason.
  if (order.kind == Order::Kind::Start && !starts_.insert(order.id).second)
    return "this order came before";
  return std::nullopt;
}

}  // namespace swarmsmith
