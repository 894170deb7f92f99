#include "sim/engine/decider.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/control/used_senses.h"
#include "sim/engine/fitting.h"
#include "sim/engine/simulate.h"
#include "sim/files/profile_file.h"
#include "sim/files/robot_file.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

constexpr std::array kMissions = {"aggregation", "grid_exploration", "color_selection"};
constexpr std::array kProfiles = {"argos3", "rvr", "pseudo-reality", "thesis-robots", "epuck"};

/// One of each architecture, of modules that all flavours have; together they ask for every sensor
/// that the flavour's modules know.
std::vector<Controller> controllers(const Flavour& flavour) {
  const bool lit = flavour.find(Module::Phototaxis) != nullptr;
  const Behaviour fourth = lit ? Behaviour(Phototaxis{}) : Behaviour(Repulsion{2.5});
  Machine machine{
      .states = {{.behaviour = Exploration{12},
                  .transitions = {{.condition = NeighbourCount{.eta = 4.5, .xi = 1}, .target = 1},
                                  {.condition = BlackFloor{0.8}, .target = 2},
                                  {.condition = FixedProbability{0.02}, .target = 3}}},
                 {.behaviour = Attraction{3.25},
                  .transitions = {{.condition = FixedProbability{0.03}, .target = 0},
                                  {.condition = WhiteFloor{0.9}, .target = 3}}},
                 {.behaviour = Stop{},
                  .transitions = {{.condition = GrayFloor{0.2}, .target = 0},
                                  {.condition = FixedProbability{0.02}, .target = 3}}},
                 {.behaviour = fourth,
                  .transitions = {
                      {.condition = InvertedNeighbourCount{.eta = 7.5, .xi = 2}, .target = 0}}}}};
  Tree tree{.subtrees = {{.condition = NeighbourCount{.eta = 5, .xi = 1}, .action = Exploration{9}},
                         {.condition = FixedProbability{0.05}, .action = Attraction{5}},
                         {.condition = BlackFloor{0.5}, .action = fourth}}};
  Network network{.inputs = lit ? NetworkInputs::Rm12 : NetworkInputs::Rvr, .weights = {}};
  Rng rng = Rng(5).split("weights");
  for (std::size_t i = 0; i < kWheels * input_count(network.inputs); ++i)
    network.weights.push_back(rng.uniform(-kMostWeight, kMostWeight));
  return {machine, tree, network};
}

/// What travelled to the other side: nothing else can be asked for there.
class TravelledSenses final : public Senses {
 public:
  TravelledSenses(const Decider::Question& question, const UsedSenses& used)
      : used_(used), time_s_(question.time_s) {
    // Not in the order in which a controller asks.
    if (used.light) light_ = copy_of(question.senses.light());
    if (used.neighbours) {
      const std::span<const Neighbour> seen = question.senses.neighbours();
      neighbours_.assign(seen.begin(), seen.end());
      count_ = question.senses.neighbour_count();
    }
    if (used.ground_color) ground_ = question.senses.ground_color();
    if (used.proximity) proximity_ = copy_of(question.senses.proximity());
  }

  ProximityReadings proximity() override {
    need(used_.proximity, "proximity");
    return proximity_;
  }
  const Rgb& ground_color() override {
    need(used_.ground_color, "the ground's colour");
    return ground_;
  }
  std::span<const Neighbour> neighbours() override {
    need(used_.neighbours, "neighbours");
    return neighbours_;
  }
  int neighbour_count() override {
    need(used_.neighbours, "neighbours");
    return count_;
  }
  LightReadings light() override {
    need(used_.light, "light");
    return light_;
  }
  double time_s() override { return time_s_; }

 private:
  static std::vector<double> copy_of(std::span<const double> ring) {
    return {ring.begin(), ring.end()};
  }
  static void need(bool travelled, const std::string& what) {
    if (!travelled) throw std::logic_error(what + " was asked for, and has not travelled");
  }

  UsedSenses used_;
  double time_s_;
  std::vector<double> proximity_;
  Rgb ground_;
  std::vector<Neighbour> neighbours_;
  int count_ = 0;
  std::vector<double> light_;
};

/// Runs the same control software on the other side of the seam.
class OtherSide : public Decider {
 public:
  OtherSide(const SimulationSetup& setup)
      : used_(senses_used_by(setup.controller, setup.flavour)),
        flavour_(fitted(setup.flavour, setup.mission.robot)),
        answers_(setup.instance.starts.size()) {
    for (std::size_t i = 0; i < answers_.size(); ++i) {
      controls_.emplace_back(setup.controller, flavour_,
                             control_stream(setup.seed, static_cast<int>(i)));
    }
  }

