#include "benchmarks/colony/colony.h"

#include "irace_core/files/parameter_file.h"
#include "tests/irace_core/golden.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

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
  const std::string text =
      whole_file(SWARMSMITH_SOURCE_DIR "/benchmarks/data/colony_parameters.txt");
  const auto file = value_of(parse_parameter_file({.parameters = {text, "colony_parameters.txt"}}));
  EXPECT_EQ(print_parameter_file(colony::space()).value(),
            print_parameter_file(file.space).value());
}

}  // namespace
}  // namespace swarmsmith
