#include <fmt/format.h>

#include <memory>
#include <utility>

#include "base/plain_text.h"
#include "base/process/stop_signal.h"
#include "base/text/json.h"
#include "robot/app/commands.h"
#include "robot/app/machine_word.h"
#include "robot/app/node_loop.h"
#include "robot/app/operator_loop.h"
#include "robot/app/robot_names.h"
#include "robot/app/run_file.h"
#include "robot/app/transports.h"
#include "robot/runtime/robot_kind.h"

namespace swarmsmith {
namespace {

constexpr Duration kTurn = std::chrono::milliseconds(20);

struct StartWords {
  std::string robots;
  std::string kind;
  std::string run;
  double seconds = 120;
  double lead_s = 2;
  double patience_s = 5;
  std::optional<std::int64_t> seed;
  RunFileWords file;
  TransportWords transport;
};

/// The robot that the run is for: of --kind, else of --mission, else the RVR.
Expected<Robot> kind_of(const StartWords& words) {
  const auto of_mission = words.file.robot_of_mission(words.run);
  if (words.kind.empty()) {
    if (!of_mission) return Unexpected(of_mission.error());
    return of_mission->value_or(rvr());
  }
  auto kind = find_kind(words.kind);
  if (kind && of_mission && *of_mission) {
    if (auto why = other_robot("the mission", **of_mission, *kind))
      return bad_input(std::move(*why), "--kind " + words.kind);
  }
  return kind;
}

/// Reports the progress of a run.
class Teller {
 public:
  explicit Teller(Output& output) : output_(&output) {}

  void tell(const RunStarter& starter) {
    if (starter.stage() != stage_) {
      stage_ = starter.stage();
      if (stage_ == RunStarter::Stage::Ordered)
        print_note(*output_, "all robots are ready: ordering the run");
      if (stage_ == RunStarter::Stage::Stopping)
        print_note(*output_, starter.complaints().front() + "; stopping all robots");
    }
    if (starter.has_begun() && !began_) print_note(*output_, "all robots are running");
    began_ = starter.has_begun();
  }

