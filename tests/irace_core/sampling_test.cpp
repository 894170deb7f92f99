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
  InitialSampler sampler(space, Rng(5));
  EXPECT_EQ(sampler.sample(20, ForbiddenList(space), {}).value().size(), 3U);
  EXPECT_EQ(sampler.sample(20, ForbiddenList(space), {}).value().size(), 0U);
}

TEST(Sampling, FollowsTheSequenceFurtherForForbiddenOnes) {
  const ParameterSpace space = space_of({make_real("x", 0, 1), make_real("y", 0, 1)},
                                        {call(Operation::Less, name("x"), number(0.5))});
  InitialSampler sampler(space, Rng(6));
  // Half are lost: 40 + 20 * 1.5 = 70 points give 35.
  const auto sampled = sampler.sample(40, ForbiddenList(space), {}).value();
  EXPECT_EQ(sampler.position(), 70U);
  EXPECT_EQ(sampled.size(), 35U);
  for (const Configuration& configuration : sampled)
    EXPECT_GE(configuration[0], 0.5);
}

TEST(Sampling, GivesNothingWhenEverythingIsForbidden) {
  const ParameterSpace space =
      space_of({make_real("x", 0, 1)}, {call(Operation::LessEqual, name("x"), number(1))});
  InitialSampler sampler(space, Rng(7));
  EXPECT_TRUE(sampler.sample(5, ForbiddenList(space), {}).value().empty());
}

TEST(Sampling, SpreadsTheFirstConfigurationsEvenly) {
  // Of a Sobol sequence, 64 points lie in the 64 parts of each domain, one in each.
  const ParameterSpace space = space_of(
      {make_integer("a", 0, 63), make_categorical("fixed", {"x"}), make_integer("b", 0, 63)}, {});
  InitialSampler sampler(space, Rng(8));
  const auto sampled = sampler.sample(64, ForbiddenList(space), {}).value();
  for (const std::size_t parameter : {0U, 2U}) {
    std::set<double> values;
    for (const Configuration& configuration : sampled)
      values.insert(configuration[parameter]);
    EXPECT_EQ(values.size(), 64U);
  }
}

TEST(Sampling, IsUniformAboveTheDimensionsOfTheTable) {
  std::vector<Parameter> parameters;
  for (std::size_t i = 0; i <= SobolSequence::most_dimensions(); ++i)
    parameters.push_back(make_real("p" + std::to_string(i), 0, 1));
  const ParameterSpace space = space_of(std::move(parameters));
  InitialSampler sampler(space, Rng(9));
  EXPECT_FALSE(sampler.uses_sobol());
  const auto sampled = sampler.sample(3, ForbiddenList(space), {}).value();
  ASSERT_EQ(sampled.size(), 3U);
  double sum = 0;
  for (std::size_t i = 0; i < space.size(); ++i)
    sum += sampled[2][i];
  EXPECT_NEAR(sum / static_cast<double>(space.size()), 0.5, 0.05);
}

TEST(Sobol, HasEveryDimensionOfItsTable) {
  // In each dimension the first 2^k points fall into the 2^k parts of equal width: the direction
  // numbers are those of a sequence.
  const SobolSequence sequence(SobolSequence::most_dimensions(), 1);
  std::vector<std::set<int>> parts(sequence.dimensions());
  std::vector<double> point(sequence.dimensions());
  for (std::uint32_t i = 0; i < 64; ++i) {
    sequence.point(i, point);
    for (std::size_t d = 0; d < point.size(); ++d)
      parts[d].insert(static_cast<int>(point[d] * 64));
  }
  ASSERT_FALSE(parts.empty());
  for (std::size_t d = 0; d < parts.size(); ++d)
    EXPECT_EQ(parts[d].size(), 64U) << d;
}

TEST(Repair, ComesBeforeTheForbiddenTest) {
  const ParameterSpace space = space_of({make_real("x", 0, 1), make_real("y", 0, 1)},
                                        {call(Operation::Less, name("x"), number(0.5))});
  InitialSampler sampler(space, Rng(6));
  const Repair mirror = [](const Configuration& sampled) -> Expected<Configuration> {
    Configuration changed = sampled;
    if (changed[0] < 0.5) changed.set(0, 1 - changed[0]);
    return changed;
  };
  EXPECT_EQ(sampler.sample(40, ForbiddenList(space), mirror).value().size(), 40U);
  EXPECT_EQ(sampler.position(), 40U);
}

TEST(Repair, MustStayInTheSpace) {
  const ParameterSpace space = space_of({make_real("x", 0, 1), make_categorical("c", {"a", "b"})});
  const auto refused = [&](const Repair& repair) {
    return InitialSampler(space, Rng(6)).sample(4, ForbiddenList(space), repair).error();
  };
  const Error outside = refused([](Configuration changed) -> Expected<Configuration> {
    changed.set(0, 1.5);
    return changed;
  });
  EXPECT_EQ(outside.where, "repairConfiguration");
  EXPECT_THAT(outside.message, ::testing::HasSubstr("the repair made (x = 1.5, c = "));
  EXPECT_THAT(outside.message, ::testing::HasSubstr("x: "));
  const Error short_one =
      refused([](const Configuration&) -> Expected<Configuration> { return Configuration(1); });
  EXPECT_THAT(short_one.message, ::testing::HasSubstr("not have one value for each parameter"));
  const Error longer =
      refused([](const Configuration&) -> Expected<Configuration> { return Configuration(3); });
  EXPECT_EQ(longer.message.substr(0, 19), "the repair made () ");
  const Error failed = refused([](const Configuration&) -> Expected<Configuration> {
    return bad_input("no such luck", "the program");
  });
  EXPECT_EQ(failed.where, "the program");
}

