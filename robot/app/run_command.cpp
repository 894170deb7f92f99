#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

#include "base/math.h"
#include "base/plain_text.h"
#include "base/process/stop_signal.h"
#include "base/text/csv.h"
#include "robot/app/commands.h"
#include "robot/app/input_end.h"
#include "robot/app/machine_word.h"
#include "robot/app/node_loop.h"
#include "robot/app/robot_names.h"
#include "robot/app/transports.h"
#include "sim/control/treads.h"
#include "sim/files/color_text.h"
#include "sim/mission/colors.h"

namespace swarmsmith {
namespace {

struct RunWords {
  std::string robot;
  std::string kind = "rvr";
  std::optional<std::int64_t> index;
  std::string machine;
  std::string flavour;
  std::optional<TurnClock> turn_clock;
  std::optional<std::int64_t> seed;
  Pace pace = Pace::Clock;
  std::string run = "run";
  double period_s = kControlPeriod_s;
  std::optional<double> max_mps;
  std::optional<double> color_scale;
  std::string labels;
  double lidar_turn_deg = 0;
  double proximity_range_m = kProximityRange_m;
  std::vector<std::string> max_ages;
  std::vector<std::string> needs;
  double operator_gone_s = 1;
  double least_battery_percent = 20;
  double patience_s = 10;
  bool ranges_apart = false;
  bool scan = true;
  WheelsForm wheels = WheelsForm::Doubles;
  std::string logs;
  bool pipe = false;
  bool normal_priority = false;
  TransportWords transport;
};

Expected<Feed> feed_by(const std::string& name, const char* option) {
  if (const auto feed = named<Feed>(name)) return *feed;
  return bad_input(
      "there is no sensor `" + name + "`; sensors are proximity, ground, neighbours, light",
      option);
}

Expected<std::vector<Rgb>> labels_of(const std::string& words) {
  std::vector<Rgb> labels;
  if (words.empty()) return labels;
  for (const std::string_view word : split(words, ',')) {
    const auto color = parse_color(word);
    if (!color) return bad_input(no_such_color(std::string(word)), "--labels");
    labels.push_back(*color);
  }
  return labels;
}

Expected<void> read_max_ages(const std::vector<std::string>& words, NodeSettings& settings) {
  constexpr const char* kOption = "--max-age";
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    const auto feed = feed_by(word.substr(0, equals), kOption);
    if (!feed) return Unexpected(feed.error());
    const auto seconds = number_in(equals == std::string::npos ? "" : word.substr(equals + 1));
    if (!seconds || !(*seconds >= 0.01 && *seconds <= 1))
      return bad_input("write SENSOR=SECONDS, from 0.01 to 1 s, such as ground=0.5", word);
    settings.hold[index_of(*feed)] = duration_of(*seconds);
  }
  return {};
}

Expected<void> read_name(const RunWords& words, NodeSettings& settings) {
  auto name = robot_name(words.robot);
  if (!name) return Unexpected(name.error());
  settings.robot = std::move(*name);
  const auto index = words.index ? static_cast<int>(*words.index) : index_in_name(settings.robot);
  if (!index) {
    return bad_input(
        "the name has no number, from 1 to 100001, to choose the robot's random stream: give "
        "--index, from 0, a different one for each robot",
        "--robot");
  }
  settings.robot_index = *index;
  return {};
}

Expected<NodeSettings> settings_of(const RunWords& words, const Robot& kind) {
  NodeSettings settings;
  settings.kind = kind;
  settings.feeds.rays_deg = kind.proximity.rays_deg;
  if (const auto read = read_name(words, settings); !read) return Unexpected(read.error());
  settings.seed = words.seed.value_or(1);
  settings.lock_step_run = words.run;
  if (!is_plain_name(words.run))
    return bad_input("a run's name must consist of letters, digits, - and _", "--run");
  settings.period = duration_of(words.period_s);
  const double most_mps = kind.drive.max_speed_mps;
  settings.max_mps = std::min(settings.max_mps, most_mps);
  if (words.pace != Pace::Clock) settings.max_mps = most_mps;  // as in the simulator
  settings.max_mps = words.max_mps.value_or(settings.max_mps);
  settings.feeds.color_scale = words.color_scale.value_or(settings.feeds.color_scale);
  settings.feeds.lidar_turn_rad = words.lidar_turn_deg * kPi / 180;
  settings.feeds.proximity_range_m = words.proximity_range_m;
  settings.operator_gone = duration_of(words.operator_gone_s);
  settings.operator_hold = std::min(settings.operator_hold, settings.operator_gone);
  settings.least_battery = words.least_battery_percent / 100;
  auto labels = labels_of(words.labels);
  if (!labels) return Unexpected(labels.error());
  settings.feeds.labels = std::move(*labels);
  if (const auto read = read_max_ages(words.max_ages, settings); !read)
    return Unexpected(read.error());
  for (const std::string& need : words.needs) {
    const auto feed = feed_by(need, "--need");
    if (!feed) return Unexpected(feed.error());
    settings.also_needed[index_of(*feed)] = true;
  }
  settings.version = robot_program_name();
  std::array<char, 256> host{};
  if (::gethostname(host.data(), host.size() - 1) == 0) settings.host = host.data();
  for (const std::string& topic : words.transport.topics) {
    const std::size_t at = topic.find(":=");
    if (at != std::string::npos && at > 0)
      settings.topics.emplace_back(topic.substr(0, at), topic.substr(at + 2));
  }
  return settings;
}

/// Twists and scans have numbers of the RVR in them.
Expected<void> check_messages(const RunWords& words, const Robot& kind, bool sees_others) {
  const std::string name = "the robot `" + kind.name + "`";
  if (words.wheels == WheelsForm::Twist && kind.drive.track_m != kTreadDistance_m) {
    return bad_input("a twist is for the distance between the RVR's treads, and " + name +
                         " has another one; send `doubles` or `floats`",
                     "--wheels twist");
  }
  if (words.pace != Pace::Senses && words.scan && sees_others && !is_rvr(kind)) {
    return bad_input("the node finds only RVRs in a scan, and drives " + name +
                         "; let its driver send `neighbours`",
                     "--neighbours scan");
  }
  return {};
}

/// The topics to which the node subscribes.
EndOptions end_options(const RunWords& words, const PerFeed<bool>& needed) {
  const bool by_clock = words.pace == Pace::Clock;
  EndOptions end{.keep = by_clock ? Keep::Newest : Keep::All, .wheels = words.wheels};
  end.sensors = {.ranges = false, .ground_color = false, .senses = true};
  if (words.pace == Pace::Senses) return end;
  const bool around = needed[index_of(Feed::Neighbours)];
  end.sensors = {.ranges = needed[index_of(Feed::Proximity)] || needed == PerFeed<bool>{},
                 .ranges_apart = words.ranges_apart,
                 .ground_color = needed[index_of(Feed::Ground)],
                 .scan = around && words.scan,
                 .neighbours = around && !words.scan,
                 .light = needed[index_of(Feed::Light)],
                 .battery = by_clock,
                 .driven = by_clock,
                 .senses = false};
  return end;
}

/// Gives this thread priority over everything that is not urgent; threads that it starts are not
/// affected. Returns the text for the log.
std::string schedule(const RunWords& words, Output& output) {
  constexpr int kPriority = 20;
  if (words.normal_priority) return "normal priority";
  const sched_param wanted{.sched_priority = kPriority};
  if (::sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &wanted) == 0)
    return fmt::format("SCHED_FIFO {}", kPriority);
  print_note(output,
             fmt::format("the control thread runs at normal priority, and may be late on a busy "
                         "computer: SCHED_FIFO is not allowed ({}); allow it with `ulimit -r {}` "
                         "or LimitRTPRIO={} in systemd",
                         std::strerror(errno), kPriority, kPriority));
  return "normal priority";
}

