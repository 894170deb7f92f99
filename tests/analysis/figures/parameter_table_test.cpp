#include "analysis/figures/internal/parameter_table.h"

#include <algorithm>
#include <cmath>

#include "analysis/figures/internal/category_colors.h"
#include "analysis/figures/internal/parameter_words.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

const Flavour* find_flavour_named(std::string_view name) {
  const auto all = all_flavours();
  return *std::ranges::find_if(all, [&](const Flavour* one) { return one->name == name; });
}

/// Six candidates; `size` is 1, 1, 2, 10, 3, 3 as text would sort it wrongly, `s0` moves from stop
/// to attraction, `tau` is a number that only some have, `same` never changes.
ParameterTable small_table() {
  std::vector<SampledRecord> candidates;
  std::vector<ParameterRecord> records;
  const std::vector<std::string> sizes = {"1", "1", "2", "6", "3", "3"};
  for (std::int64_t i = 1; i <= 6; ++i) {
    const CandidateId id{i};
    candidates.push_back({.candidate = id, .iteration = (i + 1) / 2, .runs = 1, .mean = 1.0});
    records.push_back({id, 1, "size", sizes[static_cast<std::size_t>(i - 1)], true});
    records.push_back({id, 1, "s0", i <= 2 ? "stop" : "attraction", false});
    records.push_back({id, 1, "same", "yes", false});
    if (i % 2 == 0) records.push_back({id, 1, "tau", i == 2 ? "0.5" : "99.25", true});
  }
  return parameter_table(candidates, records);
}

const ParameterColumn& column(const ParameterTable& table, std::string_view name) {
  return table.columns.at(named_columns(table, name, 9).value().front());
}

TEST(ParameterTable, FewWholeNumbersAreCategoriesInTheirOrder) {
  const ParameterTable table = small_table();
  EXPECT_THAT(column(table, "size").categories, ElementsAre("1", "2", "3", "6"));
  EXPECT_THAT(column(table, "size").values, ElementsAre(0, 0, 1, 3, 2, 2));
  EXPECT_THAT(column(table, "s0").categories, ElementsAre("attraction", "stop"));
}

TEST(ParameterTable, NumbersHaveARangeAndMayBeInactive) {
  const ParameterTable table = small_table();
  const ParameterColumn& tau = column(table, "tau");
  EXPECT_FALSE(tau.is_category());
  EXPECT_DOUBLE_EQ(tau.low, 0.5);
  EXPECT_DOUBLE_EQ(tau.high, 99.25);
  EXPECT_EQ(tau.active, 3U);
  EXPECT_TRUE(std::isnan(tau.values[0]));
  EXPECT_DOUBLE_EQ(tau.values[1], 0.5);
}

TEST(ParameterTable, MovementIsTheTotalVariationOfTheThirds) {
  const ParameterTable table = small_table();
  EXPECT_DOUBLE_EQ(movement(column(table, "s0")), 1);
  EXPECT_DOUBLE_EQ(movement(column(table, "same")), 0);
  EXPECT_DOUBLE_EQ(movement(column(table, "size")), 1);
  EXPECT_DOUBLE_EQ(movement(column(table, "tau")), 0.5);  // half inactive in both thirds
}

TEST(ParameterTable, NamesThatAreNotThereAreToldWithWhatIs) {
  const ParameterTable table = small_table();
  EXPECT_THAT(named_columns(table, "tau, s0", 9).value(), ElementsAre(3U, 0U));
  const Error wrong = why_not(named_columns(table, "s0,speed", 9));
  EXPECT_EQ(wrong.kind, ErrorKind::BadInput);
  EXPECT_THAT(wrong.message, HasSubstr("speed"));
  EXPECT_THAT(wrong.message, HasSubstr("same, size, tau"));
  EXPECT_THAT(named_columns(table, "s0,tau,size", 2).error().message, HasSubstr("at most 2"));
  EXPECT_TRUE(named_columns(table, "", 2)->empty());
}

void expect_neighbours_to_differ(const std::vector<std::string>& values) {
  const CategoryColors colors({values});
  const auto grey = [&](std::size_t i) {
    const std::string color = colors.color(values[i]);
    const auto channel = [&](std::size_t at) {
      return std::stoi(color.substr(at, 2), nullptr, 16);
    };
    return 0.2126 * channel(1) + 0.7152 * channel(3) + 0.0722 * channel(5);
  };
  for (std::size_t i = 1; i < values.size(); ++i)
    EXPECT_GT(std::abs(grey(i) - grey(i - 1)), 50) << values[i];
}

TEST(CategoryColors, NeighboursDifferInLightness) {
  expect_neighbours_to_differ({"a", "b", "c", "d", "e", "f", "g"});
  expect_neighbours_to_differ({"black_floor", "color_detection", "fixed_probability", "gray_floor",
                               "inverted_neighbour_count", "neighbour_count", "white_floor"});
}

TEST(CategoryColors, OfAColorAreLikeIt) {
  const CategoryColors colors({{"black_floor", "gray_floor", "stop", "white_floor"}});
  EXPECT_EQ(colors.color("black_floor"), "#000000");
  EXPECT_EQ(colors.color("gray_floor"), "#969696");
  EXPECT_EQ(colors.color("white_floor"), "#eeeeee");
}

TEST(CategoryColors, ListsThatShareAValueShareAPalette) {
  const CategoryColors colors({{"b", "c"}, {"1", "10"}, {"a", "b"}, {}, {"2", "10"}});
  ASSERT_EQ(colors.families().size(), 2U);
  EXPECT_EQ(colors.families()[0].size(), 3U);
  EXPECT_EQ(colors.families()[1][1].first, "2");  // numbers in their order
  EXPECT_NE(colors.color("a"), colors.color("b"));
  EXPECT_TRUE(CategoryColors::belongs({"c"}, colors.families()[0]));
  EXPECT_FALSE(CategoryColors::belongs({"1"}, colors.families()[0]));
}

TEST(ParameterWords, NameModulesAndPlaces) {
  const Flavour& flavour = *find_flavour_named("watermelon");
  for (const auto& [name, words] : std::vector<std::pair<std::string, std::string>>{
           {"NumStates", "states"},
           {"S0", "behaviour 0"},
           {"RWM2", "exploration tau 2"},
           {"ATT1", "attraction alpha 1"},
           {"NumConnections3", "edges of 3"},
           {"N1x0", "target 1.0"},
           {"C1x0", "condition 1.0"},
           {"P0x1", "beta 0.1"},
           {"BI0x3", "inverted neighbour count xi 0.3"},
           {"speed", "speed"},
           {"weight12", "weight12"},
           {"x", "x"}})
    EXPECT_EQ(words_of_parameter(name, flavour), words);
}

}  // namespace
}  // namespace swarmsmith
