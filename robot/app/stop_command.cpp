#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "robot/app/commands.h"
#include "robot/app/node_loop.h"
#include "robot/app/operator_loop.h"
#include "robot/app/robot_names.h"
#include "robot/app/transports.h"

namespace swarmsmith {
namespace {

constexpr Duration kAgainEvery = std::chrono::milliseconds(200);
constexpr Duration kPatience = std::chrono::seconds(5);

struct StopWords {
  std::string robots;
  bool kill = false;
  TransportWords transport;
};

/// Repeats the order to stop until each robot stands still, whatever its run is.
ExitCode stop(const StopWords& words, Output& output) {
  const auto names = robot_names(words.robots);
  if (!names) return fail(output, ExitCode::Usage, names.error());
  const auto end = open_operator_end(words.transport, *names);
  if (!end) return fail(output, exit_code_of_transport(end.error()), end.error());
  const std::string id = operator_id();
  std::vector<std::optional<NodeState>> states(names->size());
  int sent = 0;
  const auto obeyed = [&](const std::optional<NodeState>& state) {
    const bool heard = state && state->order.starts_with(id);
    return heard && state->phase != Phase::Armed && state->phase != Phase::Running;
  };
  const TimePoint until = now_on_both_clocks().clock + kPatience;
  bool connected = true;
  while (connected && !std::ranges::all_of(states, obeyed)) {
    const Now now = now_on_both_clocks();
    if (now.clock >= until) break;
    Order order;
    order.kind = words.kill ? Order::Kind::Kill : Order::Kind::Stop;
    order.id = fmt::format("{}-{}", id, ++sent);
    order.robots = *names;
    order.sent_unix_s = now.unix_s;
    send_order(**end, order);
    connected = hear_states(
        **end, now.clock + kAgainEvery,
        [&states](std::size_t robot, const NodeState& state, const Now&) { states[robot] = state; },
        [&output](const std::string& text) { print_note(output, text); });
  }
  (*end)->flush(std::chrono::seconds(1));
  ExitCode code = ExitCode::Done;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (obeyed(states[i])) {
      output.out << (*names)[i] << ": " << name_of(states[i]->phase) << "\n";
    } else {
      code = fail(output, ExitCode::Unreachable,
                  (*names)[i] + ": did not confirm that it stopped; check the robot");
    }
  }
  return code;
}

}  // namespace

CommandRun declare_robot_stop(Options& options) {
  auto words = std::make_shared<StopWords>();
  options.text("--robots ROBOTS", words->robots, "Robots: 1-3 for rvr1, rvr2, rvr3; or their names",
               Options::Need::Required);
  options.flag("--kill", words->kill, "Also refuse new runs until the nodes are restarted");
  words->transport.declare_client(options);
  return [words](Output& output) { return stop(*words, output); };
}

}  // namespace swarmsmith
