#include "benchmarks/colony/colony.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "benchmarks/colony/rank_sum.h"
#include "irace_core/files/parameter_file.h"
#include "tests/irace_core/golden.h"

namespace swarmsmith {
namespace {

using testing::golden;

/// A configuration from {"algo": "b", "alpha": 4.6972, "q0": null, ...}.
Configuration configuration_from(const nlohmann::json& json, const ParameterSpace& space) {
  Configuration configuration(space.size());
  for (std::size_t i = 0; i < space.size(); ++i) {
    const auto& value = json.at(space[i].name);
    if (value.is_null()) continue;
    if (space.is_numeric(i)) {
      configuration.set(i, value.get<double>());
      continue;
    }
    for (std::size_t choice = 0; choice < space.value_count(i); ++choice) {
      if (space.scalar(i, static_cast<double>(choice)).text == value.get<std::string>())
        configuration.set(i, static_cast<double>(choice));
    }
  }
  return configuration;
}

TEST(Colony, IsTheFormulaThatRsIraceWasRunOn) {
  const ParameterSpace space = colony::space();
  EXPECT_EQ(space.variable_count(), 10);
  const auto cases = golden("check_colony.json");
  ASSERT_EQ(cases.size(), 40U);
  for (const auto& one : cases) {
    const Configuration configuration = configuration_from(one.at("configuration"), space);
    ASSERT_TRUE(space.check(configuration)) << one;
    const auto instance = one.at("instance").get<std::int64_t>();
    const auto seed = one.at("seed").get<std::int64_t>();
    const auto near = [](double value, double wanted) {
      return std::fabs(value - wanted) <= 1e-12 * std::fabs(wanted);
    };
    EXPECT_PRED2(near, colony::loss(configuration, instance), one.at("g").get<double>());
    EXPECT_PRED2(near, colony::cost(configuration, instance, seed), one.at("cost").get<double>());
    EXPECT_PRED2(near, colony::true_cost(configuration), one.at("true_cost").get<double>());
  }
}

/// The parameter file that R's irace reads.
TEST(Colony, SearchesTheSpaceOfItsParameterFile) {
  std::ifstream stream(std::string(SWARMSMITH_SOURCE_DIR) +
                       "/benchmarks/data/colony_parameters.txt");
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  const auto file = parse_parameter_file({.parameters = {text, "colony_parameters.txt"}});
  ASSERT_TRUE(file) << to_string(file.error());
  EXPECT_EQ(print_parameter_file(colony::space()).value(),
            print_parameter_file(file->space).value());
}

/// Values of R's wilcox.test(a, b, alternative = "greater").
TEST(RankSum, IsThatOfR) {
  const std::vector<double> a = {0.3, 1.2, 2.2, 3.1, 0.7};
  const std::vector<double> b = {0.1, 0.2, 1.1, 2.0};
  EXPECT_NEAR(p_of_larger(a, b), 0.142857142857143, 1e-14);
  const std::vector<double> tied_a = {1, 2, 2, 3, 5};
  const std::vector<double> tied_b = {2, 2, 4, 1};
  EXPECT_NEAR(p_of_larger(tied_a, tied_b), 0.398584846566871, 1e-14);
  std::vector<double> many;
  std::vector<double> more;
  for (int i = 1; i <= 20; ++i)
    many.push_back(i * 1.01);
  for (int i = 1; i <= 45; ++i)
    more.push_back(i * 0.5);
  EXPECT_NEAR(p_of_larger(many, more), 0.666406193902278, 1e-12);
}

TEST(RankSum, OfTheSameNumbersSaysNothing) {
  const std::vector<double> same = {4, 4, 4};
  EXPECT_EQ(p_of_larger(same, same), 1);
}

}  // namespace
}  // namespace swarmsmith