  void ask(const Question& question) override {
    const auto robot = static_cast<std::size_t>(question.robot);
    EXPECT_EQ(question.time_s, question.senses.time_s());
    TravelledSenses senses(question, used_);
    if (reads_all) question.senses.read(Sensors::all());
    EXPECT_FALSE(answers_[robot].has_value()) << "a question before the last one was answered";
    answers_[robot] = Answer{.command = controls_[robot].step(senses), .state = 0};
    answers_[robot]->state = controls_[robot].state();
  }

  std::optional<Answer> answer(int robot) override {
    std::optional<Answer> given;
    given.swap(answers_[static_cast<std::size_t>(robot)]);
    return given;
  }

  bool reads_all = false;

 private:
  UsedSenses used_;
  Flavour flavour_;
  std::vector<ControlSoftware> controls_;
  std::vector<std::optional<Answer>> answers_;
};

/// What is recorded of a run, and its result.
struct Recorded {
  Measured result;
  std::vector<Command> commands;
  std::vector<int> states;

  static Recorded of(const SimulationSetup& setup, Decider* decider = nullptr) {
    Recorded run;
    run.result = simulate(
        setup,
        [&](const Snapshot& now) {
          for (const RobotRecord& robot : now.robots) {
            run.commands.push_back(robot.command);
            run.states.push_back(robot.state);
          }
        },
        decider);
    return run;
  }
};

TEST(Decider, TheSameControlSoftwareBehindItGivesTheSameBits) {
  for (const char* mission_name : kMissions) {
    Mission mission = built_in_mission(mission_name).value();
    mission.arena.lights.push_back({.x_m = 0.4, .y_m = -0.8, .z_m = 0.75, .intensity_cd = 900});
    const Instance instance = instance_of(mission, 17).value();
    for (const Flavour* flavour : not_empty(all_flavours())) {
      mission.robot = misfit(*flavour, rvr()) ? find_robot("epuck", "").value() : rvr();
      if (misfit(*flavour, mission.robot)) continue;
      const std::vector<Controller> all = controllers(*flavour);
      for (const char* profile_name : kProfiles) {
        const Profile profile = built_in_profile(profile_name).value();
        if (misfit(profile, mission.robot)) continue;
        // Of 800 cycles a second 20 s are enough.
        mission.cycles = profile.timing.most_period < 0.1 ? 200 : 1200;
        for (const Controller& controller : all) {
          SCOPED_TRACE(std::string(mission_name) + " " + flavour->name + " " + profile_name + " " +
                       std::string(name_of(architecture_of(controller))));
          ASSERT_FALSE(check(controller, *flavour).has_value());
          const SimulationSetup setup{.controller = controller,
                                      .flavour = *flavour,
                                      .profile = profile,
                                      .mission = mission,
                                      .instance = instance,
                                      .seed = 17};
          const Recorded expected = Recorded::of(setup);
          OtherSide decider(setup);
          // The engine needs no controller then.
          const Controller none;
          const Recorded run = Recorded::of({.controller = none,
                                             .flavour = *flavour,
                                             .profile = profile,
                                             .mission = mission,
                                             .instance = instance,
                                             .seed = 17},
                                            &decider);
          EXPECT_EQ(run.result.state_digest, expected.result.state_digest);
          EXPECT_EQ(run.result.score, expected.result.score);
          EXPECT_EQ(run.commands, expected.commands);
          EXPECT_EQ(run.states, expected.states);
        }
      }
    }
  }
}

/// A short run for the tests of one rule each.
class ShortRun : public testing::Test {
 protected:
  ShortRun() { mission_.cycles = 50; }

  SimulationSetup setup() const {
    return {.controller = controller_,
            .flavour = watermelon(),
            .profile = profile_,
            .mission = mission_,
            .instance = instance_,
            .seed = 3};
  }

  Controller controller_ = controllers(watermelon())[0];
  Profile profile_ = built_in_profile("pseudo-reality").value();
  Mission mission_ = built_in_mission("aggregation").value();
  Instance instance_ = instance_of(mission_, 3).value();
};

TEST_F(ShortRun, WhatADeciderReadsChangesNothing) {
  OtherSide decider(setup());
  decider.reads_all = true;
  EXPECT_EQ(Recorded::of(setup(), &decider).result.state_digest,
            Recorded::of(setup()).result.state_digest);
}

/// Notes what the engine calls.
class Listener final : public OtherSide {
 public:
  using OtherSide::OtherSide;

  void begin(double time_s) override {
    calls.push_back('b');
    EXPECT_GT(time_s, now_s);
    now_s = time_s;
  }
  void ask(const Question& question) override {
    calls.push_back('q');
    EXPECT_EQ(question.time_s, now_s);
    cycles.at(static_cast<std::size_t>(question.robot)).push_back(question.cycle);
    OtherSide::ask(question);
  }
  std::optional<Answer> answer(int robot) override {
    calls.push_back('a');
    answered.push_back(robot);
    return OtherSide::answer(robot);
  }
  bool wants_every_step() const override { return every_step; }

