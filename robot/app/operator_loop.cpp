#include "robot/app/operator_loop.h"

#include <fmt/format.h>
#include <unistd.h>

#include <random>

#include "base/text/json.h"
#include "base/text/text_table.h"
#include "robot/app/node_loop.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kShownDigest = 8;

std::string ages_text(const NodeState& state) {
  std::string text;
  for (const Feed feed : kAllFeeds) {
    const auto age = state.age_ms[index_of(feed)];
    if (!age) continue;
    if (!text.empty()) text += ", ";
    text += std::string(name_of(feed)) + (*age < 0 ? " never" : fmt::format(" {:.0f} ms", *age));
  }
  return text;
}

std::vector<std::string> row_of(const RolledRobot& robot, TimePoint now) {
  if (!robot.state) return {robot.name, "no answer", "", "", "", "", "", ""};
  const NodeState& state = *robot.state;
  const double heard_s = seconds_of(now - robot.heard);
  return {
      robot.name,
      heard_s > 1 ? fmt::format("silent for {:.0f} s", heard_s) : std::string(name_of(state.phase)),
      state.machine_digest.substr(0, kShownDigest),
      state.flavour,
      std::to_string(state.seed),
      robot.echoes > 0 ? fmt::format("{:+.1f} ms", 1000 * robot.offset_s) : "",
      state.battery ? fmt::format("{:.0f} %", 100 * *state.battery) : "",
      ages_text(state)};
}

}  // namespace

std::string operator_id() {
  std::random_device entropy;
  return fmt::format("{:08x}{:08x}", entropy(), entropy());
}

bool hear_states(OperatorEnd& end, TimePoint until,
                 const std::function<void(std::size_t, const NodeState&, const Now&)>& hear,
                 const std::function<void(const std::string&)>& note) {
  while (const auto received = end.receive(until)) {
    if (const auto* trouble = std::get_if<TroubleMessage>(&received->message)) {
      note(trouble->text);
      if (trouble->ended) return false;
      continue;
    }
    if (received->robot >= end.robots()) continue;
    const auto& message = std::get<StateMessage>(received->message);
    const auto state = parse_state(message.text);
    if (!state) {
      note(end.name(received->robot) + ": " + state.error().message);
      continue;
    }
    const Now now = now_on_both_clocks();
    // The time when it arrived, not when it was taken: it may have waited.
    const double waited_s = seconds_of(now.clock - message.arrival.at);
    hear(received->robot, *state, {message.arrival.at, now.unix_s - waited_s});
  }
  return true;
}

void send_order(OperatorEnd& end, const Order& order) {
  end.send(OrderMessage{.text = order_text(order)});
}

std::string roll_table(const RollCall& roll, TimePoint now) {
  TextTable table{.aligns = {Align::Left, Align::Left, Align::Left, Align::Left, Align::Right,
                             Align::Right, Align::Right, Align::Left},
                  .rows = {{"robot", "state", "machine", "flavour", "seed", "clock", "battery",
                            "age of readings"}}};
  for (const RolledRobot& robot : roll.robots())
    table.rows.push_back(row_of(robot, now));
  return aligned(std::move(table));
}

std::string roll_json(const RollCall& roll, TimePoint now) {
  return json_list(roll.robots(),
                   [now](const RolledRobot& robot) {
                     JsonObject json;
                     json.add("robot", robot.name);
                     json.add("heard_s_ago", robot.state
                                                 ? std::optional(seconds_of(now - robot.heard))
                                                 : std::optional<double>());
                     json.add("clock_offset_s", robot.echoes > 0 ? std::optional(robot.offset_s)
                                                                 : std::optional<double>());
                     json.add("echo_s", robot.echoes > 0 ? std::optional(robot.echo_s)
                                                         : std::optional<double>());
                     json.add("state", robot.state ? JsonPiece{state_text(*robot.state)}
                                                   : JsonPiece{"null"});
                     return json;
                   })
      .text;
}

}  // namespace swarmsmith
