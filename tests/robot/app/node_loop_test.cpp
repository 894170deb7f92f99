#include "robot/app/node_loop.h"

#include <atomic>
#include <fstream>
#include <limits>
#include <thread>

#include "robot/runtime/replay.h"
#include "robot/runtime/robot_kind.h"
#include "robot/transport/in_process.h"
#include "robot/world/lock_step.h"
#include "robot/zeromq/zmq_ends.h"
#include "sim/engine/simulate.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"
#include "sim/files/robot_file.h"
#include "tests/robot/runtime/rover.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr const char* kMachine =
    "--nstates 2 --s0 0 --rwm0 10 --n0 1 --n0x0 0 --c0x0 0 --p0x0 0.8 "
    "--s1 2 --att1 2 --n1 1 --n1x0 0 --c1x0 5 --p1x0 0.1";

TimePoint now() {
  return SystemClock().now();
}

/// A node's loop in a thread of its own, ten times as fast as on a robot. `patience`: how long its
/// sensors and its operator may be silent; a test's thread may get no processor for a while.
class RunningNode {
 public:
  RunningNode(RobotEnd& end, LoopOptions options, NodeSettings settings = {},
              Duration patience = seconds(10))
      : controller_(parse_controller(kMachine, watermelon()).value()) {
    if (options.pace == Pace::Clock) settings.period = milliseconds(10);
    settings.hold.fill(patience);
    settings.give_up = settings.operator_gone = patience;
    settings.driver_hold = settings.operator_hold = patience;
    node_.emplace(settings, controller_, watermelon());
    options.ends = [this]() -> std::optional<std::string> {
      if (!asked_) return std::nullopt;
      return "by SIGTERM";
    };
    options.note = [this](const std::string& text) { notes.push_back(text); };
    thread_ = std::thread([this, &end, options = std::move(options)]() mutable {
      ending = NodeLoop(*node_, end, std::move(options)).run();
    });
  }
  ~RunningNode() {
    ask_to_end();
    join();
  }

  void ask_to_end() { asked_ = true; }
  void join() {
    if (thread_.joinable()) thread_.join();
  }

  // After `join`.
  std::optional<NodeLoop::Ending> ending;
  std::vector<std::string> notes;

 private:
  Controller controller_;
  std::optional<RobotNode> node_;
  std::atomic<bool> asked_ = false;
  std::thread thread_;
};

/// Drivers and operator of one robot.
class Outside {
 public:
  Outside(WorldEnd& world, OperatorEnd& operating) : world_(world), operator_(operating) {}

  void send(const Order& order) { operator_.send(OrderMessage{.text = order_text(order)}); }

  Order order(Order::Kind kind, const std::string& run = "run07") {
    Order made;
    made.kind = kind;
    made.id = "o" + std::to_string(++orders_);
    made.run = run;
    made.sent_unix_s = now_on_both_clocks().unix_s;
    made.at_unix_s = made.sent_unix_s + 0.5;
    made.seconds = 1;
    return made;
  }

  /// Orders a run until the node obeys: an order that it gets too late is refused.
  std::optional<Order> start(double run_s = 1, const std::string& run = "run07") {
    for (int tried = 0; tried < 10; ++tried) {
      Order made = order(Order::Kind::Start, run);
      made.seconds = run_s;
      send(made);
      if (!until([&](const NodeState& told) { return told.order == made.id; })) break;
      if (state.refused.empty()) return made;
    }
    return std::nullopt;
  }

  /// Sensors go out, and the operator is there, until a state fulfils the condition, or ten
  /// seconds.
  template <class Condition>
  testing::AssertionResult until(const Condition& condition) {
    const TimePoint end = now() + seconds(10);
    while (now() < end) {
      drive();
      while (const auto received = operator_.receive(now() + milliseconds(4))) {
        const auto* message = std::get_if<StateMessage>(&received->message);
        if (message == nullptr) continue;
        state = parse_state(message->text).value();
        if (condition(state)) return testing::AssertionSuccess();
      }
    }
    return testing::AssertionFailure() << "the last state was " << state_text(state);
  }

