#include "sim/control/flavour_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// The errors of a flavour's file as "file:line:column: sentence".
std::vector<std::string> complaints(const std::string& text) {
  std::vector<std::string> lines;
  const auto flavour = parse_flavour("format = 1\n" + text, "mine.toml");
  if (flavour) return lines;
  for (const Error& error : flavour.error())
    lines.push_back(to_string(error));
  return lines;
}

const std::string kOnWatermelon = "base = \"watermelon\"\n";

TEST(FlavourFile, EachBuiltInFlavourReadsBackFromItsText) {
  for (const Flavour* flavour : not_empty(all_flavours())) {
    const auto again = parse_flavour(flavour_text(*flavour), flavour->name + ".toml");
    ASSERT_TRUE(again.has_value()) << to_string(again.error().front());
    EXPECT_EQ(*again, *flavour) << flavour->name;
    EXPECT_TRUE(is_built_in(*flavour));
    EXPECT_THAT(std::string(built_in_flavour_text(flavour->name)), HasSubstr("format = 1\n"));
  }
}

TEST(FlavourFile, AFileHasWhatItsBaseHasAndItsOwn) {
  const auto mine = parse_flavour(
      "format = 1\nbase = \"watermelon\"\nstates = 6\n[neighbours]\nattraction_gain = 2\n"
      "[behaviours]\nstop = { number = 7 }\n"
      "attraction = { number = 1, alpha = { range = [2, 3], token = \"pull\", digits = 4 } }\n",
      "folder/mine.toml");
  ASSERT_TRUE(mine.has_value()) << to_string(mine.error().front());
  Flavour expected = watermelon();
  expected.name = "mine";
  expected.most_states = 6;
  expected.neighbours.attraction_gain = 2;
  ModuleSpec attraction = *watermelon().find(Module::Attraction);
  attraction.number = 1;
  attraction.parameters[0].low = 2;
  attraction.parameters[0].high = 3;
  attraction.parameters[0].token = "pull";
  attraction.parameters[0].digits = 4;
  ModuleSpec stop = *watermelon().find(Module::Stop);
  stop.number = 7;
  expected.behaviours = {attraction, stop};
  EXPECT_EQ(*mine, expected);
  EXPECT_FALSE(is_built_in(*mine));
  EXPECT_EQ(*parse_flavour(flavour_text(*mine), "mine.toml"), *mine);
}

TEST(FlavourFile, WhatIsWrongIsSaidWithItsPlace) {
  EXPECT_THAT(complaints(kOnWatermelon + "[behaviours]\nhover = { number = 0 }\n"),
              ElementsAre(HasSubstr("mine.toml:4:9: there is no kind of behaviour `hover`; kinds "
                                    "are: exploration, stop, ")));
  EXPECT_THAT(complaints(kOnWatermelon + "[conditions]\nstop = { number = 0 }\n"),
              ElementsAre(HasSubstr("there is no kind of condition `stop`")));
  EXPECT_THAT(
      complaints(kOnWatermelon + "[behaviours]\nexploration = { number = 0, tau = [9, 1] }"),
      ElementsAre("mine.toml:4:35: the range of tau is [9, 1]: its ends are exchanged"));
  EXPECT_THAT(
      complaints(kOnWatermelon + "[behaviours]\nexploration = { number = 0, tau = [0, 1] }"),
      ElementsAre(HasSubstr("the range of tau: tau must be at least 1 and at most 1000000, this is "
                            "0")));
  EXPECT_THAT(complaints(kOnWatermelon + "[behaviours]\nstop = { number = 2 }\n"
                                         "repulsion = { number = 2 }\n"),
              ElementsAre(HasSubstr("`repulsion` and `stop` have the same number 2")));
  EXPECT_THAT(complaints(kOnWatermelon + "[behaviours]\nstop = {}\n"),
              ElementsAre(HasSubstr("`stop` needs its `number` in texts")));
  EXPECT_THAT(
      complaints(kOnWatermelon +
                 "[conditions]\nneighbour_count = { number = 2, xi = { token = \"w\" } }\n"),
      ElementsAre(HasSubstr("`neighbour_count` has the token `w` twice")));
  EXPECT_THAT(
      complaints(kOnWatermelon + "[conditions]\nblack_floor = { number = 2, beta = { token = \"n\" "
                                 "} }\n"),
      ElementsAre(HasSubstr("texts have --n for something else; give beta another token")));
  EXPECT_THAT(complaints(kOnWatermelon + "states = 17\n"),
              ElementsAre("mine.toml:3:10: `states` must be from 1 to 16, this is 17"));
  EXPECT_THAT(complaints("[behaviours]\nstop = { number = 0 }\n"),
              ElementsAre(HasSubstr("a flavour needs a table [conditions] with one at least")));
  EXPECT_THAT(complaints(kOnWatermelon + "[floor]\nblack = [30, 20]\n"),
              ElementsAre(HasSubstr("`black` is from [30, 20]; the lower end comes first")));
  EXPECT_THAT(complaints(kOnWatermelon + "[floor]\nlabels = []\n"),
              ElementsAre(HasSubstr("color_detection looks for four labels")));
  EXPECT_THAT(complaints(kOnWatermelon + "[obstacles]\nnear = 1\n"),
              ElementsAre(HasSubstr("near_m")));
  EXPECT_THAT(complaints("base = \"wassermelone\"\n[behaviours]\nstop = { number = 0 }\n"
                         "[conditions]\ngray_floor = { number = 0 }\n"),
              ElementsAre(HasSubstr("`base` cannot be \"wassermelone\"")));
}

TEST(FlavourFile, AFlavourIsFoundByNameOrFile) {
  EXPECT_EQ(*find_flavour_file("chocolate", "."), chocolate());
  const auto none = find_flavour_file("chocolat", ".");
  ASSERT_FALSE(none.has_value());
  EXPECT_THAT(none.error().front().message, HasSubstr("a file of your own ends in .toml"));
  EXPECT_FALSE(find_flavour_file("no/such.toml", ".").has_value());
}

}  // namespace
}  // namespace swarmsmith
