#include "irace_core/internal/sampling.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "irace_core/internal/distributions.h"
#include "irace_core/internal/instances.h"
#include "irace_core/internal/model.h"
#include "tests/irace_core/spaces.h"

namespace swarmsmith::irace {
namespace {

using namespace swarmsmith::testing;

TEST(TruncatedNormal, StaysInItsIntervalHoweverFarTheMeanIs) {
  Rng rng(1);
  for (const double mean : {-1e6, -40.0, -9.0, 0.5, 9.0, 40.0, 1e6}) {
    const TruncatedNormal distribution(mean, 1, 0, 1);
    for (int i = 0; i < 1000; ++i) {
      const double x = distribution.sample(rng);
      EXPECT_TRUE(x >= 0 && x <= 1) << mean;
    }
  }
}

TEST(TruncatedNormal, IsSymmetric) {
  Rng one(2);
  double left = 0;
  for (int i = 0; i < 20'000; ++i)
    left += TruncatedNormal(-7, 1, 0, 1).sample(one);
  Rng other(2);
  double right = 0;
  for (int i = 0; i < 20'000; ++i)
    right += 1 - TruncatedNormal(8, 1, 0, 1).sample(other);
  EXPECT_NEAR(left, right, 1e-6);
  EXPECT_NEAR(left / 20'000, 0.136, 0.003);  // the mean excess of a normal beyond 7
}

TEST(TruncatedNormal, FallsOffFromTheNearEndFarOut) {
  Rng rng(3);
  double sum = 0;
  for (int i = 0; i < 20'000; ++i)
    sum += TruncatedNormal(-50, 1, 0, 1).sample(rng);
  EXPECT_NEAR(sum / 20'000, 0.02, 0.001);  // an exponential of rate 50
}

TEST(TruncatedNormal, GivesTheMeanWithoutSpread) {
  Rng rng(4);
  EXPECT_EQ(TruncatedNormal(0.3, 0, 0, 1).sample(rng), 0.3);
}

TEST(Sampling, DropsDuplicatesAndMayGiveFewer) {
  const ParameterSpace space = space_of({make_categorical("c", {"a", "b", "c"})});
  Rng rng(5);
  const auto sampled = sample_initial(space, ForbiddenList(space), 20, rng).value();
  EXPECT_EQ(sampled.size(), 3U);
}

TEST(Sampling, ReplacesForbiddenOnesFromALargerBatch) {
  const ParameterSpace space = space_of({make_real("x", 0, 1), make_real("y", 0, 1)},
                                        {call(Operation::Less, name("x"), number(0.5))});
  Rng rng(6);
  const auto sampled = sample_initial(space, ForbiddenList(space), 40, rng).value();
  EXPECT_GT(sampled.size(), 30U);
  for (const Configuration& configuration : sampled)
    EXPECT_GE(configuration[0], 0.5);
}

TEST(Sampling, FailsWhenEverythingIsForbidden) {
  const ParameterSpace space =
      space_of({make_real("x", 0, 1)}, {call(Operation::LessEqual, name("x"), number(1))});
  Rng rng(7);
  EXPECT_FALSE(sample_initial(space, ForbiddenList(space), 5, rng).has_value());
}

TEST(ForbiddenList, ContainsWhatHasAllValuesOfARejectedOne) {
  const ParameterSpace space = space_of(
      {make_categorical("c", {"a", "b"}), active_when(make_real("r", 0, 1), equals("c", "b"))});
  ForbiddenList forbidden(space);
  Configuration rejected(2);
  rejected.set(0, 1);
  rejected.set(1, 0.5);
  forbidden.add_rejected(rejected);
  EXPECT_TRUE(forbidden.contains(rejected));
  Configuration other = rejected;
  other.set(1, 0.6);
  EXPECT_FALSE(forbidden.contains(other));
}

TEST(InstanceLog, RepeatsTheListInFreshOrders) {
  InstanceLog log(4, true, Rng(8));
  log.append(10);
  EXPECT_EQ(log.size(), 12);  // whole repetitions
  for (std::int64_t repetition = 0; repetition < 3; ++repetition) {
    std::set<std::int64_t> instances;
    for (std::int64_t i = 1; i <= 4; ++i)
      instances.insert(log[4 * repetition + i].instance);
    EXPECT_EQ(instances.size(), 4U);
  }
}

TEST(InstanceLog, KeepsTheOrderOfTheFileWhenAskedTo) {
  InstanceLog log(3, false, Rng(9));
  log.append(6);
  for (std::int64_t pair = 1; pair <= 6; ++pair)
    EXPECT_EQ(log[pair].instance, (pair - 1) % 3 + 1);
  EXPECT_NE(log[1].seed, log[4].seed);
}

TEST(SamplingModels, KeepTheLastMeanOfAnInactiveParameter) {
  const ParameterSpace space = space_of(
      {make_categorical("c", {"a", "b"}), active_when(make_real("r", 0, 100), equals("c", "b"))});
  Configuration with(2);
  with.set(0, 1);
  with.set(1, 80);
  Configuration without(2);
  without.set(0, 0);
  SamplingModels models(space);
  models.initialise(std::vector<EliteLine>{{1, 0, &with}});
  const UpdateStrength narrow{.fraction = 0, .shrink = 0.001, .most = 1};
  models.update(std::vector<EliteLine>{{1, 0, &with}}, narrow);
  models.update(std::vector<EliteLine>{{2, 1, &without}}, narrow);  // a child without r
  Rng rng(10);
  for (int i = 0; i < 100; ++i) {
    const Configuration sampled = models.sample(2, rng).value();
    if (sampled.is_active(1)) {
      EXPECT_NEAR(sampled[1], 80, 1);
    }
  }
  EXPECT_FALSE(models.owns(1));
}

TEST(SamplingModels, SampleUniformlyWhatNoEliteOfTheLineHad) {
  const ParameterSpace space = space_of(
      {make_categorical("c", {"a", "b"}), active_when(make_real("r", 0, 100), equals("c", "b"))});
  Configuration without(2);
  without.set(0, 0);
  SamplingModels models(space);
  models.initialise(std::vector<EliteLine>{{1, 0, &without}});
  Rng rng(11);
  std::vector<double> drawn;
  while (drawn.size() < 1000) {
    const Configuration sampled = models.sample(1, rng).value();
    if (sampled.is_active(1)) drawn.push_back(sampled[1]);
  }
  EXPECT_LT(*std::min_element(drawn.begin(), drawn.end()), 5);
  EXPECT_GT(*std::max_element(drawn.begin(), drawn.end()), 95);
}

TEST(SamplingModels, ScaleTheSpreadOfDependentDomains) {
  std::vector<Parameter> parameters{make_integer("n", 1, 9)};
  parameters.push_back({"m", "", Real{0.0, name("n")}, {}});
  const ParameterSpace space = space_of(std::move(parameters));
  Configuration elite(2);
  elite.set(0, 9);
  elite.set(1, 4);
  SamplingModels models(space);
  models.initialise(std::vector<EliteLine>{{1, 0, &elite}});
  Rng rng(12);
  for (int i = 0; i < 1000; ++i) {
    const Configuration sampled = models.sample(1, rng).value();
    EXPECT_TRUE(sampled[1] >= 0 && sampled[1] <= sampled[0]);
  }
}

}  // namespace
}  // namespace swarmsmith::irace
