#include <gtest/gtest.h>

#include <cstdio>
#include <string_view>

#include "tests/sim/engine/comparison.h"
#include "tests/support/long_runs.h"

// Bounds on what docs/fidelity.md shows in full (`./dev bench fidelity` writes it).

namespace swarmsmith {
namespace {

/// Streams of control draws for each seed; the original has one. Colour scores of most machines are
/// nearly equal, so that their ranks need more.
constexpr int kStreams = 3;
constexpr int kColorStreams = 10;

class Fidelity : public testing::TestWithParam<ReferenceMission> {};
INSTANTIATE_TEST_SUITE_P(All, Fidelity, testing::ValuesIn(kReferenceMissions),
                         [](const auto& instance) { return instance.param.theirs; });

/// 46 s. Whether anything has changed is seen by the fixed bits of trajectories and the scores seed
/// by seed, each time; how far a change leads from the original, by this.
TEST_P(Fidelity, TheTwentyMachinesScoreAsInTheOriginal) {
  if (times(0, 1) == 0) GTEST_SKIP() << "with ./dev test --long";
  const bool color = std::string_view(GetParam().theirs) == "color";
  const MissionComparison result =
      compare_reference_machines(GetParam(), ContactModel::Exact, color ? kColorStreams : kStreams);
  for (const MachineComparison& machine : result.machines) {
    if (machine.scores.holds_zero()) continue;
    std::printf("%s: %+.3f +- %.3f\n", machine.id.c_str(), machine.scores.difference,
                machine.scores.half_width);
  }
  EXPECT_LE(result.misses, 1);
  EXPECT_LT(result.mean_z2, 1.6);
  // The original against a resample of itself reaches no more than 0.82 on colour.
  EXPECT_GT(result.rank_correlation, color ? 0.88 : 0.95);
}

TEST_P(Fidelity, TheThesisDesignsScoreAsInTheOriginal) {
  const DesignsComparison result =
      compare_thesis_designs(GetParam(), ContactModel::Exact, kStreams);
  ASSERT_EQ(result.designs.size(), 10);
  EXPECT_TRUE(result.all.holds_zero()) << result.all.difference << " +- " << result.all.half_width;
}

TEST(SeedBySeed, TheExactSolverGivesTheOriginalsScores) {
  EXPECT_GE(seed_exact_runs(ContactModel::Exact), 575);
}

TEST(SeedBySeed, Box2dGivesTheOriginalsScores) {
  EXPECT_GE(seed_exact_runs(ContactModel::Box2d), 565);
}

}  // namespace
}  // namespace swarmsmith
