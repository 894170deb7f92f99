#include "sim/engine/internal/robot_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "sim/engine/simulate.h"
#include "tests/sim/engine/reference_runs.h"
#include "tests/sim/engine/statistics.h"

namespace swarmsmith {
namespace {

/// The numbers of pseudo-reality (thesis facts, section 13).
ControlTiming drifting() {
  return {.delays = {{10, 0.25}, {20, 0.5}, {30, 0.25}},
          .least_period = 0.75,
          .most_period = 1.0,
          .jitter = 0.05};
}

/// Control cycles within 120 s.
int cycles_of(RobotClock clock) {
  int cycles = 0;
  for (; clock.next() <= 12'000; clock.next_cycle())
    ++cycles;
  return cycles;
}

TEST(RobotClock, KeepsTheNominalPeriodToTheSubStep) {
  const ControlTiming timing;
  RobotClock clock(timing, Rng(1), 0);
  for (std::int64_t cycle = 1; cycle <= 1200; ++cycle, clock.next_cycle()) {
    ASSERT_EQ(clock.next(), 10 * cycle);
    ASSERT_EQ(clock.arrival_of_command(clock.next()), clock.next());
  }
}

TEST(RobotClock, AStrangePeriodIsRightOnTheWhole) {
  const ControlTiming timing{.least_period = 0.777, .most_period = 0.777};
  EXPECT_EQ(cycles_of(RobotClock(timing, Rng(1), 0)), 1544);  // 12000 / 7.77, rounded down
}

TEST(RobotClock, PeriodsAreUniformOverRobotsAndRuns) {
  const ControlTiming timing = drifting();
  std::vector<double> factors;
  for (std::uint64_t run = 1; run <= 200; ++run) {
    for (int robot = 0; robot < 5; ++robot) {
      factors.push_back(1200.0 / cycles_of(RobotClock(timing, Rng(run), robot)));
    }
  }
  std::sort(factors.begin(), factors.end());
  EXPECT_GT(factors.front(), 0.745);
  EXPECT_LT(factors.back(), 1.005);
  // Kolmogorov and Smirnov against U(0.75, 1), 1 %: 1.63 / sqrt(n).
  double distance = 0;
  const auto n = static_cast<double>(factors.size());
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const double expected = (factors[i] - 0.75) / 0.25;
    distance = std::max(distance, std::fabs(expected - (static_cast<double>(i) + 0.5) / n));
  }
  EXPECT_LT(distance, 1.63 / std::sqrt(n));
}

TEST(RobotClock, JitterStaysWithinItsBounds) {
  ControlTiming timing = drifting();
  timing.least_period = timing.most_period = 1;
  RobotClock clock(timing, Rng(3), 0);
  int irregular = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::int64_t before = clock.next();
    clock.next_cycle();
    const std::int64_t period = clock.next() - before;
    EXPECT_TRUE(period >= 9 && period <= 11) << period;
    irregular += period == 10 ? 0 : 1;
  }
  EXPECT_GT(irregular, 100);
}

TEST(RobotClock, JitterIsUniformFromCycleToCycle) {
  // Periods of a second, so that whole sub-steps blur the law little: U(50, 150) sub-steps.
  const ControlTiming timing{.least_period = 10, .most_period = 10, .jitter = 0.5};
  RobotClock clock(timing, Rng(7), 0);
  std::vector<double> periods;
  for (int i = 0; i < 2000; ++i) {
    const std::int64_t before = clock.next();
    clock.next_cycle();
    periods.push_back(static_cast<double>(clock.next() - before));
  }
  // Rounding shifts what is counted below a value by half a sub-step, a 200th, at most.
  const double rounding = std::sqrt(static_cast<double>(periods.size())) / 200;
  EXPECT_LT(ks_statistic(periods, [](double x) { return std::clamp((x - 50) / 100, 0.0, 1.0); }),
            kKsLimit + rounding);
}

TEST(RobotClock, DelaysHaveTheirProbabilities) {
  const ControlTiming timing = drifting();
  // Commands so far apart that none waits for the one ahead.
  RobotClock clock(timing, Rng(4), 1);
  std::array<double, 4> counts{};
  constexpr int kCommands = 4000;
  for (int i = 0; i < kCommands; ++i) {
    const std::int64_t now = i * 1000;
    counts.at(static_cast<std::size_t>((clock.arrival_of_command(now) - now) / 10)) += 1;
  }
  EXPECT_EQ(counts[0], 0);
  double chi_square = 0;
  for (const ControlTiming::Delay& delay : timing.delays) {
    const double expected = kCommands * delay.probability;
    const double off = counts[static_cast<std::size_t>(delay.sub_steps / 10)] - expected;
    chi_square += off * off / expected;
  }
  EXPECT_LT(chi_square, 9.21);  // 1 %, 2 degrees of freedom
}

TEST(RobotClock, CommandsKeepTheirOrder) {
  const ControlTiming timing = drifting();
  RobotClock clock(timing, Rng(5), 2);
  std::int64_t last = 0;
  int waited = 0;
  for (int i = 0; i < 1000; ++i, clock.next_cycle()) {
    const std::int64_t arrival = clock.arrival_of_command(clock.next());
    EXPECT_GE(arrival, last);
    waited += arrival == last ? 1 : 0;
    last = arrival;
  }
  EXPECT_GT(waited, 50) << "a late command delays those after it";
}

TEST(RobotClock, CyclesShorterThanASubStepShareOne) {
  const ControlTiming timing{.least_period = 0.0125, .most_period = 0.0125};  // 800 a second
  RobotClock clock(timing, Rng(1), 0);
  EXPECT_EQ(clock.next(), 1) << "nothing is sensed before the start";
  EXPECT_EQ(cycles_of(clock), 800 * 120 + 3);  // the last sub-step has those up to its middle
  std::array<int, 4> cycles{};
  for (; clock.next() < 4; clock.next_cycle())
    ++cycles.at(static_cast<std::size_t>(clock.next()));
  EXPECT_EQ(cycles, (std::array<int, 4>{0, 11, 8, 8}));
}

TEST(RobotClock, ADriverSendsCommandsAtItsBeats) {
  const ControlTiming timing{.driver_sub_steps = 20};
  std::array<int, 21> firsts{};
  for (std::uint64_t run = 1; run <= 400; ++run) {
    RobotClock clock(timing, Rng(run), 1);
    const std::int64_t first = clock.arrival_of_command(0);
    ++firsts.at(static_cast<std::size_t>(first));
    EXPECT_EQ(clock.arrival_of_command(first - 1), first);
    EXPECT_EQ(clock.arrival_of_command(first), first + 20) << "what is sent was there before";
    EXPECT_EQ(clock.arrival_of_command(first + 19), first + 20);
  }
  EXPECT_EQ(firsts[0], 0);
  for (std::size_t phase = 1; phase <= 20; ++phase)
    EXPECT_GT(firsts.at(phase), 5) << phase;
  const ControlTiming slow{.delays = {{7, 1}}, .driver_sub_steps = 20};
  EXPECT_EQ(RobotClock(slow, Rng(1), 1).arrival_of_command(0),
            RobotClock(timing, Rng(1), 1).arrival_of_command(0) + 7);
}

TEST(RobotClock, ALateCommandMovesTheRobotLater) {
  ReferenceRuns runs("aggregation");
  runs.instances[0].starts = {{0, 0, 0}};
  const auto first_motion = [&](int sub_steps) {
    runs.profile.timing.delays = {{sub_steps, 1}};
    int cycle = -1;
    runs.run(machine_of("--nstates 1 --s0 0 --rwm0 1"), 1, 0, [&](const Snapshot& now) {
      if (cycle < 0 && now.robots[0].pose.x > 0) cycle = now.cycle;
    });
    return cycle;
  };
  // Computed at 0.1 s, acts at once: what moves is seen at 0.2 s.
  EXPECT_EQ(first_motion(0), 2);
  EXPECT_EQ(first_motion(20), 4);
}

/// The speeds that a run commands.
std::set<double> speeds_of(const ReferenceRuns& runs, const Machine& machine) {
  std::set<double> speeds;
  runs.run(machine, 1, 0, [&](const Snapshot& now) {
    for (const RobotRecord& robot : now.robots) {
      if (now.cycle > 0) speeds.insert({robot.command.left_mps, robot.command.right_mps});
    }
  });
  return speeds;
}

TEST(Treads, TakeCommandsAsTheWireAndTheDriverMakeThem) {
  ReferenceRuns runs("aggregation");
  const Machine explores = machine_of("--nstates 1 --s0 0 --rwm0 5");
  EXPECT_EQ(speeds_of(runs, explores), (std::set<double>{-0.3, 0.3}));
  runs.profile.float32_wire = true;
  const auto rounded = static_cast<double>(0.3F);
  EXPECT_EQ(speeds_of(runs, explores), (std::set<double>{-rounded, rounded}));
  runs.profile.treads.step_mps = 0.25;
  EXPECT_EQ(speeds_of(runs, explores), (std::set<double>{-0.25, 0.25}));
  runs.profile.treads.step_mps = 1.4;
  EXPECT_EQ(speeds_of(runs, explores), std::set<double>{0});
}

TEST(Treads, StepsNeverLeadBeyondTheWheelsRange) {
  ReferenceRuns runs("aggregation");
  Flavour fast = watermelon_argos3();
  fast.speed_mps = 1.55;
  runs.flavour = &fast;
  runs.profile.treads.step_mps = 0.2;
  EXPECT_EQ(speeds_of(runs, machine_of("--nstates 1 --s0 0 --rwm0 5")),
            (std::set<double>{-1.55, 1.55}));
}

TEST(Treads, GoAsFastAsTheRobotsFileSays) {
  ReferenceRuns runs("aggregation");
  Flavour fast = watermelon();
  fast.speed_mps = 3;
  runs.flavour = &fast;
  runs.mission.robot.drive.max_speed_mps = 5;
  const Machine explores = machine_of("--nstates 1 --s0 0 --rwm0 5");
  EXPECT_EQ(speeds_of(runs, explores), (std::set<double>{-3, 3}));
  runs.mission.robot.drive.max_speed_mps = 2;
  EXPECT_EQ(speeds_of(runs, explores), (std::set<double>{-2, 2}));
}

/// Where one robot ends up that follows steady commands from the middle of the arena for 2 s.
Pose driven(const Treads& treads, double left_mps, double right_mps, int robot_seed = 1) {
  class Steady final : public Decider {
   public:
    Steady(double left_mps, double right_mps) {
      answer_.command.left_mps = left_mps;
      answer_.command.right_mps = right_mps;
    }
    void ask(const Question&) override {}
    std::optional<Answer> answer(int) override { return answer_; }

   private:
    Answer answer_;
  };
  ReferenceRuns runs("aggregation");
  Mission mission = runs.mission;
  mission.cycles = 20;
  Instance instance = runs.instances[0];
  instance.starts = {{0, 0, 0}};
  runs.profile.treads = treads;
  const Controller machine = machine_of("--nstates 1 --s0 1");
  Steady decider(left_mps, right_mps);
  Pose last;
  simulate({machine, *runs.flavour, runs.profile, mission, instance, robot_seed},
           Recorder([&](const Snapshot& now) { last = now.robots[0].pose; }), &decider);
  return last;
}

TEST(Treads, ThatSlipGoAndTurnSoMuchOfWhatTheyAreTold) {
  // As a robot without slip that gets smaller commands: to the bit where the products are exact.
  EXPECT_EQ(driven({.way = 0.5}, 0.25, 0.25), driven({}, 0.125, 0.125));
  EXPECT_EQ(driven({.turn = 0.5}, -0.0625, 0.0625), driven({}, -0.03125, 0.03125));
  EXPECT_EQ(driven({.way = 0.5}, -0.0625, 0.0625), driven({}, -0.0625, 0.0625));
  EXPECT_EQ(driven({.turn = 0.5}, 0.25, 0.25), driven({}, 0.25, 0.25));
  const Pose curve = driven({.way = 0.75, .turn = 0.5}, 0.125, 0.25);
  const Pose told = driven({}, 0.75 * 0.1875 - 0.5 * 0.0625, 0.75 * 0.1875 + 0.5 * 0.0625);
  EXPECT_NEAR(curve.x, told.x, 1e-12);
  EXPECT_NEAR(curve.theta, told.theta, 1e-12);
}

TEST(Treads, SlipIsDrawnForEachRobotAndRun) {
  std::vector<double> ways;
  for (int seed = 1; seed <= 200; ++seed)
    ways.push_back(driven({.way = 0.9, .way_sd = 0.05}, 0.3, 0.3, seed).x);
  // It comes to its speed at 0.75 m/s^2 from 0.1 s on.
  const auto way_of = [](double mps) { return mps * (1.9 - mps / 0.75 / 2); };
  double sum = 0;
  double squares = 0;
  for (const double way : ways) {
    sum += way;
    squares += way * way;
  }
  const double mean = sum / 200;
  const double unit = way_of(0.3 * 1.0) - way_of(0.3 * 0.9);
  EXPECT_NEAR(mean, way_of(0.27), 3 * 0.5 * unit / std::sqrt(200.0) + 0.002);
  EXPECT_NEAR(std::sqrt(squares / 200 - mean * mean), 0.5 * unit, 0.1 * unit);
}

TEST(Treads, WithoutSlipNoBitChanges) {
  ReferenceRuns runs("aggregation");
  const Machine explores = machine_of("--nstates 1 --s0 0 --rwm0 5");
  const auto before = runs.run(explores, 3, 0);
  runs.profile.treads = {.step_mps = 0, .way = 1, .way_sd = 0, .turn = 1, .turn_sd = 0};
  EXPECT_EQ(runs.run(explores, 3, 0).state_digest, before.state_digest);
  runs.profile.treads.turn = 0.9;
  EXPECT_NE(runs.run(explores, 3, 0).state_digest, before.state_digest);
}

TEST(TrackedPoint, AScoreCanSeeTheTagInsteadOfTheCentre) {
  ReferenceRuns runs("aggregation");
  runs.mission.robots = 1;
  // The centre stands on the black disc, the tag behind it does not.
  runs.instances[0].starts = {{-0.45, 0, 0}};
  const Machine stop = machine_of("--nstates 1 --s0 1");
  runs.profile.tracking.tag = {-0.072, 0};
  EXPECT_EQ(runs.run(stop, 1).score, 1);
  runs.profile.tracking.scores_tag = true;
  EXPECT_EQ(runs.run(stop, 1).score, 0);
}

}  // namespace
}  // namespace swarmsmith
