#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <utility>

#include "base/output_file.h"
#include "base/plain_text.h"
#include "base/process/stop_signal.h"
#include "base/suggestion.h"
#include "base/text/json.h"
#include "console/counter.h"
#include "console/seeds.h"
#include "robot/app/commands.h"
#include "robot/app/machine_word.h"
#include "robot/app/robot_names.h"
#include "robot/app/transports.h"
#include "robot/runtime/node_state.h"
#include "robot/runtime/robot_kind.h"
#include "robot/world/lock_step.h"
#include "robot/world/real_time.h"
#include "robot/world/sensor_messages.h"
#include "sim/engine/fitting.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"
#include "sim/files/robot_file.h"
#include "sim/mission/trajectory_csv.h"

namespace swarmsmith {
namespace {

struct WorldWords {
  std::string mission;
  std::string profile = "rvr";
  std::string seeds = "1";
  std::string robots;
  bool lock_step = false;
  bool topics = false;
  bool real_time = false;
  bool at_once = false;
  bool compare = false;
  std::string machine;
  std::string flavour;
  std::optional<TurnClock> turn_clock;
  bool ranges_apart = false;
  bool scan = false;
  bool light = false;
  WheelsForm wheels = WheelsForm::Doubles;
  double wait_s = 60;
  double patience_s = 5;
  std::vector<std::string> faults;
  std::string csv;
  TransportWords transport;
};

/// All inputs that the arguments name, read and checked.
struct Plan {
  Mission mission;
  Profile profile;
  std::vector<std::int64_t> seeds;
  std::vector<Instance> instances;  ///< by seed
  std::vector<std::string> robots;
  std::optional<RobotMachine> machine;
  EndOptions end;
  std::vector<Fault> faults;
};

/// Returns the last error in a file; prints the others.
Unexpected complain(const std::vector<Error>& errors, const char* option, Output& output) {
  for (std::size_t i = 0; i + 1 < errors.size(); ++i)
    print_error(output, errors[i]);
  const Error& last = errors.back();
  return bad_input(last.message, last.where.empty() ? option : last.where);
}

Expected<void> check_words(const WorldWords& words) {
  if (words.lock_step == words.real_time) {
    return bad_input(
        "choose --lock-step (the world waits for the nodes: exact) or --real-time (by "
        "the clock)");
  }
  if (words.topics && words.real_time) {
    return bad_input("works only with --lock-step; real time always uses the drivers' topics",
                     "--topics");
  }
  if (words.compare && words.real_time) {
    return bad_input("works only with --lock-step; other runs differ each time", "--compare");
  }
  if (words.compare && words.machine.empty()) {
    return bad_input("needs the machine that the nodes run: --machine FILE", "--compare");
  }
  if (words.at_once && !words.real_time)
    return bad_input("works only with --real-time", "--at-once");
  if (!words.faults.empty() && !words.real_time)
    return bad_input("works only with --real-time", "--fault");
  return {};
}

SensorTopics sensors_of(const WorldWords& words) {
  SensorTopics sensors = world_topics();
  sensors.scan = words.scan;
  sensors.neighbours = !sensors.scan;
  sensors.ranges_apart = words.ranges_apart;
  sensors.light = words.light;
  sensors.battery = sensors.driven = words.real_time;
  sensors.senses = words.lock_step && !words.topics;
  return sensors;
}

Expected<void> read_faults(const WorldWords& words, Plan& plan) {
  for (const std::string& word : words.faults) {
    auto fault = parse_fault(word);
    if (!fault) return Unexpected(fault.error());
    if (std::find(plan.robots.begin(), plan.robots.end(), fault->robot) == plan.robots.end())
      return bad_input("there is no robot " + fault->robot, "--fault " + word);
    plan.faults.push_back(std::move(*fault));
  }
  return {};
}

Expected<void> read_robots(const WorldWords& words, Plan& plan) {
  if (!words.robots.empty()) {
    auto names = robot_names(words.robots);
    if (!names) return Unexpected(names.error());
    plan.robots = std::move(*names);
  } else {
    for (int i = 1; i <= plan.mission.robots; ++i)
      plan.robots.push_back("rvr" + std::to_string(i));
  }
  if (static_cast<int>(plan.robots.size()) == plan.mission.robots) return {};
  return bad_input("the mission has " + counted(plan.mission.robots, "robot") + ", not " +
                       std::to_string(plan.robots.size()),
                   "--robots");
}

Expected<Plan> plan_of(const WorldWords& words, Output& output) {
  if (const auto good = check_words(words); !good) return Unexpected(good.error());
  Plan plan;
  auto mission = find_mission(words.mission, {});
  if (!mission) return complain(mission.error(), "--mission", output);
  plan.mission = std::move(mission->mission);
  const Robot& kind = plan.mission.robot;
  if (auto why = no_node_drives(kind)) return bad_input(std::move(*why), "--mission");
  if (words.scan && !is_rvr(kind)) {
    return bad_input("nodes find only RVRs in a scan, and the mission has the robot `" + kind.name +
                         "`; send `neighbours`",
                     "--neighbours scan");
  }
  auto profile = find_profile(words.profile, {});
  if (!profile) return complain(profile.error(), "--profile", output);
  plan.profile = std::move(*profile);
  if (auto why = misfit(plan.profile, kind)) return bad_input(std::move(*why), "--profile");
  auto seeds = parse_seeds(words.seeds);
  if (!seeds) return Unexpected(seeds.error());
  plan.seeds = std::move(*seeds);
  const bool one_run = words.real_time || words.topics || !words.csv.empty();
  if (one_run && plan.seeds.size() > 1) {
    return bad_input(words.csv.empty() ? "nodes get their seed when they start: give one seed"
                                       : "a table has one run: give one seed",
                     "--seeds");
  }
  for (const std::int64_t seed : plan.seeds) {
    auto instance = instance_of(plan.mission, seed);
    if (!instance) return Unexpected(instance.error());
    plan.instances.push_back(std::move(*instance));
  }
  if (const auto read = read_robots(words, plan); !read) return Unexpected(read.error());
  if (!words.machine.empty()) {
    auto machine = robot_machine(words.machine, words.flavour, words.turn_clock, kind);
    if (!machine) return Unexpected(machine.error());
    plan.machine = std::move(*machine);
  }
  plan.end = {.keep = words.lock_step ? Keep::All : Keep::Newest,
              .sensors = sensors_of(words),
              .wheels = words.wheels};
  if (const auto read = read_faults(words, plan); !read) return Unexpected(read.error());
  return plan;
}

/// The poses of a run as a table (docs/trajectories.md).
class TrajectoryTable {
 public:
  static Expected<TrajectoryTable> open(const std::string& name) {
    TrajectoryTable table;
    table.name_ = name;
    if (name.empty()) return table;
    if (const auto place = output_place(name, FileKind::Table); !place)
      return Unexpected(place.error());
    table.file_ = std::make_unique<std::ofstream>(name, std::ios::binary);
    if (!*table.file_) return Unexpected(cannot_write(name));
    *table.file_ << kTrajectoryColumns << ",cmd_left,cmd_right,state" << kCsvLineEnd;
    return table;
  }