std::optional<std::string> end_asked_for(bool pipe) {
  if (stop_signal() == SIGINT) return "by Ctrl-C";
  if (stop_signal() == SIGTERM) return "by SIGTERM";
  if (pipe && input_has_ended()) return "by the end of its input";
  return std::nullopt;
}

ExitCode exit_code_of(NodeLoop::Ending ending) {
  switch (ending) {
    case NodeLoop::Ending::Asked:
      if (stop_signal() == SIGINT) return ExitCode::Interrupted;
      return stop_signal() == SIGTERM ? ExitCode::Terminated : ExitCode::Done;
    case NodeLoop::Ending::NoMoreRuns:
      return ExitCode::Done;
    case NodeLoop::Ending::Lost:
      return ExitCode::Unreachable;
    case NodeLoop::Ending::Wrong:
      break;
  }
  return ExitCode::Failed;
}

ExitCode run(const RunWords& words, Output& output) {
  const Pace pace = words.pace;
  const auto kind = find_kind(words.kind);
  if (!kind) return fail(output, ExitCode::Usage, kind.error());
  const auto machine = robot_machine(words.machine, words.flavour, words.turn_clock, *kind);
  if (!machine) return fail(output, ExitCode::Usage, machine.error());
  auto settings = settings_of(words, *kind);
  if (!settings) return fail(output, ExitCode::Usage, settings.error());
  LoopOptions loop_options{.pace = pace, .patience = duration_of(words.patience_s)};
  if (pace == Pace::Clock || !words.logs.empty())
    loop_options.logs = words.logs.empty() ? "." : words.logs;
  if (loop_options.logs && !std::filesystem::is_directory(*loop_options.logs)) {
    return fail(output, ExitCode::Usage,
                {ErrorKind::NotFound, "there is no such folder for logs", "--logs " + words.logs});
  }

  catch_stop_signals();
  const PerFeed<bool> needed = RobotNode(*settings, machine->controller, machine->flavour).needed();
  if (needed[index_of(Feed::Ground)] && !words.color_scale && pace != Pace::Senses) {
    return fail(output, ExitCode::Usage,
                {ErrorKind::BadInput,
                 "the machine reads the floor's colour: give the driver's value of full colour, "
                 "255 or 1",
                 "--color-scale"});
  }
  const auto checked = check_messages(words, *kind, needed[index_of(Feed::Neighbours)]);
  if (!checked) return fail(output, ExitCode::Usage, checked.error());
  auto end = open_robot_end(words.transport, settings->robot, end_options(words, needed), output);
  if (!end) {
    return fail(output, exit_code_of_transport(end.error()), end.error());
  }
  settings->scheduling = pace == Pace::Clock ? schedule(words, output) : "lock-step";
  RobotNode node(*settings, machine->controller, machine->flavour);
  const bool pipe = words.pipe;
  loop_options.ends = [pipe] { return end_asked_for(pipe); };
  loop_options.note = [&output](const std::string& text) { print_note(output, text); };
  if (!output.quiet) {
    print_note(output,
               fmt::format("{}: robot {}, {} of flavour {}, random stream {}, {}", settings->robot,
                           kind->name, name_of(architecture_of(machine->controller)),
                           machine->flavour.name, settings->robot_index, settings->scheduling));
  }
  NodeLoop loop(node, **end, std::move(loop_options));
  return exit_code_of(loop.run());
}

}  // namespace