  auto until_phase(Phase phase) {
    return until([phase](const NodeState& told) { return told.phase == phase; });
  }

  /// What came for the treads so far is taken.
  void hear_treads(TimePoint until) {
    while (const auto received = world_.receive(until)) {
      if (const auto* wheels = std::get_if<WheelsMessage>(&received->message)) {
        speed = std::max(std::fabs(wheels->left_mps), std::fabs(wheels->right_mps));
        fastest = std::max(fastest, speed);
        ++commands;
      }
    }
  }

  bool sensors = true;
  NodeState state;
  double speed = 0;  ///< last commanded
  double fastest = 0;
  int commands = 0;

 private:
  void drive() {
    if (sensors) {
      world_.send(0, RangesMessage{.ranges_m = std::vector<double>(
                                       8, std::numeric_limits<double>::infinity())});
      world_.send(0, GroundColorMessage{.r = 127, .g = 127, .b = 127});
      world_.send(0, NeighboursMessage{.robots = {{0.5, 1, 0}}});
    }
    send(order(Order::Kind::Alive));
    hear_treads(now());
  }

  WorldEnd& world_;
  OperatorEnd& operator_;
  int orders_ = 0;
};

TEST(NodeLoop, RunsWhatIsOrderedAndWritesItsLog) {
  const TemporaryFolder folder;
  InProcessSwarm swarm({"rvr1"}, Keep::All);
  RunningNode node(swarm.robot(0), {.logs = folder.path()});
  Outside outside(swarm.world(), swarm.operator_end());
  ASSERT_TRUE(outside.until_phase(Phase::Ready));
  ASSERT_TRUE(outside.start());
  ASSERT_TRUE(outside.until_phase(Phase::Ended));
  EXPECT_EQ(outside.fastest, 0.3);
  node.ask_to_end();
  node.join();
  EXPECT_EQ(node.ending, NodeLoop::Ending::Asked);
  outside.hear_treads(now());
  EXPECT_EQ(outside.speed, 0);
  const auto record = value_of(read_robot_log(folder / "run07.rvr1.log.csv"));
  ASSERT_TRUE(record.head.end);
  EXPECT_EQ(record.head.end->state, "ended");
  EXPECT_EQ(static_cast<std::int64_t>(record.rows.size()) + record.head.end->skipped, 99);
  const auto replay = value_of(replay_log(record));
  EXPECT_FALSE(replay.difference);
}

TEST(NodeLoop, StandsStillOnItsWayOut) {
  const TemporaryFolder folder;
  InProcessSwarm swarm({"rvr1"}, Keep::All);
  RunningNode node(swarm.robot(0), {.logs = folder.path()});
  Outside outside(swarm.world(), swarm.operator_end());
  ASSERT_TRUE(outside.until_phase(Phase::Ready));
  EXPECT_EQ(outside.commands, 0) << "a robot that is carried to its place is left alone";
  ASSERT_TRUE(outside.start(60));
  ASSERT_TRUE(outside.until([&](const NodeState&) { return outside.fastest > 0; }));
  node.ask_to_end();
  node.join();
  outside.hear_treads(now());
  EXPECT_EQ(outside.speed, 0);
  const auto record = value_of(read_robot_log(folder / "run07.rvr1.toml"));
  EXPECT_EQ(record.head.end->state, "stopped");
  EXPECT_EQ(record.head.end->verdict, RunVerdict::Invalid);
}

TEST(NodeLoop, StandsStillWhenSensorsFallSilentAndFails) {
  const TemporaryFolder folder;
  InProcessSwarm swarm({"rvr1"}, Keep::All);
  RunningNode node(swarm.robot(0), {.logs = folder.path()}, {}, seconds(2));
  Outside outside(swarm.world(), swarm.operator_end());
  ASSERT_TRUE(outside.until_phase(Phase::Ready));
  ASSERT_TRUE(outside.start(60));
  ASSERT_TRUE(outside.until([&](const NodeState&) { return outside.fastest > 0; }));
  outside.sensors = false;
  ASSERT_TRUE(outside.until_phase(Phase::Failed));
  outside.hear_treads(now());
  EXPECT_EQ(outside.speed, 0);
  EXPECT_THAT(outside.state.reasons[0], HasSubstr("silent for"));
}

