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
#include "robot/app/commands.h"
#include "robot/app/machine_word.h"
#include "robot/app/node_loop.h"
#include "robot/app/robot_names.h"
#include "robot/app/stop_signal.h"
#include "robot/app/transports.h"
#include "sim/files/color_text.h"
#include "sim/mission/colors.h"

namespace swarmsmith::cli {
namespace {

struct RunWords {
  std::string robot;
  std::optional<std::int64_t> index;
  std::string machine;
  std::string flavour;
  std::string turn_clock;
  std::optional<std::int64_t> seed;
  std::string lock_step;
  std::string run = "run";
  std::string period;
  std::string max_speed;
  std::string color_scale;
  std::string labels;
  std::string lidar_turn;
  std::string proximity_range;
  std::vector<std::string> max_ages;
  std::vector<std::string> needs;
  std::string operator_gone;
  std::string least_battery;
  std::string patience;
  std::string ranges = "array";
  std::string neighbours = "scan";
  std::string wheels = "doubles";
  std::string logs;
  bool pipe = false;
  bool normal_priority = false;
  TransportWords transport;
};

Duration duration_of(double seconds) {
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
}

Expected<Feed> feed_by(const std::string& name, const char* option) {
  for (const Feed feed : kAllFeeds) {
    if (name_of(feed) == name) return feed;
  }
  return bad_input("there is no sensor `" + name + "`: proximity, ground, neighbours or light",
                   option);
}

Expected<std::vector<Rgb>> labels_of(const std::string& words) {
  std::vector<Rgb> labels;
  for (std::size_t begin = 0; !words.empty() && begin <= words.size();) {
    const std::size_t comma = std::min(words.find(',', begin), words.size());
    const std::string word = words.substr(begin, comma - begin);
    begin = comma + 1;
    const auto color = parse_color(word);
    if (!color) return bad_input(no_such_color(word), "--labels");
    labels.push_back(*color);
  }
  return labels;
}

/// Takes one number after the other, and keeps the first thing that is wrong.
struct Numbers {
  std::optional<Error> error;

  void read(const std::string& text, const char* option, double least, double most, double& value) {
    const auto number = number_option(text, option, least, most);
    if (!number) {
      if (!error) error = number.error();
    } else if (*number) {
      value = **number;
    }
  }
};

Expected<void> read_max_ages(const std::vector<std::string>& words, NodeSettings& settings) {
  constexpr const char* kOption = "--max-age";
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    const auto feed = feed_by(word.substr(0, equals), kOption);
    if (!feed) return Unexpected(feed.error());
    const auto seconds = number_option(equals == std::string::npos ? "?" : word.substr(equals + 1),
                                       kOption, 0.01, 1);
    if (!seconds) return Unexpected(seconds.error());
    settings.hold[index_of(*feed)] = duration_of(seconds->value_or(0.3));
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
        "the name has no number that tells the robot's random stream: give --index, "
        "from 0, another one for each robot",
        "--robot");
  }
  settings.robot_index = *index;
  return {};
}

Expected<NodeSettings> settings_of(const RunWords& words, bool lock_step) {
  NodeSettings settings;
  if (const auto read = read_name(words, settings); !read) return Unexpected(read.error());
  settings.seed = words.seed.value_or(1);
  settings.lock_step_run = words.run;
  if (!is_plain_name(words.run))
    return bad_input("a run's name has letters, digits, - and _", "--run");
  Numbers numbers;
  double period = kControlPeriod_s;
  numbers.read(words.period, "--period", 0.001, 10, period);
  settings.period = duration_of(period);
  if (lock_step) settings.max_mps = kMaxWheelSpeed_mps;  // as in the simulator
  numbers.read(words.max_speed, "--max-speed", 0.01, kMaxWheelSpeed_mps, settings.max_mps);
  numbers.read(words.color_scale, "--color-scale", 1e-6, 1e6, settings.feeds.color_scale);
  double lidar_turn_deg = 0;
  numbers.read(words.lidar_turn, "--lidar-turn", -360, 360, lidar_turn_deg);
  settings.feeds.lidar_turn_rad = lidar_turn_deg * kPi / 180;
  numbers.read(words.proximity_range, "--proximity-range", kBlindZone_m, 100,
               settings.feeds.proximity_range_m);
  double operator_gone = 1;
  numbers.read(words.operator_gone, "--operator-gone", 0, 3600, operator_gone);
  settings.operator_gone = duration_of(operator_gone);
  settings.operator_hold = std::min(settings.operator_hold, settings.operator_gone);
  double battery_percent = 100 * settings.least_battery;
  numbers.read(words.least_battery, "--least-battery", 0, 100, battery_percent);
  settings.least_battery = battery_percent / 100;
  if (numbers.error) return Unexpected(*numbers.error);
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

/// What the node listens to.
EndOptions end_options(const RunWords& words, const PerFeed<bool>& needed, Pace pace) {
  EndOptions end;
  end.keep = pace == Pace::Clock ? Keep::Newest : Keep::All;
  end.wheels = words.wheels == "floats"  ? WheelsForm::Floats
               : words.wheels == "twist" ? WheelsForm::Twist
                                         : WheelsForm::Doubles;
  const bool any = needed != PerFeed<bool>{};
  const bool around = needed[index_of(Feed::Neighbours)];
  end.sensors = {.ranges = needed[index_of(Feed::Proximity)] || !any,
                 .ranges_apart = words.ranges == "apart",
                 .ground_color = needed[index_of(Feed::Ground)],
                 .scan = around && words.neighbours == "scan",
                 .neighbours = around && words.neighbours == "neighbours",
                 .light = needed[index_of(Feed::Light)],
                 .body = pace == Pace::Clock,
                 .driven = pace == Pace::Clock,
                 .senses = false};
  if (pace == Pace::Senses) {
    end.sensors = {};
    end.sensors.ranges = end.sensors.ground_color = false;
    end.sensors.senses = true;
  }
  return end;
}

/// Puts this thread ahead of all that is not urgent; threads that it starts are as before. Returns
/// what the log says of it.
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
  const Pace pace = words.lock_step.empty()       ? Pace::Clock
                    : words.lock_step == "senses" ? Pace::Senses
                                                  : Pace::CountedTopics;
  const auto machine = robot_machine(words.machine, words.flavour, words.turn_clock);
  if (!machine) return fail(output, ExitCode::Usage, machine.error());
  auto settings = settings_of(words, pace != Pace::Clock);
  if (!settings) return fail(output, ExitCode::Usage, settings.error());
  LoopOptions loop_options{.pace = pace};
  if (pace == Pace::Clock || !words.logs.empty())
    loop_options.logs = words.logs.empty() ? "." : words.logs;
  if (loop_options.logs && !std::filesystem::is_directory(*loop_options.logs)) {
    return fail(output, ExitCode::Usage,
                {ErrorKind::NotFound, "there is no such folder for logs", "--logs " + words.logs});
  }
  double patience = 10;
  Numbers numbers;
  numbers.read(words.patience, "--patience", 0.1, 3600, patience);
  if (numbers.error) return fail(output, ExitCode::Usage, *numbers.error);
  loop_options.patience = duration_of(patience);

  catch_stop_signals();
  const PerFeed<bool> needed = RobotNode(*settings, machine->controller, machine->flavour).needed();
  if (needed[index_of(Feed::Ground)] && words.color_scale.empty() && pace != Pace::Senses) {
    return fail(output, ExitCode::Usage,
                {ErrorKind::BadInput,
                 "the machine looks at the floor: say which value of the driver is full colour, "
                 "255 or 1",
                 "--color-scale"});
  }
  auto end =
      open_robot_end(words.transport, settings->robot, end_options(words, needed, pace), output);
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
               fmt::format("{}: {} of flavour {}, random stream {}, {}", settings->robot,
                           name_of(architecture_of(machine->controller)), machine->flavour.name,
                           settings->robot_index, settings->scheduling));
  }
  NodeLoop loop(node, **end, std::move(loop_options));
  return exit_code_of(loop.run());
}

}  // namespace

