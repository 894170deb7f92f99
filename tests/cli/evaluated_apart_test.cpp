#include "cli/commands/evaluated_apart.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <limits>
#include <stdexcept>

namespace swarmsmith::cli {
namespace {

using End = Again::End;

/// Runs told apart by their seeds.
std::vector<StoredRun> runs(std::int64_t count) {
  std::vector<StoredRun> all;
  for (std::int64_t seed = 1; seed <= count; ++seed)
    all.push_back({.seed = seed});
  return all;
}

TEST(EvaluatedApart, GivesTheResultsInTheirOrder) {
  const auto again = evaluate_apart(runs(300), [](const StoredRun& run) {
    return Measured{static_cast<double>(run.seed) / 3, ~static_cast<std::uint64_t>(run.seed)};
  });
  ASSERT_TRUE(again);
  ASSERT_EQ(again->size(), 300U);
  for (std::size_t i = 0; i < 300; ++i) {
    EXPECT_EQ((*again)[i].end, End::Scored);
    EXPECT_EQ((*again)[i].result.score, static_cast<double>(i + 1) / 3);
    EXPECT_EQ((*again)[i].result.state_digest, ~static_cast<std::uint64_t>(i + 1));
  }
  EXPECT_TRUE(evaluate_apart({}, {})->empty());
}

/// What kills a process is the outcome of one run, and the next ones have theirs.
TEST(EvaluatedApart, SurvivesEachKindOfDeath) {
  const auto again = evaluate_apart(runs(9), [](const StoredRun& run) -> Measured {
    switch (run.seed) {
      case 2:
        std::abort();
      case 3:
        raise(SIGKILL);
        break;
      case 5:
        throw std::runtime_error("a pose is not finite");
      case 6:
        return {.score = std::numeric_limits<double>::quiet_NaN()};
      case 7:
        return {.score = std::numeric_limits<double>::infinity()};
      case 9:
        _exit(0);
      default:
        break;
    }
    return {.score = 1, .state_digest = 2};
  });
  ASSERT_TRUE(again);
  std::vector<End> ends;
  for (const Again& one : *again)
    ends.push_back(one.end);
  EXPECT_EQ(ends, (std::vector<End>{End::Scored, End::Killed, End::Killed, End::Scored, End::Failed,
                                    End::Failed, End::Failed, End::Scored, End::Killed}));
}

}  // namespace
}  // namespace swarmsmith::cli