  Recorder recorder() {
    if (!file_) return {};
    return Recorder([this](const Snapshot& now) { write(now); });
  }

  Expected<void> close() {
    if (!file_) return {};
    file_->close();
    if (!file_->good()) return Unexpected(cannot_write(name_));
    return {};
  }

 private:
  void write(const Snapshot& now) {
    std::string text;
    int number = 0;
    for (const RobotRecord& robot : now.robots) {
      append_pose_cells(text, now.cycle, number++, robot.pose);
      for (const double speed : {robot.command.left_mps, robot.command.right_mps}) {
        text += ',';
        append_number(text, speed);
      }
      text += ',' + std::to_string(robot.state);
      text += kCsvLineEnd;
    }
    *file_ << text;
  }

  std::string name_;
  std::unique_ptr<std::ofstream> file_;
};

std::string digest_text(std::uint64_t digest) {
  char buffer[17];
  std::snprintf(buffer, sizeof buffer, "%016llx", static_cast<unsigned long long>(digest));
  return buffer;
}

/// The start of a node's run, if the node is armed or running, by this host's steady clock.
std::optional<TimePoint> start_of(const StateMessage& message) {
  const auto state = parse_state(message.text);
  if (!state || (state->phase != Phase::Armed && state->phase != Phase::Running)) return {};
  const double now_unix_s =
      std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  // Orders name the start by the wall clock; the world runs by the steady clock.
  return SystemClock().now() + duration_of(state->start_unix_s - now_unix_s);
}

/// Why a node does not fit a mission with this robot.
std::optional<std::string> objection_to(const StateMessage& message, const Robot& kind) {
  const auto state = parse_state(message.text);
  if (!state) return state.error().message;
  const auto driven = parse_own_robot(state->own_robot);
  if (!driven) return driven.error().message;
  return other_robot("the mission", kind, *driven);
}

ExitCode exit_code_of(const Error& error) {
  if (stop_signal() == SIGINT) return ExitCode::Interrupted;
  if (stop_signal() != 0) return ExitCode::Terminated;
  return error.kind == ErrorKind::Unavailable ? ExitCode::Unreachable : ExitCode::Failed;
}

class World {
 public:
  World(const WorldWords& words, const Plan& plan, WorldEnd& end, TrajectoryTable& table,
        Output& output)
      : words_(words), plan_(plan), end_(end), table_(table), output_(output) {
    options_.patience = duration_of(words.patience_s);
    options_.tell = [&output](const std::string& text) { print_note(output, text); };
    options_.is_over = [] { return stop_signal() != 0; };
    options_.objection = [&plan](const StateMessage& message) {
      return objection_to(message, plan.mission.robot);
    };
  }