TEST(NodeLoop, DoesNotBeginARunWhoseLogIsThereAlready) {
  const TemporaryFolder folder;
  std::ofstream(folder / "run07.rvr1.log.csv") << "precious";
  InProcessSwarm swarm({"rvr1"}, Keep::Newest);
  RunningNode node(swarm.robot(0), {.logs = folder.path()});
  Outside outside(swarm.world(), swarm.operator_end());
  ASSERT_TRUE(outside.until_phase(Phase::Ready));
  outside.send(outside.order(Order::Kind::Start));
  ASSERT_TRUE(outside.until([](const NodeState& state) { return !state.refused.empty(); }));
  EXPECT_THAT(outside.state.refused, HasSubstr("run07.rvr1.log.csv: already exists"));
  EXPECT_EQ(outside.state.phase, Phase::Idle);
  EXPECT_EQ(whole_file(folder / "run07.rvr1.log.csv"), "precious");
  EXPECT_TRUE(outside.start(1, "run08"));
}

TEST(NodeLoop, OverAWireRefusesOrdersThatAreOldRepeatedOrForeign) {
  const TemporaryFolder folder;
  auto server = value_of(zmq_robot_end("rvr1", {.end = {.sensors = {.neighbours = true}}}));
  RunningNode node(*server.end, {.logs = folder.path()});
  const EndOptions options = {.sensors = {.neighbours = true}};
  const auto world = zmq_world_end({{"rvr1", server.endpoint}}, {.end = options});
  const auto operating = zmq_operator_end({{"rvr1", server.endpoint}}, {.end = options});
  ASSERT_TRUE(world && operating);
  Outside outside(**world, **operating);
  ASSERT_TRUE(outside.until_phase(Phase::Ready));
  const auto refused = [&](const char* why) {
    return outside.until(
        [why](const NodeState& state) { return state.refused.find(why) != std::string::npos; });
  };
  Order order = outside.order(Order::Kind::Start);
  order.sent_unix_s -= 60;
  outside.send(order);
  EXPECT_TRUE(refused("old"));
  order = outside.order(Order::Kind::Start);
  order.robots = {"rvr2"};
  outside.send(order);
  (*operating)->send(OrderMessage{.text = "{\"order\":\"start\""});
  EXPECT_TRUE(refused("JSON"));
  EXPECT_NE(outside.state.phase, Phase::Armed);
  const auto obeyed = value_of(outside.start(60));
  ASSERT_TRUE(outside.until_phase(Phase::Running));
  outside.send(obeyed);
  EXPECT_TRUE(refused("before"));
  Order stop = outside.order(Order::Kind::Stop, "run06");
  outside.send(stop);
  EXPECT_TRUE(refused("the run run07 is in progress, not run06"));
  EXPECT_EQ(outside.state.phase, Phase::Running);
  outside.send(outside.order(Order::Kind::Stop));
  ASSERT_TRUE(outside.until_phase(Phase::Stopped));
  outside.send(obeyed);  // played back after the run
  EXPECT_TRUE(outside.until([](const NodeState& state) { return !state.refused.empty(); }));
  EXPECT_EQ(outside.state.phase, Phase::Stopped);
}

