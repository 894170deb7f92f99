#include "sim/engine/simulate.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "base/assert.h"
#include "base/hash.h"
#include "base/rng.h"
#include "sim/engine/internal/robot_senses.h"
#include "sim/engine/internal/world.h"
#include "sim/mission/score.h"

namespace swarmsmith {
namespace {

/// One control cycle in sub-steps, and how many cycles a command waits before it acts. A command
/// that waits none acts from the instant on at which its readings were taken: in the original's
/// terms, what tick t computes moves the robot during tick t+1.
constexpr int kPeriod = kSubStepsPerInstant;
constexpr std::int64_t kWait = 0;

/// A robot with what it needs to act on its own clock.
struct Agent {
  RobotSenses senses;
  ControlSoftware control;
  std::int64_t next_act = kPeriod;  ///< sub-step of its next control cycle
  std::int64_t cycle = 0;           ///< control cycles done
  Command command{};                ///< the last one computed
  Command acting{};                 ///< what the drive follows
  /// Commands that still wait, oldest first, each with the cycle from which it acts.
  struct Pending {
    std::int64_t from_cycle;
    Command command;
  };
  std::vector<Pending> pending{};
};

class Run {
 public:
  Run(const SimulationSetup& setup, const Recorder& recorder)
      : setup_(setup),
        recorder_(recorder),
        arena_(arena_of(setup.mission, setup.instance)),
        world_(arena_, setup.instance.starts, setup.profile.contacts),
        scorer_(setup.mission.rule, arena_),
        positions_(setup.instance.starts.size()) {
    const Rng run(static_cast<std::uint64_t>(setup.seed));
    agents_.reserve(positions_.size());
    for (int i = 0; i < world_.robots(); ++i) {
      agents_.push_back(
          {.senses = RobotSenses(world_, arena_, setup.profile, i, run),
           .control = ControlSoftware(setup.machine, setup.flavour,
                                      run.split("control", static_cast<std::uint64_t>(i)))});
    }
  }

  SimulationResult run() {
    record(0);
    std::int64_t now = 0;
    for (int instant = 1; instant <= setup_.mission.cycles; ++instant) {
      const std::int64_t end = std::int64_t{instant} * kSubStepsPerInstant;
      while (now < end) {
        std::int64_t next = end;
        for (const Agent& agent : agents_)
          next = std::min(next, agent.next_act);
        world_.advance(static_cast<int>(next - now));
        now = next;
        for (int i = 0; i < world_.robots(); ++i) {
          if (agents_[static_cast<std::size_t>(i)].next_act == now) act(i);
        }
      }
      observe();
      record(instant);
    }
    return {.score = scorer_.score(), .state_digest = digest()};
  }

 private:
  /// One control cycle of a robot: read, decide, and let the drive have what is due.
  void act(int robot) {
    Agent& agent = agents_[static_cast<std::size_t>(robot)];
    ++agent.cycle;
    agent.next_act += kPeriod;
    agent.senses.begin_cycle(agent.cycle);
    agent.command = agent.control.step(agent.senses);
    if (kWait == 0) {
      agent.acting = agent.command;
    } else {
      agent.pending.push_back({agent.cycle + kWait, agent.command});
      while (!agent.pending.empty() && agent.pending.front().from_cycle <= agent.cycle) {
        agent.acting = agent.pending.front().command;
        agent.pending.erase(agent.pending.begin());
      }
    }
    // Also an old command is renewed: its direction follows the heading, cycle by cycle.
    world_.command(robot, agent.acting);
  }

  void observe() {
    for (int i = 0; i < world_.robots(); ++i) {
      positions_[static_cast<std::size_t>(i)] = {world_.body(i).x, world_.body(i).y};
    }
    scorer_.observe(positions_);
  }

  void record(int instant) {
    if (!recorder_) return;
    records_.clear();
    for (int i = 0; i < world_.robots(); ++i) {
      const Agent& agent = agents_[static_cast<std::size_t>(i)];
      records_.push_back({.pose = instant == 0 ? setup_.instance.starts[static_cast<std::size_t>(i)]
                                               : pose_of(world_.body(i)),
                          .command = agent.command,
                          .state = agent.control.state()});
    }
    recorder_(instant, records_);
  }

  std::uint64_t digest() const {
    Digest digest;
    for (int i = 0; i < world_.robots(); ++i) {
      const Body& body = world_.body(i);
      for (const double value : {body.x, body.y, body.cos, body.sin, body.vx, body.vy, body.spin}) {
        digest.add(value);
      }
      digest.add(agents_[static_cast<std::size_t>(i)].control.state());
    }
    return digest.value64();
  }

  const SimulationSetup& setup_;
  const Recorder& recorder_;
  Arena arena_;
  World world_;
  Scorer scorer_;
  std::vector<Agent> agents_;
  std::vector<Point> positions_;
  std::vector<RobotRecord> records_;
};

}  // namespace

SimulationResult simulate(const SimulationSetup& setup, const Recorder& recorder) {
  SWARMSMITH_ASSERT(!setup.instance.starts.empty(), "an instance places at least one robot");
  return Run(setup, recorder).run();
}

}  // namespace swarmsmith