CommandRun declare_robot_run(Options& options) {
  auto words = std::make_shared<RunWords>();
  constexpr auto kNeeded = Options::Need::Required;
  options.text("--robot ROBOT", words->robot, "Robot: 2 for rvr2; or its name", kNeeded);
  options.text("--kind ROBOT|FILE", words->kind,
               "Kind of robot: rvr, or a robot's file (default rvr)");
  options.text("--machine MACHINE|FILE", words->machine,
               "Machine, tree or network: a text or a file", kNeeded);
  options.text("--flavour FLAVOUR|FILE", words->flavour,
               "Flavour of the machine (default: as its file says)");
  options.choice("--turn-clock", words->turn_clock,
                 {{"cycles", TurnClock::Cycles}, {"seconds", TurnClock::Seconds}},
                 "Unit of a turn's length");
  options.integer("--seed", words->seed, {1, 2147483647},
                  "Seed of the random numbers (default 1; `start` may give another)");
  options.integer("--index", words->index, {0, kMostIndex},
                  "Index of the robot's random stream, from 0 (default: the name's number "
                  "minus 1)");
  options.choice("--lock-step", words->pace,
                 {{"senses", Pace::Senses}, {"topics", Pace::CountedTopics}},
                 "A simulated world steps this node (swarmsmith robot world)");
  options.text("--run NAME", words->run, "Name of runs in lock-step, for logs (default run)");
  words->transport.declare_node(options);
  options.choice("--ranges", words->ranges_apart, {{"array", false}, {"apart", true}},
                 "Proximity in one topic `ranges`, or in eight (default array)");
  options.choice("--neighbours", words->scan, {{"scan", true}, {"neighbours", false}},
                 "Neighbours from a lidar's `scan`, or from `neighbours` (default scan)");
  declare_wheels(options, words->wheels);
  options.number("--color-scale", words->color_scale, {1e-6, 1e6},
                 "The driver's value of full colour: 255 or 1");
  options.text("--labels", words->labels,
               "Colours of the floor, black,white,red: a reading becomes the nearest of them");
  options.number("--lidar-turn", words->lidar_turn_deg, {-360, 360},
                 "Angle from the robot's front to the lidar's zero, degrees counter-clockwise");
  options.number("--proximity-range", words->proximity_range_m, {kBlindZone_m, 100},
                 "Range of the proximity sensors in metres (default 0.4)");
  options.number("--period SECONDS", words->period_s, {0.001, 10},
                 "Length of a control cycle (default 0.1)");
  options.number("--max-speed SPEED", words->max_mps, {0.01, kMaxWheelSpeed_mps},
                 "Largest speed of a tread, m/s (default 0.35)");
  options.texts("--max-age", words->max_ages,
                "SENSOR=SECONDS without a message until the treads stop, repeatable (default "
                "proximity=0.3, all others 0.35)");
  options.texts("--need SENSOR", words->needs,
                "A sensor that is needed, although the machine does not read it");
  options.number("--operator-gone", words->operator_gone_s, {0, 3600},
                 "End a run after N seconds without `start`; 0: never (default 1)");
  options.number("--least-battery PERCENT", words->least_battery_percent, {0, 100},
                 "Do not start a run with less battery (default 20)");
  options.text("--logs DIR", words->logs, "Folder of logs (default: here; in lock-step: none)");
  options.number("--patience SECONDS", words->patience_s, {0.1, 3600},
                 "Seconds to wait for a world in lock-step (default 10)");
  options.flag("--pipe", words->pipe, "End when standard input ends");
  options.flag("--normal-priority", words->normal_priority, "Do not ask for SCHED_FIFO");
  return [words](Output& output) { return run(*words, output); };
}

}  // namespace swarmsmith