TEST(NodeLoop, OverAWireRefusesOrdersForAnotherRobot) {
  const TemporaryFolder folder;
  for (const auto& [driven, wanted] :
       {std::pair(rvr(), rover()), std::pair(rover(), rvr()), std::pair(rover(), rover())}) {
    auto server = value_of(zmq_robot_end("rvr1", {.end = {.sensors = {.neighbours = true}}}));
    RunningNode node(*server.end, {.logs = folder.path()}, {.kind = driven});
    const EndOptions options = {.sensors = {.neighbours = true}};
    const auto world = zmq_world_end({{"rvr1", server.endpoint}}, {.end = options});
    const auto operating = zmq_operator_end({{"rvr1", server.endpoint}}, {.end = options});
    ASSERT_TRUE(world && operating);
    Outside outside(**world, **operating);
    ASSERT_TRUE(outside.until_phase(Phase::Ready));
    Order order = outside.order(Order::Kind::Start);
    order.own_robot = own_robot_text(wanted);
    outside.send(order);
    ASSERT_TRUE(outside.until([&](const NodeState& told) { return told.order == order.id; }));
    EXPECT_EQ(outside.state.refused, other_robot("the order", wanted, driven).value_or(""));
    EXPECT_EQ(outside.state.own_robot, own_robot_text(driven));
    EXPECT_EQ(outside.state.phase == Phase::Armed, driven == wanted);
  }
}

TEST(NodeLoop, InLockStepGivesTheBitsOfTheSimulatorAndLogsThatReplay) {
  const TemporaryFolder folder;
  const Mission mission = find_mission("aggregation", {}).value().mission;
  const Profile profile = built_in_profile("rvr").value();
  const Controller controller = parse_controller(kMachine, watermelon()).value();
  InProcessSwarm swarm({"rvr1", "rvr2", "rvr3"});
  std::vector<std::unique_ptr<RunningNode>> nodes;
  for (int i = 0; i < 3; ++i) {
    NodeSettings settings{.robot = "rvr" + std::to_string(i + 1),
                          .robot_index = i,
                          .max_mps = kMaxWheelSpeed_mps,
                          .lock_step_run = "exact"};
    nodes.push_back(std::make_unique<RunningNode>(
        swarm.robot(static_cast<std::size_t>(i)),
        LoopOptions{.pace = Pace::Senses, .logs = folder.path()}, settings));
  }
  SensorTopics sensors;
  sensors.senses = true;
  for (const std::int64_t seed : {3, 4}) {
    const Instance instance = instance_of(mission, seed).value();
    const auto result = value_of(run_in_lock_step(
        swarm.world(), sensors,
        {.profile = profile, .mission = mission, .instance = instance, .seed = seed}, {}));
    const Measured wanted = simulate({.controller = controller,
                                      .flavour = watermelon(),
                                      .profile = profile,
                                      .mission = mission,
                                      .instance = instance,
                                      .seed = seed});
    EXPECT_EQ(result.score, wanted.score);
    EXPECT_EQ(result.state_digest, wanted.state_digest);
  }
  end_runs(swarm.world());
  for (const auto& node : nodes) {
    node->join();
    EXPECT_EQ(node->ending, NodeLoop::Ending::NoMoreRuns);
  }
  for (const char* name : {"exact-seed3.rvr1", "exact-seed4.rvr1", "exact-seed3.rvr3"}) {
    const auto record = value_of(read_robot_log(folder / (std::string(name) + ".toml")));
    EXPECT_EQ(record.rows.size(), 1200U);
    EXPECT_EQ(record.head.end.value().verdict, RunVerdict::Valid);
    const auto replay = value_of(replay_log(record));
    EXPECT_FALSE(replay.difference) << replay.difference->what;
  }
}

TEST(NodeLoop, InLockStepEndsWhenTheWorldIsGone) {
  InProcessSwarm swarm({"rvr1"});
  RunningNode node(swarm.robot(0), {.pace = Pace::Senses, .patience = milliseconds(50)});
  SensesMessage senses{.seed = 1, .cycle = 1, .time_s = 0.1};
  senses.ranges_m.fill(std::numeric_limits<double>::infinity());
  swarm.world().send(0, senses);
  node.join();
  EXPECT_EQ(node.ending, NodeLoop::Ending::Lost);
  EXPECT_THAT(node.notes, ElementsAre(HasSubstr("no message from the world")));
}

}  // namespace
}  // namespace swarmsmith
