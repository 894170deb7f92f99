#include "robot/world/lock_step.h"

#include <atomic>
#include <limits>
#include <memory>
#include <thread>

#include "robot/app/node_loop.h"
#include "robot/transport/in_process.h"
#include "robot/world/sensor_messages.h"
#include "sim/files/profile_file.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

constexpr int kRobots = 3;

std::vector<std::string> names() {
  return {"rvr1", "rvr2", "rvr3"};
}

/// Looks at floor, neighbours and obstacles, and draws.
Controller busy_machine() {
  return Machine{
      .states = {{.behaviour = Exploration{12},
                  .transitions = {{.condition = NeighbourCount{.eta = 4.5, .xi = 1}, .target = 1},
                                  {.condition = BlackFloor{0.8}, .target = 1}}},
                 {.behaviour = Attraction{3.25},
                  .transitions = {{.condition = FixedProbability{0.05}, .target = 0}}}}};
}

/// Robots' nodes, as `swarmsmith-robot run` has them, a thread each.
class Nodes {
 public:
  Nodes(InProcessSwarm& swarm, const Controller& controller, const Flavour& flavour, Pace pace,
        std::int64_t seed, int index_offset = 0) {
    for (int i = 0; i < kRobots; ++i) {
      const auto robot = static_cast<std::size_t>(i);
      NodeSettings settings;
      settings.robot = names()[robot];
      settings.robot_index = i + index_offset;
      settings.seed = seed;
      settings.max_mps = kMaxWheelSpeed_mps;
      nodes_.push_back(std::make_unique<RobotNode>(settings, controller, flavour));
      loops_.push_back(
          std::make_unique<NodeLoop>(*nodes_.back(), swarm.robot(robot),
                                     LoopOptions{.pace = pace,
                                                 .logs = {},
                                                 .patience = std::chrono::minutes(2),
                                                 .ends = [this]() -> std::optional<std::string> {
                                                   if (end_) return "by the test";
                                                   return std::nullopt;
                                                 }}));
      threads_.emplace_back([loop = loops_.back().get()] { loop->run(); });
    }
  }
  ~Nodes() {
    end_ = true;
    for (std::thread& thread : threads_)
      thread.join();
  }

 private:
  std::atomic<bool> end_{false};
  std::vector<std::unique_ptr<RobotNode>> nodes_;
  std::vector<std::unique_ptr<NodeLoop>> loops_;
  std::vector<std::thread> threads_;
};

struct Scene {
  explicit Scene(const std::string& profile_name, std::int64_t of_seed = 7)
      : profile(*built_in_profile(profile_name)),
        mission(*built_in_mission("aggregation")),
        seed(of_seed) {
    mission.cycles = 200;
    instance = *instance_of(mission, seed);
  }

  WorldRun run() const {
    return {.profile = profile, .mission = mission, .instance = instance, .seed = seed};
  }
  Measured alone() const {
    return simulate({.controller = controller,
                     .flavour = watermelon(),
                     .profile = profile,
                     .mission = mission,
                     .instance = instance,
                     .seed = seed});
  }

  Profile profile;
  Mission mission;
  std::int64_t seed;
  Instance instance;
  Controller controller = busy_machine();
};

SensorTopics by_number() {
  SensorTopics topics;
  topics.senses = true;
  return topics;
}

TEST(LockStep, ByNumberHasTheBitsOfARunWithoutNodes) {
  for (const char* profile : {"argos3", "rvr", "pseudo-reality"}) {
    const Scene scene(profile);
    InProcessSwarm swarm(names());
    const Nodes nodes(swarm, scene.controller, watermelon(), Pace::Senses, 1);
    const auto result = value_of(run_in_lock_step(swarm.world(), by_number(), scene.run(), {}));
    EXPECT_EQ(result.state_digest, scene.alone().state_digest) << profile;
    EXPECT_EQ(result.score, scene.alone().score) << profile;
    end_runs(swarm.world());
  }
}

TEST(LockStep, OneNodeRunsSeedAfterSeed) {
  InProcessSwarm swarm(names());
  const Controller controller = busy_machine();
  const Nodes nodes(swarm, controller, watermelon(), Pace::Senses, 1);
  for (const std::int64_t seed : {3, 4, 3}) {
    const Scene scene("rvr", seed);
    const auto result = value_of(run_in_lock_step(swarm.world(), by_number(), scene.run(), {}));
    EXPECT_EQ(result.state_digest, scene.alone().state_digest) << seed;
  }
}

