#include "robot/runtime/order.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/text/json.h"

namespace swarmsmith {
namespace {

constexpr std::array<std::string_view, 5> kKinds = {"start", "stop", "kill", "alive", "echo"};
/// Clocks that differ by more start nothing together.
constexpr double kMostAhead_s = 1;

double number_of(const nlohmann::json& json, const char* key, double otherwise) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_number()) return otherwise;
  return found->get<double>();
}

std::string text_of_key(const nlohmann::json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

constexpr std::array<std::string_view, 10> kKeys = {
    "order",   "id",        "run",     "robots", "sent_unix_s",
    "valid_s", "at_unix_s", "seconds", "seed",   "clock_offsets_s"};

/// "`sed`, `robot`".
std::string unknown_keys(const nlohmann::json& json) {
  std::string text;
  for (const auto& [key, value] : json.items()) {
    if (std::ranges::find(kKeys, key) != kKeys.end()) continue;
    text += (text.empty() ? "`" : ", `") + key + "`";
  }
  return text;
}

Expected<void> check_start(const Order& order) {
  if (!order.unknown_keys.empty()) {
    return bad_input("a start has no key " + order.unknown_keys +
                     ": a run that is not the one that was meant does not begin");
  }

  if (!is_plain_name(order.run))
    return bad_input("a start needs a run's name of letters, digits, - and _");
  if (!(order.seconds > 0 && order.seconds <= 86'400))
    return bad_input("a start needs `seconds`, more than 0 and at most a day");
  return {};
}

}  // namespace

std::string_view name_of(Order::Kind kind) {
  return kKinds[static_cast<std::size_t>(kind)];
}

std::string order_text(const Order& order) {
  JsonObject json;
  json.add("order", name_of(order.kind)).add("id", order.id).add("run", order.run);
  if (!order.robots.empty()) json.add("robots", order.robots);
  json.add("sent_unix_s", order.sent_unix_s).add("valid_s", order.valid_s);
  if (order.kind == Order::Kind::Start) {
    json.add("at_unix_s", order.at_unix_s).add("seconds", order.seconds);
    if (order.seed) json.add("seed", *order.seed);
    JsonObject offsets;
    for (const auto& [robot, offset] : order.clock_offsets_s)
      offsets.add(robot, offset);
    json.add("clock_offsets_s", offsets);
  }
  return json.text();
}

Expected<Order> parse_order(std::string_view text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return bad_input("an order is a JSON object");
  const std::string kind = text_of_key(json, "order");
  const auto* known = std::ranges::find(kKinds, kind);
  if (known == kKinds.end()) return bad_input("there is no order `" + kind + "`");
  Order order;
  order.kind = static_cast<Order::Kind>(known - kKinds.begin());
  order.unknown_keys = unknown_keys(json);
  order.id = text_of_key(json, "id");
  if (order.id.empty()) return bad_input("an order needs an `id`");
  order.run = text_of_key(json, "run");
  if (const auto robots = json.find("robots"); robots != json.end()) {
    if (!robots->is_array()) return bad_input("`robots` is a list of names");
    for (const auto& robot : *robots) {
      if (!robot.is_string()) return bad_input("`robots` is a list of names");
      order.robots.push_back(robot.get<std::string>());
    }
  }
  order.sent_unix_s = number_of(json, "sent_unix_s", 0);
  order.valid_s = std::clamp(number_of(json, "valid_s", 1), 0.0, 10.0);
  order.at_unix_s = number_of(json, "at_unix_s", 0);
  order.seconds = number_of(json, "seconds", 0);
  if (const auto seed = json.find("seed"); seed != json.end()) {
    if (!seed->is_number_integer()) return bad_input("`seed` is an integer");
    order.seed = seed->get<std::int64_t>();
  }
  if (const auto offsets = json.find("clock_offsets_s");
      offsets != json.end() && offsets->is_object()) {
    for (const auto& [robot, offset] : offsets->items()) {
      if (offset.is_number()) order.clock_offsets_s[robot] = offset.get<double>();
    }
  }
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

std::optional<std::string> OrderDoor::refusal(const Order& order, double now_unix_s) {
  if (order.kind == Order::Kind::Stop || order.kind == Order::Kind::Kill) return std::nullopt;
  const double age_s = now_unix_s - order.sent_unix_s;
  if (!(age_s <= order.valid_s))
    return fmt::format("the order is {:.1f} s old and was valid for {:.1f} s", age_s,
                       order.valid_s);
  if (age_s < -kMostAhead_s)
    return fmt::format("the order comes from {:.1f} s ahead: the clocks differ", -age_s);
  if (order.kind == Order::Kind::Start && !starts_.insert(order.id).second)
    return "the order was given before";
  return std::nullopt;
}

}  // namespace swarmsmith
