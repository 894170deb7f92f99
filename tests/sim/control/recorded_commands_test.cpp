#include <gtest/gtest.h>

#include <cmath>
#include <variant>

#include "sim/control/machine_control.h"
#include "sim/control/machine_text.h"
#include "tests/sim/reference_run.h"

// The recorded runs of the original simulator, robot-tick by robot-tick: from the logged readings
// our modules must give the logged command and state (tests/golden/argos/README.md).

namespace swarmsmith {
namespace {

/// Poses are logged to 1e-5 m and rad, proximity to 1e-4 m. Where obstacles and neighbours nearly
/// cancel, a short vector is left, whose direction feels that most: 2e-4 m/s at worst.
constexpr double kTolerance_mps = 3e-4;

Machine machine_of(const RecordedRun& run) {
  return parse_machine(run.machine, watermelon_argos3()).value();
}

bool same_command(Command a, Command b) {
  return std::fabs(a.left_mps - b.left_mps) < kTolerance_mps &&
         std::fabs(a.right_mps - b.right_mps) < kTolerance_mps;
}

/// The behaviour that acted in a tick: the state before that tick's transition test.
const Behaviour& acting(const Machine& machine, const RecordedRun& run, std::size_t tick,
                        std::size_t robot) {
  return machine.states[static_cast<std::size_t>(run.ticks[tick - 1][robot].state)].behaviour;
}

/// How many robot-ticks a behaviour without memory acted in, and in how many it was right.
struct Agreement {
  int ticks = 0;
  int same = 0;
};

template <class Kind>
Agreement agreement_of(const RecordedRun& run) {
  const Machine machine = machine_of(run);
  Agreement agreement;
  Rng rng(1);
  EXPECT_GT(run.ticks.size(), 1U);
  for (std::size_t tick = 1; tick < run.ticks.size(); ++tick) {
    for (std::size_t robot = 0; robot < run.ticks[tick].size(); ++robot) {
      const Behaviour& behaviour = acting(machine, run, tick, robot);
      if (!std::holds_alternative<Kind>(behaviour)) continue;
      RecordedSenses senses(run.ticks[tick], robot);
      BehaviourMemory memory;
      const Command command = act(behaviour, senses, watermelon_argos3(), memory, rng);
      ++agreement.ticks;
      if (same_command(command, run.ticks[tick][robot].command)) ++agreement.same;
    }
  }
  return agreement;
}

TEST(RecordedCommands, RepulsionAgreesInEveryRobotTick) {
  const Agreement agreement = agreement_of<Repulsion>(recorded_run("grid", "hG5"));
  EXPECT_EQ(agreement.ticks, 3600);
  EXPECT_EQ(agreement.same, 3600);
}

TEST(RecordedCommands, AttractionAndStopAgreeInEveryRobotTick) {
  const RecordedRun run = recorded_run("aggregation", "hA6");
  const Agreement attraction = agreement_of<Attraction>(run);
  EXPECT_GT(attraction.ticks, 20);
  EXPECT_EQ(attraction.same, attraction.ticks);
  const Agreement stop = agreement_of<Stop>(run);
  EXPECT_GT(stop.ticks, 500);
  EXPECT_EQ(stop.same, stop.ticks);
}

TEST(RecordedCommands, NeighboursAreThoseOfTheRecord) {
  for (const auto& [mission, machine] :
       {std::pair{"aggregation", "hA6"}, std::pair{"grid", "hG5"}, std::pair{"color", "hC1"}}) {
    const RecordedRun run = recorded_run(mission, machine);
    for (std::size_t tick = 1; tick < run.ticks.size(); ++tick) {
      for (std::size_t robot = 0; robot < run.ticks[tick].size(); ++robot) {
        RecordedSenses senses(run.ticks[tick], robot);
        ASSERT_EQ(static_cast<int>(senses.neighbours().size()), run.ticks[tick][robot].neighbours)
            << mission << " tick " << tick << " robot " << robot;
      }
    }
  }
}

/// Exploration's turn lengths are random, its decisions are not: after a forward tick the robot
/// turns exactly when our code sees an obstacle, and to the same side.
void check_exploration(const RecordedRun& run, int& forward_ticks, int& turns) {
  const Machine machine = machine_of(run);
  Rng rng(1);
  for (std::size_t tick = 1; tick + 1 < run.ticks.size(); ++tick) {
    for (std::size_t robot = 0; robot < run.ticks[tick].size(); ++robot) {
      const RecordedTick& now = run.ticks[tick][robot];
      const RecordedTick& next = run.ticks[tick + 1][robot];
      const Behaviour& behaviour = acting(machine, run, tick, robot);
      const bool stays = now.state == run.ticks[tick - 1][robot].state;
      if (!std::holds_alternative<Exploration>(behaviour) || !stays) continue;
      if (now.command != Command{0.3, 0.3}) {
        // A turn goes on to the same side, or ends.
        ASSERT_TRUE(next.command == now.command || (next.command == Command{0.3, 0.3}));
        continue;
      }
      RecordedSenses senses(run.ticks[tick], robot);
      BehaviourMemory memory;
      ASSERT_TRUE(
          same_command(act(behaviour, senses, watermelon_argos3(), memory, rng), now.command));
      const Command turn = memory.turn_left ? Command{-0.3, 0.3} : Command{0.3, -0.3};
      const Command expected = memory.turn_cycles_left > 0 ? turn : Command{0.3, 0.3};
      ASSERT_TRUE(same_command(expected, next.command)) << "tick " << tick << " robot " << robot;
      ++forward_ticks;
      if (memory.turn_cycles_left > 0) ++turns;
    }
  }
}

TEST(RecordedCommands, ExplorationTurnsWhenAndWhereTheRecordedRobotsDid) {
  int forward_ticks = 0;
  int turns = 0;
  check_exploration(recorded_run("aggregation", "hA6"), forward_ticks, turns);
  check_exploration(recorded_run("color", "hC1"), forward_ticks, turns);
  EXPECT_GT(forward_ticks, 100);
  EXPECT_GT(turns, 10);
}

TEST(RecordedCommands, AMachineWithSureTransitionsChangesStateWhenTheRecordedOneDid) {
  const RecordedRun run = recorded_run("color", "hC1");
  const Machine machine = machine_of(run);
  std::vector<MachineControl> robots(3, MachineControl(machine, watermelon_argos3(), Rng(1)));
  int changes = 0;
  for (std::size_t tick = 1; tick < run.ticks.size(); ++tick) {
    for (std::size_t robot = 0; robot < robots.size(); ++robot) {
      RecordedSenses senses(run.ticks[tick], robot);
      robots[robot].step(senses);
      const RecordedTick& now = run.ticks[tick][robot];
      ASSERT_EQ(robots[robot].state(), now.state) << "tick " << tick << " robot " << robot;
      if (now.state != run.ticks[tick - 1][robot].state) ++changes;
    }
  }
  EXPECT_GE(changes, 3);
}

}  // namespace
}  // namespace swarmsmith