Run declare_robot_run(Options& options) {
  auto words = std::make_shared<RunWords>();
  constexpr auto kNeeded = Options::Need::Required;
  options.text("--robot ROBOT", words->robot, "Which robot: 2 is rvr2; or its name", kNeeded);
  options.text("--machine MACHINE|FILE", words->machine,
               "Machine, tree or network: a text or a file", kNeeded);
  options.text("--flavour FLAVOUR", words->flavour,
               "What its modules do (default: as its file says)");
  options.choice("--turn-clock", words->turn_clock, {"cycles", "seconds"},
                 "What a turn is measured in");
  options.integer("--seed", words->seed, {1, 2147483647},
                  "Of the random numbers (default 1; a start may give another)");
  options.integer("--index", words->index, {0, 100000},
                  "Of the robot's random stream, from 0 (default: the name's number minus 1)");
  options.choice("--lock-step", words->lock_step, {"senses", "topics"},
                 "Be stepped by a simulated world (swarmsmith robot world)");
  options.text("--run NAME", words->run, "Name of runs in lock-step, for logs (default run)");
  words->transport.declare_node(options);
  options.choice("--ranges", words->ranges, {"array", "apart"},
                 "Proximity as one topic `ranges` or as eight (default array)");
  options.choice("--neighbours", words->neighbours, {"scan", "neighbours"},
                 "Neighbours from a lidar's `scan` or ready (default scan)");
  options.choice("--wheels", words->wheels, {"doubles", "floats", "twist"},
                 "How speeds travel (default doubles)");
  options.text("--color-scale", words->color_scale, "The driver's value of full colour: 255 or 1");
  options.text("--labels", words->labels,
               "Colours of the floor, black,white,red: the nearest takes a reading's place");
  options.text("--lidar-turn", words->lidar_turn,
               "Degrees of the lidar's zero from the robot's head, counter-clockwise");
  options.text("--proximity-range", words->proximity_range,
               "Metres beyond which proximity sensors see nothing (default 0.4)");
  options.text("--period SECONDS", words->period, "Seconds of a control cycle (default 0.1)");
  options.text("--max-speed SPEED", words->max_speed, "Of a tread, m/s (default 0.35)");
  options.texts("--max-age", words->max_ages,
                "SENSOR=SECONDS of silence until the treads stop, repeatable (default "
                "proximity=0.3, all others 0.35)");
  options.texts("--need SENSOR", words->needs, "A sensor that must be there besides the machine's");
  options.text("--operator-gone", words->operator_gone,
               "Seconds of silence of `start` that end a run; 0: never (default 1)");
  options.text("--least-battery PERCENT", words->least_battery,
               "Percent, less starts no run (default 20)");
  options.text("--logs DIR", words->logs, "Folder of logs (default: here; in lock-step: none)");
  options.text("--patience SECONDS", words->patience,
               "Seconds that a world in lock-step may be silent (default 10)");
  options.flag("--pipe", words->pipe, "End when standard input ends");
  options.flag("--normal-priority", words->normal_priority, "Do not ask for SCHED_FIFO");
  return [words](Output& output) { return run(*words, output); };
}

}  // namespace swarmsmith::cli