/// Values that the space does not have are shown as "?", inactive ones are left out.
TEST(Repair, IsShownBesideWhatItGot) {
  const ParameterSpace space = space_of({active_when(make_real("y", 0, 1), equals("c", "b")),
                                         make_categorical("c", {"a", "b"}), make_real("x", 0, 1)});
  Configuration sampled(3);
  sampled.set(1, 0);
  sampled.set(2, 0.25);
  const auto complaint = [&](std::size_t parameter, double value) {
    const auto refused = repaired(
        space,
        [&](Configuration changed) -> Expected<Configuration> {
          changed.set(parameter, value);
          return changed;
        },
        sampled);
    return refused ? "" : to_string(refused.error());
  };
  const std::string got = " of (c = a, x = 0.25), which is not a configuration of this space: ";
  EXPECT_EQ(complaint(2, 1.5), "repairConfiguration: the repair made (c = a, x = 1.5)" + got +
                                   "x: 1.5 is not in its domain (0, 1)");
  EXPECT_EQ(complaint(0, 0.5), "repairConfiguration: the repair made (y = 0.5, c = a, x = 0.25)" +
                                   got + "y: is inactive but has a value");
  EXPECT_EQ(complaint(1, 2), "repairConfiguration: the repair made (c = ?, x = 0.25)" + got +
                                 "c: 2 is not in its domain (0, 1)");
  EXPECT_EQ(complaint(1, -1), "repairConfiguration: the repair made (c = ?, x = 0.25)" + got +
                                  "c: -1 is not in its domain (0, 1)");
  EXPECT_EQ(complaint(2, 1), "");
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

Scenario with_instances(std::int64_t count, std::int64_t block_size = 1) {
  Scenario scenario;
  scenario.n_instances = count;
  scenario.block_size = block_size;
  return scenario;
}

TEST(InstanceLog, RepeatsTheListInFreshOrders) {
  InstanceLog log(with_instances(4), Rng(8));
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
  Scenario scenario = with_instances(3);
  scenario.sample_instances = false;
  InstanceLog log(scenario, Rng(9));
  log.append(6);
  for (std::int64_t pair = 1; pair <= 6; ++pair)
    EXPECT_EQ(log[pair].instance, (pair - 1) % 3 + 1);
  EXPECT_NE(log[1].seed, log[4].seed);
}

TEST(InstanceLog, ShufflesWholeBlocks) {
  InstanceLog log(with_instances(6, 2), Rng(10));
  log.append(120);
  ASSERT_EQ(log.size(), 120);
  std::set<std::vector<std::int64_t>> orders;
  for (std::int64_t repetition = 0; repetition < 20; ++repetition) {
    std::vector<std::int64_t> order;
    for (std::int64_t i = 1; i <= 6; i += 2) {
      const std::int64_t first = log[6 * repetition + i].instance;
      EXPECT_EQ(first % 2, 1);
      EXPECT_EQ(log[6 * repetition + i + 1].instance, first + 1);
      order.push_back(first);
    }
    orders.insert(order);
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, (std::vector<std::int64_t>{1, 3, 5}));
  }
  EXPECT_EQ(orders.size(), 6U);  // all of them, in twenty repetitions
}

TEST(InstanceLog, HasEachInstanceOnceForADeterministicTarget) {
  Scenario scenario = with_instances(5);
  scenario.deterministic = true;
  InstanceLog log(scenario, Rng(11));
  log.extend_to(50);
  log.append(50);
  EXPECT_EQ(log.size(), 5);
}

TEST(InstanceLog, IsTheSameHoweverItGrows) {
  InstanceLog at_once(with_instances(4), Rng(12));
  InstanceLog in_steps(with_instances(4), Rng(12));
  at_once.extend_to(20);
  for (std::int64_t size = 1; size <= 20; ++size)
    in_steps.extend_to(size);
  ASSERT_EQ(at_once.size(), in_steps.size());
  for (std::int64_t pair = 1; pair <= 20; ++pair)
    EXPECT_EQ(at_once[pair].seed, in_steps[pair].seed);
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

/// After a restart the spread is that of the first update again, and a tenth of the largest
/// probability is added to each.
TEST(SamplingModels, WidenEachParameterInARestart) {
  const ParameterSpace space = space_of(
      {make_categorical("fixed", {"x"}), make_categorical("c", {"a", "b"}), make_real("r", 0, 100),
       make_categorical("also", {"y"}), make_integer("n", 0, 100)});
  Configuration elite(5);
  for (const auto& [parameter, value] :
       {std::pair{0U, 0.0}, {1U, 1.0}, {2U, 50.0}, {3U, 0.0}, {4U, 50.0}})
    elite.set(parameter, value);
  const std::vector<EliteLine> line{{1, 0, &elite}};
  SamplingModels models(space);
  models.initialise(line);
  models.update(line, {.fraction = 1, .shrink = 0.001, .most = 1});
  const auto spread = [&](std::size_t parameter) {
    Rng rng(13);
    std::set<double> values;
    for (int i = 0; i < 200; ++i)
      values.insert((*models.sample(1, rng))[parameter]);
    return *values.rbegin() - *values.begin();
  };
  EXPECT_EQ(spread(1), 0);
  EXPECT_LT(spread(2), 1);
  EXPECT_LT(spread(4), 2);
  models.restart(1, 1000);
  EXPECT_EQ(spread(1), 1);
  EXPECT_GT(spread(2), 5);
  EXPECT_GT(spread(4), 5);
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