  ExitCode run() {
    print_note(output_, "the world sends " + sent());
    if (const auto there = wait_for_robots(end_, duration_of(words_.wait_s), options_); !there)
      return fail(output_, exit_code_of(there.error()), there.error());
    const ExitCode code = words_.real_time ? run_by_clock() : run_in_steps();
    if (const auto written = table_.close(); !written)
      return fail(output_, ExitCode::Failed, written.error());
    return code;
  }

 private:
  /// The topics that the world sends, so that users see when a node waits for others in vain.
  std::string sent() const {
    const SensorTopics& sensors = plan_.end.sensors;
    if (sensors.senses) return "senses";
    std::string text;
    for (const auto& [is_sent, name] :
         {std::pair(sensors.ranges, "ranges"), std::pair(sensors.ground_color, "ground_color"),
          std::pair(sensors.scan, "scan"), std::pair(sensors.neighbours, "neighbours"),
          std::pair(sensors.light, "light"), std::pair(sensors.battery, "battery")}) {
      if (is_sent) text += (text.empty() ? "" : ", ") + std::string(name);
    }
    return text;
  }

  WorldRun run_at(std::size_t i) const {
    return {.profile = plan_.profile,
            .mission = plan_.mission,
            .instance = plan_.instances[i],
            .seed = plan_.seeds[i]};
  }

  ExitCode run_in_steps() {
    Counter counter(output_, "simulated", "runs");
    bool all_same = true;
    for (std::size_t i = 0; i < plan_.seeds.size(); ++i) {
      const auto result =
          run_in_lock_step(end_, plan_.end.sensors, run_at(i), options_, table_.recorder());
      if (!result) return fail(output_, exit_code_of(result.error()), result.error());
      std::optional<bool> same;
      if (words_.compare) same = same_bits(in_process(i), *result);
      all_same = all_same && same.value_or(true);
      tell(plan_.seeds[i], *result, same);
      counter.tell(static_cast<std::int64_t>(i) + 1, static_cast<std::int64_t>(plan_.seeds.size()));
    }
    if (plan_.end.sensors.senses) end_runs(end_);
    if (all_same) return ExitCode::Done;
    return fail(output_, ExitCode::Failed,
                words_.topics
                    ? "the nodes' runs differ from those in this process; messages on the drivers' "
                      "topics are float32: compare with a profile that has wire = \"float32\", and "
                      "--wheels floats on both sides"
                    : "the nodes' runs differ from those in this process; do the nodes have this "
                      "machine, flavour and seed, and does each have its own random stream?");
  }

  Measured in_process(std::size_t i) const {
    return simulate({.controller = plan_.machine->controller,
                     .flavour = plan_.machine->flavour,
                     .profile = plan_.profile,
                     .mission = plan_.mission,
                     .instance = plan_.instances[i],
                     .seed = plan_.seeds[i]});
  }

  void tell(std::int64_t seed, const Measured& result, std::optional<bool> same) {
    if (output_.json) {
      JsonObject object;
      object.add("seed", seed)
          .add("score", result.score)
          .add("digest", digest_text(result.state_digest));
      if (same) object.add("same_in_process", *same);
      output_.out << object.text() << "\n" << std::flush;
      return;
    }
    output_.out << "seed " << seed << "  score " << json_number(result.score) << "  digest "
                << digest_text(result.state_digest);
    if (same) output_.out << (*same ? "  same bits in process" : "  DIFFERS in process");
    output_.out << "\n" << std::flush;
  }