  bool every_step = false;
  double now_s = 0;
  std::string calls;
  std::array<std::vector<std::int64_t>, 3> cycles;
  std::vector<int> answered;
};

TEST_F(ShortRun, AllThatAreDueAreAskedBeforeTheFirstAnswer) {
  profile_.timing = {};
  Listener decider(setup());
  simulate(setup(), {}, &decider);
  std::string calls;
  for (int cycle = 0; cycle < mission_.cycles; ++cycle)
    calls += "bqqqaaa";
  EXPECT_EQ(decider.calls, calls);
  EXPECT_EQ(std::vector<int>(decider.answered.begin(), decider.answered.begin() + 6),
            (std::vector<int>{0, 1, 2, 0, 1, 2}));
  for (const std::vector<std::int64_t>& cycles : decider.cycles) {
    ASSERT_EQ(cycles.size(), 50);
    for (std::size_t i = 0; i < cycles.size(); ++i)
      EXPECT_EQ(cycles[i], i + 1);
  }
  EXPECT_EQ(decider.now_s, 5.0);
}

TEST_F(ShortRun, AnInstantInWhichNoRobotIsDueDoesNotBegin) {
  Listener decider(setup());
  simulate(setup(), {}, &decider);
  EXPECT_GE(decider.answered.size(), 3 * 50);
  EXPECT_EQ(decider.calls.find("bb"), std::string::npos);
}

TEST_F(ShortRun, EveryStepIsAnInstantOnRequest) {
  Listener decider(setup());
  decider.every_step = true;
  const Measured result = simulate(setup(), {}, &decider);
  EXPECT_EQ(std::count(decider.calls.begin(), decider.calls.end(), 'b'), 500);
  EXPECT_EQ(decider.answered.size(), 3 * 500);
  EXPECT_EQ(result.score, simulate(setup()).score) << "rounding apart it is the same run";
}

/// Robot 0 drives from a step on, says so once, and is in state 2 then.
class OneCommand final : public Decider {
 public:
  explicit OneCommand(double at_s, Command command = {0.3, 0.3}) : at_s_(at_s), command_(command) {}

  void begin(double time_s) override { now_s_ = time_s; }
  void ask(const Question& /*question*/) override {}
  std::optional<Answer> answer(int robot) override {
    if (robot != 0 || given_ || now_s_ < at_s_) return std::nullopt;
    given_ = true;
    return Answer{.command = command_, .state = 2};
  }
  bool wants_every_step() const override { return true; }

 private:
  double at_s_;
  Command command_;
  double now_s_ = 0;
  bool given_ = false;
};

TEST_F(ShortRun, ACommandThatComesBetweenCyclesActsFromItsStepOn) {
  profile_ = built_in_profile("argos3").value();
  const auto way_at_end = [&](double at_s, int delay) {
    profile_.timing.delays = {{delay, 1}};
    OneCommand decider(at_s);
    Pose end;
    int state = 0;
    Pose bystander;
    simulate(
        setup(),
        [&](const Snapshot& now) {
          end = now.robots[0].pose;
          state = now.robots[0].state;
          bystander = now.robots[1].pose;
        },
        &decider);
    EXPECT_EQ(state, 2);
    EXPECT_EQ(bystander.x, instance_.starts[1].x);
    return std::hypot(end.x - instance_.starts[0].x, end.y - instance_.starts[0].y);
  };
  mission_.arena = regular_dodecagon(49);  // room to drive in
  // 0.3 m/s for 10 ms each; nothing is said again, and the treads go on.
  const double early = way_at_end(1.23, 0);
  EXPECT_GT(early, 1.0);
  EXPECT_NEAR(early - way_at_end(1.26, 0), 0.009, 1e-9);
  EXPECT_NEAR(early - way_at_end(1.23, 20), 0.06, 1e-9) << "the profile's delay comes on top";
}

TEST_F(ShortRun, WhatADeciderThrowsEndsTheRun) {
  class Broken final : public Decider {
    void ask(const Question& question) override {
      if (question.cycle == 7) throw std::runtime_error("the link to robot 0 is gone");
    }
    std::optional<Answer> answer(int /*robot*/) override { return Answer{}; }
  } decider;
  try {
    simulate(setup(), {}, &decider);
    ADD_FAILURE() << "a result without a decider";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "the link to robot 0 is gone");
  }
}

TEST_F(ShortRun, SpeedsThatAreNoNumbersAreRefusedWithTheRobotAndTheTime) {
  OneCommand decider(1.23, {0.3, std::numeric_limits<double>::quiet_NaN()});
  try {
    simulate(setup(), {}, &decider);
    ADD_FAILURE() << "a result with a tread that turns at NaN";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "the decision for robot 0 at 1.230000 s has no finite speeds for the treads");
  }
}

}  // namespace
}  // namespace swarmsmith
