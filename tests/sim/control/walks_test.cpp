#include "sim/control/behaviours/walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "base/math.h"
#include "base/rng.h"
#include "sim/control/behaviours.h"
#include "sim/control/flavour.h"
#include "tests/sim/control/fake_senses.h"

namespace swarmsmith {
namespace {

TEST(Walks, AnglesFollowTheWrappedCauchyLaw) {
  EXPECT_NEAR(wrapped_cauchy_angle(0.25, 0), -kPi / 2, 1e-12) << "uniform";
  EXPECT_NEAR(wrapped_cauchy_angle(0.875, 0), 0.75 * kPi, 1e-12);
  EXPECT_EQ(wrapped_cauchy_angle(0.5, 0.3), 0);
  EXPECT_EQ(wrapped_cauchy_angle(0.9, 1), 0) << "straight on";
  // The mean of cos(angle) is rho, by definition of the concentration.
  for (const double rho : {0.0, 0.3, 0.8, 0.95}) {
    double sum = 0;
    constexpr int kDraws = 20'000;
    for (int i = 0; i < kDraws; ++i)
      sum += cos(wrapped_cauchy_angle((i + 0.5) / kDraws, rho));
    EXPECT_NEAR(sum / kDraws, rho, 1e-3) << rho;
  }
}

TEST(Walks, StepsFollowTheirLaws) {
  EXPECT_EQ(exponential_step(0, 20), 1);
  EXPECT_EQ(exponential_step(0.5, 20), 14) << "20 log 2 = 13.86";
  EXPECT_EQ(exponential_step(1 - 1e-16, 100), kLongestStep);
  EXPECT_EQ(power_law_step(0, 2), 1);
  EXPECT_EQ(power_law_step(0.75, 2), 4) << "P(l >= x) = 1 / x";
  EXPECT_EQ(power_law_step(0.75, 3), 2) << "P(l >= x) = 1 / x^2";
  EXPECT_EQ(power_law_step(0.99, 1.1), kLongestStep);
}

struct Walked {
  std::vector<int> steps;     ///< cycles straight on
  std::vector<double> turns;  ///< angles between them, to the left positive
};

Walked walked(const Behaviour& behaviour, int cycles) {
  FakeSenses senses;
  BehaviourMemory memory;
  Rng rng(1);
  Walked walk;
  bool turning = true;
  for (int i = 0; i < cycles; ++i) {
    const Command command = act(behaviour, senses, watermelon(), memory, rng);
    if (command.left_mps == command.right_mps) {
      EXPECT_EQ(command.left_mps, 0.3);
      if (turning) walk.steps.push_back(0);
      ++walk.steps.back();
      turning = false;
    } else {
      EXPECT_EQ(command.left_mps, -command.right_mps);
      if (!turning) walk.turns.push_back(0);
      walk.turns.back() += (command.right_mps - command.left_mps) / 0.147 * 0.1;
      turning = true;
    }
  }
  return walk;
}

TEST(Walks, ARandomWalkGoesInStepsWithTurnsBetween) {
  const Walked walk = walked(RandomWalk{.rho = 0, .step = 20}, 100'000);
  ASSERT_GT(walk.turns.size(), 1000U);
  double sum = 0;
  for (const int step : walk.steps)
    sum += step;
  EXPECT_NEAR(sum / static_cast<double>(walk.steps.size()), 20.5, 1.5)
      << "rounded up, half a cycle more";
  for (const double angle : walk.turns)
    EXPECT_LE(std::fabs(angle), kPi + 1e-9);
  const auto left = std::ranges::count_if(walk.turns, [](double angle) { return angle > 0; });
  EXPECT_NEAR(static_cast<double>(left) / static_cast<double>(walk.turns.size()), 0.5, 0.05);
  // Uniform in [-pi, pi]: turned to the radian, not by whole cycles of 0.41 rad.
  const auto sharp =
      std::ranges::count_if(walk.turns, [](double angle) { return std::fabs(angle) < 0.1; });
  EXPECT_NEAR(static_cast<double>(sharp) / static_cast<double>(walk.turns.size()), 0.1 / kPi, 0.02);
}

TEST(Walks, ALevyWalkHasManyShortStepsAndSomeThatAreVeryLong) {
  const Walked walk = walked(LevyWalk{.mu = 2, .rho = 0}, 200'000);
  const auto share = [&](int least) {
    const auto count = std::ranges::count_if(walk.steps, [&](int step) { return step >= least; });
    return static_cast<double>(count) / static_cast<double>(walk.steps.size());
  };
  ASSERT_GT(walk.steps.size(), 5000U);
  EXPECT_NEAR(share(4), 0.25, 0.02);
  EXPECT_NEAR(share(100), 0.01, 0.004);
  EXPECT_LE(*std::ranges::max_element(walk.steps), kLongestStep);
}

TEST(Walks, TheyTurnAwayFromWhatStandsInFront) {
  for (const Behaviour& behaviour :
       {Behaviour(RandomWalk{.rho = 1, .step = 100}), Behaviour(LevyWalk{.mu = 1.1, .rho = 1})}) {
    for (const int side : {0, 2}) {  // ahead on the left, ahead on the right
      FakeSenses senses;
      senses.distances[static_cast<std::size_t>(side)] = 0.1;
      BehaviourMemory memory;
      Rng rng(2);
      EXPECT_EQ(act(behaviour, senses, watermelon(), memory, rng), (Command{0.3, 0.3}));
      const Command turn = act(behaviour, senses, watermelon(), memory, rng);
      EXPECT_EQ(turn.left_mps > turn.right_mps, side == 0) << "away from it";
      EXPECT_EQ(turn.left_mps, -turn.right_mps);
    }
  }
}

}  // namespace
}  // namespace swarmsmith
