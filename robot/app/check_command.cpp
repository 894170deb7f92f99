#include <memory>
#include <utility>

#include "base/process/stop_signal.h"
#include "base/text/json.h"
#include "robot/app/commands.h"
#include "robot/app/node_loop.h"
#include "robot/app/operator_loop.h"
#include "robot/app/robot_names.h"
#include "robot/app/transports.h"

namespace swarmsmith {
namespace {

struct CheckWords {
  std::string robots;
  double seconds = 5;
  TransportWords transport;
};

ExitCode check(const CheckWords& words, Output& output) {
  const auto names = robot_names(words.robots);
  if (!names) return fail(output, ExitCode::Usage, names.error());
  catch_stop_signals();
  const auto end = open_operator_end(words.transport, *names);
  if (!end) return fail(output, exit_code_of_transport(end.error()), end.error());
  RollCall roll(*names, operator_id());
  const auto note = [&output](const std::string& text) { print_note(output, text); };
  const TimePoint begun = now_on_both_clocks().clock;
  const auto until = begun + duration_of(words.seconds);
  bool connected = true;
  while (connected && !roll.is_complete() && stop_signal() == 0) {
    const Now now = now_on_both_clocks();
    if (now.clock >= until) break;
    if (const auto echo = roll.tick(now)) send_order(**end, *echo);
    connected = hear_states(
        **end, now.clock + std::chrono::milliseconds(20),
        [&roll](std::size_t robot, const NodeState& state, const Now& heard) {
          roll.hear(robot, state, heard);
        },
        note);
  }
  const TimePoint now = now_on_both_clocks().clock;
  const std::vector<std::string> complaints = roll.complaints(now);
  bool all_answer = true;
  for (const RolledRobot& robot : roll.robots())
    all_answer = all_answer && robot.state.has_value();
  if (output.json) {
    output.out << JsonObject()
                      .add("ready", complaints.empty())
                      .add("complaints", complaints)
                      .add("robots", JsonPiece{roll_json(roll, now)})
                      .text()
               << "\n";
  } else {
    output.out << roll_table(roll, now);
    for (const std::string& complaint : complaints)
      output.out << complaint << "\n";
    if (complaints.empty()) output.out << "ready to start\n";
  }
  if (!all_answer) return ExitCode::Unreachable;
  return complaints.empty() ? ExitCode::Done : ExitCode::Failed;
}

}  // namespace

CommandRun declare_robot_check(Options& options) {
  auto words = std::make_shared<CheckWords>();
  options.text("--robots ROBOTS", words->robots, "Robots: 1-3 for rvr1, rvr2, rvr3; or their names",
               Options::Need::Required);
  options.number("--seconds", words->seconds, {0.1, 3600},
                 "How long to wait for answers (default 5)");
  words->transport.declare_client(options);
  return [words](Output& output) { return check(*words, output); };
}

}  // namespace swarmsmith