 private:
  Output* output_;
  RunStarter::Stage stage_ = RunStarter::Stage::Calling;
  bool began_ = false;
};

/// The message for a robot that did not report the end of its run: its result is unknown, whatever
/// its last state was.
std::string unknown(const RolledRobot& robot) {
  return fmt::format(
      "{}: unknown; it was last heard {:.1f} s ago, {} after {}: check the robot and its "
      "log",
      robot.name, seconds_of(now_on_both_clocks().clock - robot.heard), name_of(robot.state->phase),
      counted(robot.state->cycle, "cycle"));
}

/// The verdict of each robot; "unknown" for a robot that did not report the end of its run.
JsonObject verdicts_of(const RunStarter& starter) {
  JsonObject verdicts;
  for (const RolledRobot& robot : starter.roll().robots()) {
    verdicts.add(robot.name,
                 starter.is_over_for(robot) ? name_of(robot.state->verdict) : "unknown");
  }
  return verdicts;
}

ExitCode answer(const StartWords& words, const RunStarter& starter, const std::string& file,
                Output& output) {
  const bool valid = starter.verdict() != RunVerdict::Invalid;
  if (output.json) {
    output.out << JsonObject()
                      .add("run", words.run)
                      .add("verdict", name_of(starter.verdict()))
                      .add("complaints", starter.complaints())
                      .add("start_clock_s", seconds_of(starter.start().clock.time_since_epoch()))
                      .add("start_unix_s", starter.start().unix_s)
                      .add("file", file)
                      .add("verdicts", verdicts_of(starter))
                      .add("robots",
                           JsonPiece{roll_json(starter.roll(), now_on_both_clocks().clock)})
                      .text()
               << "\n";
  } else {
    for (const RolledRobot& robot : starter.roll().robots()) {
      if (!robot.state) continue;
      if (!starter.is_over_for(robot)) {
        output.out << unknown(robot) << "\n";
        continue;
      }
      output.out << fmt::format("{}: {} after {}, {}\n", robot.name, name_of(robot.state->phase),
                                counted(robot.state->cycle, "cycle"),
                                name_of(robot.state->verdict));
      for (const std::string& reason : robot.state->reasons)
        output.out << "  " << reason << "\n";
    }
    for (const std::string& complaint : starter.complaints())
      output.out << complaint << "\n";
    output.out << words.run << ": " << name_of(starter.verdict()) << "\n";
    if (!file.empty()) output.out << file << ": for `swarmsmith track score --run`\n";
  }
  if (stop_signal() != 0) return ExitCode::Interrupted;
  return valid ? ExitCode::Done : ExitCode::InvalidRun;
}

ExitCode start(const StartWords& words, Output& output) {
  const auto names = robot_names(words.robots);
  if (!names) return fail(output, ExitCode::Usage, names.error());
  if (!is_plain_name(words.run)) {
    return fail(
        output, ExitCode::Usage,
        {ErrorKind::BadInput, "a run's name must consist of letters, digits, - and _", "--run"});
  }
  const auto place = words.file.check(words.run);
  if (!place) return fail(output, ExitCode::Usage, place.error());
  const auto kind = kind_of(words);
  if (!kind) return fail(output, ExitCode::Usage, kind.error());
  catch_stop_signals();
  const auto end = open_operator_end(words.transport, *names);
  if (!end) return fail(output, exit_code_of_transport(end.error()), end.error());
  RunStarter starter({.run = words.run,
                      .seconds = words.seconds,
                      .seed = words.seed,
                      .kind = *kind,
                      .lead_s = words.lead_s,
                      .patience_s = words.patience_s},
                     *names, operator_id(), now_on_both_clocks());
  Teller teller(output);
  bool interrupted = false;
  bool connected = true;
  while (connected && starter.stage() != RunStarter::Stage::Over) {
    const Now now = now_on_both_clocks();
    if (stop_signal() != 0 && !interrupted) {
      interrupted = true;
      starter.interrupt(now);
    }
    for (const Order& order : starter.tick(now))
      send_order(**end, order);
    teller.tell(starter);
    connected = hear_states(
        **end, now.clock + kTurn,
        [&starter](std::size_t robot, const NodeState& state, const Now& heard) {
          starter.hear(robot, state, heard);
        },
        [&output](const std::string& text) { print_note(output, text); });
  }
  (*end)->flush(std::chrono::seconds(1));
  if (starter.start().unix_s == 0) {  // nothing was ordered
    for (const std::string& complaint : starter.complaints())
      print_error(output, {ErrorKind::Unavailable, complaint, ""});
    if (!output.quiet) output.err << roll_table(starter.roll(), now_on_both_clocks().clock);
    bool all_answer = true;
    for (const RolledRobot& robot : starter.roll().robots())
      all_answer = all_answer && robot.state.has_value();
    if (interrupted) return ExitCode::Interrupted;
    return all_answer ? ExitCode::Failed : ExitCode::Unreachable;
  }
  const auto written = words.file.write_file(
      words.run, starter, [&output](const std::string& text) { print_note(output, text); });
  if (!written) {
    static_cast<void>(answer(words, starter, "", output));
    return fail(output, ExitCode::Failed, written.error());
  }
  return answer(words, starter, *written, output);
}

}  // namespace

CommandRun declare_robot_start(Options& options) {
  auto words = std::make_shared<StartWords>();
  options.text("--run NAME", words->run,
               "Name of the run; robots refuse a name that they had before",
               Options::Need::Required);
  options.text("--robots ROBOTS", words->robots, "Robots: 1-3 for rvr1, rvr2, rvr3; or their names",
               Options::Need::Required);
  options.text("--kind ROBOT|FILE", words->kind,
               "Kind of the robots: rvr, or a robot's file (default: the mission's robot, or rvr)");
  options.number("--seconds", words->seconds, {0.5, 86'400},
                 "How long the run lasts (default 120)");
  options.integer("--seed", words->seed, {1, 2147483647},
                  "Seed of the random numbers of this run (default: the nodes' own)");
  options.number("--in", words->lead_s, {0.5, 60},
                 "Seconds from the order to the start (default 2)");
  options.number("--patience SECONDS", words->patience_s, {0.5, 3600},
                 "Seconds to wait until all robots are ready (default 5)");
  words->file.declare(options);
  words->transport.declare_client(options);
  return [words](Output& output) { return start(*words, output); };
}

}  // namespace swarmsmith