  ExitCode run_by_clock() {
    RealTimeOptions options;
    static_cast<WorldOptions&>(options) = options_;
    options.faults = plan_.faults;
    if (!words_.at_once) {
      options.start_of = start_of;
      print_note(output_,
                 "the robots are in their places; start them with `swarmsmith-robot start`");
    }
    const auto result =
        run_in_real_time(end_, plan_.end.sensors, run_at(0), options, table_.recorder());
    if (!result) return fail(output_, exit_code_of(result.error()), result.error());
    const double start_s = seconds_of(result->start.time_since_epoch());
    const double latest_ms = std::chrono::duration<double, std::milli>(result->latest).count();
    if (output_.json) {
      output_.out << JsonObject()
                         .add("seed", plan_.seeds[0])
                         .add("score", result->simulation.score)
                         .add("start_clock_s", start_s)
                         .add("latest_ms", latest_ms)
                         .add("stops_by_silence", std::int64_t{result->stops_by_silence})
                         .add("stops_by_rivals", std::int64_t{result->stops_by_rivals})
                         .text()
                  << "\n";
    } else {
      output_.out << "seed " << plan_.seeds[0] << "  score "
                  << json_number(result->simulation.score) << "  stopped by silence "
                  << result->stops_by_silence << "  by a second node " << result->stops_by_rivals
                  << "  world late by at most " << json_number(latest_ms) << " ms\n";
    }
    return ExitCode::Done;
  }

  const WorldWords& words_;
  const Plan& plan_;
  WorldEnd& end_;
  TrajectoryTable& table_;
  Output& output_;
  WorldOptions options_;
};

ExitCode run(const WorldWords& words, Output& output) {
  const auto plan = plan_of(words, output);
  if (!plan) return fail(output, ExitCode::Usage, plan.error());
  auto table = TrajectoryTable::open(words.csv);
  if (!table) return fail(output, ExitCode::Failed, table.error());
  catch_stop_signals();
  auto end = open_world_end(words.transport, plan->robots, plan->end);
  if (!end) return fail(output, exit_code_of_transport(end.error()), end.error());
  return World(words, *plan, **end, *table, output).run();
}

}  // namespace

CommandRun declare_robot_world(Options& options) {
  auto words = std::make_shared<WorldWords>();
  options.text("--mission MISSION|FILE", words->mission, joined(mission_names()) + " or a file",
               Options::Need::Required);
  options.text("--profile PROFILE|FILE", words->profile,
               "Simulator profile: " + joined(profile_names()) + " or a file (default rvr)");
  options.text("--seeds SEEDS", words->seeds, "Seeds of the runs: 1-10 or 1,4,7-9 (default 1)");
  options.text("--robots ROBOTS", words->robots,
               "Names of the robots, in the order of the mission: 1-3 or rvr1,rvr4 (default rvr1 "
               "and so on, as many as the mission has)");
  options.flag("--lock-step", words->lock_step,
               "Wait for every answer of the nodes: scores and last states are those of "
               "`evaluate`, bit for bit");
  options.flag("--topics", words->topics,
               "With --lock-step: use the drivers' topics, and count their messages");
  options.flag("--real-time", words->real_time,
               "By the clock, as in a laboratory; `start` begins the run");
  options.flag("--at-once", words->at_once, "With --real-time: begin when all nodes are connected");
  options.flag("--compare", words->compare,
               "Also run everything in this process, and compare all bits");
  options.text("--machine MACHINE|FILE", words->machine, "For --compare: the machine of the nodes");
  options.text("--flavour FLAVOUR|FILE", words->flavour,
               "For --compare: its flavour (default: its file's)");
  options.choice("--turn-clock", words->turn_clock,
                 {{"cycles", TurnClock::Cycles}, {"seconds", TurnClock::Seconds}},
                 "For --compare: unit of a turn's length");
  options.choice("--ranges", words->ranges_apart, {{"array", false}, {"apart", true}},
                 "Proximity in one topic `ranges`, or in eight (default array)");
  options.choice(
      "--neighbours", words->scan, {{"neighbours", false}, {"scan", true}},
      "Send `neighbours`, or a lidar's `scan`, which also sees walls (default neighbours)");
  options.flag("--light", words->light, "Send `light`, for machines of flavour chocolate");
  declare_wheels(options, words->wheels);
  options.number("--wait SECONDS", words->wait_s, {0, 86'400},
                 "Seconds to wait for the nodes (default 60)");
  options.number("--patience SECONDS", words->patience_s, {0.05, 3600},
                 "Seconds to wait for an answer in lock-step (default 5)");
  options.texts("--fault", words->faults,
                "Disturb a sensor for a time: ROBOT:SENSOR:WHAT:FROM-TO, such as "
                "rvr1:ranges:silent:10-10.3; repeatable");
  options.text("--csv FILE", words->csv, "Write the true poses and commands to this file");
  words->transport.declare_client(options);
  return [words](Output& output) { return run(*words, output); };
}

}  // namespace swarmsmith