TEST(LockStep, ByCountingHasTheSameBits) {
  const Scene scene("rvr");
  InProcessSwarm swarm(names());
  const Nodes nodes(swarm, scene.controller, watermelon(), Pace::CountedTopics, scene.seed);
  const auto result = value_of(run_in_lock_step(swarm.world(), world_topics(), scene.run(), {}));
  EXPECT_EQ(result.state_digest, scene.alone().state_digest);
}

TEST(LockStep, AnotherRandomStreamIsAnotherRun) {
  const Scene scene("rvr");
  InProcessSwarm swarm(names());
  const Nodes nodes(swarm, scene.controller, watermelon(), Pace::Senses, 1, 1);
  const auto result = value_of(run_in_lock_step(swarm.world(), by_number(), scene.run(), {}));
  EXPECT_NE(result.state_digest, scene.alone().state_digest);
}

/// Answers for all robots until `until`; then in another way.
template <class Answer>
Expected<Measured> run_against(Answer answer_as) {
  const Scene scene("argos3");
  InProcessSwarm swarm(names());
  std::atomic<bool> over{false};
  std::thread nodes([&] {
    while (!over) {
      for (std::size_t i = 0; i < kRobots; ++i) {
        const auto message = swarm.robot(i).receive(SystemClock().now());
        if (!message) continue;
        const auto& senses = std::get<SensesMessage>(*message);
        AnswerMessage answer{{}, senses.seed, senses.cycle, 0.1, 0.1, 0};
        if (answer_as(i, answer)) swarm.robot(i).send(answer);
      }
    }
  });
  WorldOptions options;
  options.patience = std::chrono::milliseconds(300);
  auto result = run_in_lock_step(swarm.world(), by_number(), scene.run(), options);
  over = true;
  nodes.join();
  return result;
}

TEST(LockStep, ASilentNodeEndsTheRunByNameAndCycle) {
  const auto result = run_against([](std::size_t robot, const AnswerMessage& answer) {
    return robot != 1 || answer.cycle < 12;
  });
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().kind, ErrorKind::Unavailable);
  EXPECT_THAT(result.error().message, HasSubstr("no answer from rvr2 in cycle 12 of seed 7"));
}

TEST(LockStep, AnAnswerToAnotherQuestionIsNotTaken) {
  const auto result = run_against([](std::size_t robot, AnswerMessage& answer) {
    if (robot == 2 && answer.cycle == 9) answer.cycle = 8;
    return true;
  });
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().kind, ErrorKind::BadInput);
  EXPECT_THAT(to_string(result.error()), HasSubstr("rvr3"));
  EXPECT_THAT(result.error().message, HasSubstr("asked about cycle 9"));
  EXPECT_THAT(result.error().message, HasSubstr("answers cycle 8"));
}

TEST(LockStep, ACommandThatIsNoNumberEndsTheRun) {
  const auto result = run_against([](std::size_t robot, AnswerMessage& answer) {
    if (robot == 0 && answer.cycle == 5) answer.left_mps = std::numeric_limits<double>::infinity();
    return true;
  });
  ASSERT_FALSE(result.has_value());
  EXPECT_THAT(result.error().message, HasSubstr("robot 0"));
}

TEST(LockStep, ANodeWithAnObjectionIsRefusedByName) {
  const Scene scene("argos3");
  InProcessSwarm swarm(names());
  const Nodes nodes(swarm, scene.controller, watermelon(), Pace::Senses, 1);
  WorldOptions options;
  int states = 0;
  options.objection = [&states](const StateMessage& state) -> std::optional<std::string> {
    ++states;
    if (state.text.find("\"rvr2\"") == std::string::npos) return std::nullopt;
    return "it is another robot";
  };
  const auto there = wait_for_robots(swarm.world(), std::chrono::seconds(20), options);
  ASSERT_FALSE(there.has_value());
  EXPECT_EQ(to_string(there.error()), "rvr2: it is another robot");
  options.objection = [](const StateMessage&) { return std::optional<std::string>(); };
  EXPECT_TRUE(wait_for_robots(swarm.world(), std::chrono::seconds(20), options));
  EXPECT_GT(states, 0);
}

TEST(LockStep, AnotherNumberOfRobotsIsRefused) {
  const Scene scene("argos3");
  InProcessSwarm swarm({"rvr1"});
  const auto result = run_in_lock_step(swarm.world(), by_number(), scene.run(), {});
  ASSERT_FALSE(result.has_value());
  EXPECT_THAT(result.error().message, HasSubstr("3 robots, but 1"));
}

}  // namespace
}  // namespace swarmsmith
