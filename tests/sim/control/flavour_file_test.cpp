#include "sim/control/flavour_file.h"
#include "sim/control/flavour_text.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sim/control/controller.h"
#include "tests/support/checks.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

/// The errors of a flavour's file as "file:line:column: sentence".
std::vector<std::string> complaints(const std::string& text) {
  return complaints_of(parse_flavour("format = 1\n" + text, "mine.toml"));
}

const std::string kOnWatermelon = "base = \"watermelon\"\n";

TEST(FlavourFile, EachBuiltInFlavourReadsBackFromItsText) {
  for (const Flavour* flavour : not_empty(all_flavours())) {
    const auto again = value_of(parse_flavour(flavour_text(*flavour), flavour->name + ".toml"));
    EXPECT_EQ(again, *flavour) << flavour->name;
    EXPECT_TRUE(is_built_in(*flavour));
    EXPECT_THAT(std::string(built_in_flavour_text(flavour->name)), HasSubstr("format = 1\n"));
  }
}

TEST(FlavourFile, AFileHasWhatItsBaseHasAndItsOwn) {
  const auto mine = value_of(parse_flavour(
      "format = 1\nbase = \"watermelon\"\nstates = 6\n[neighbours]\nattraction_gain = 2\n"
      "[behaviours]\nstop = { number = 7 }\n"
      "attraction = { number = 1, alpha = { range = [2, 3], token = \"pull\", digits = 4 } }\n",
      "folder/mine.toml"));
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
  EXPECT_EQ(mine, expected);
  EXPECT_FALSE(is_built_in(mine));
  EXPECT_EQ(*parse_flavour(flavour_text(mine), "mine.toml"), mine);
}

TEST(FlavourFile, WhatIsWrongIsSaidWithItsPlace) {
  EXPECT_THAT(complaints(kOnWatermelon + "[behaviours]\nhover = { number = 0 }\n"),
              ElementsAre(HasSubstr("mine.toml:4:9: there is no kind of behaviour `hover`; kinds "
                                    "are: exploration, stop, ")));
  EXPECT_THAT(complaints(kOnWatermelon + "[conditions]\nstop = { number = 0 }\n"),
              ElementsAre(HasSubstr("there is no kind of condition `stop`")));
  EXPECT_THAT(
      complaints(kOnWatermelon + "[behaviours]\nexploration = { number = 0, tau = [9, 1] }"),
      ElementsAre("mine.toml:4:35: the range of tau is [9, 1]: write the lower end first"));
  EXPECT_THAT(
      complaints(kOnWatermelon + "[behaviours]\nexploration = { number = 0, tau = [0, 1] }"),
      ElementsAre(HasSubstr("the range of tau: tau must be at least 1 and at most 1000000, this is "
                            "0")));
  EXPECT_THAT(complaints(kOnWatermelon + "[behaviours]\nstop = { number = 2 }\n"
                                         "repulsion = { number = 2 }\n"),
              ElementsAre(HasSubstr("`repulsion` and `stop` have the same number 2")));
  EXPECT_THAT(complaints(kOnWatermelon + "[behaviours]\nexploration = { number = 0 }\n"
                                         "stop = { number = 1001 }\n"),
              ElementsAre(HasSubstr("`number` must be from 0 to 1000, not 1001")))
      << "and no other error follows from it";
  EXPECT_THAT(complaints(kOnWatermelon + "[exploration]\ntrigger = \"front\"\n"),
              ElementsAre(HasSubstr("it is one of: \"front readings\", \"vector sum\", \"front "
                                    "readings, side of the sum\"")));
  EXPECT_THAT(complaints(kOnWatermelon + "[behaviours]\nstop = {}\n"),
              ElementsAre(HasSubstr("`stop` needs a `number`, as in texts of machines")));
  EXPECT_THAT(
      complaints(kOnWatermelon +
                 "[conditions]\nneighbour_count = { number = 2, xi = { token = \"w\" } }\n"),
      ElementsAre(HasSubstr("`neighbour_count` has the token `w` twice")));
  EXPECT_THAT(
      complaints(kOnWatermelon + "[conditions]\nblack_floor = { number = 2, beta = { token = \"n\" "
                                 "} }\n"),
      ElementsAre(HasSubstr("--n has another meaning in texts; give beta another token")));
  EXPECT_THAT(complaints(kOnWatermelon +
                         "[behaviours]\nattraction = { number = 0, alpha = { token = \"p\" } }\n"),
              ElementsAre(HasSubstr("--p has another meaning in texts; give alpha another token")));
  EXPECT_THAT(complaints(kOnWatermelon + "states = 17\n"),
              ElementsAre("mine.toml:3:10: `states` must be from 1 to 16, not 17"));
  EXPECT_THAT(
      complaints("[behaviours]\nstop = { number = 0 }\n"),
      ElementsAre(HasSubstr("a flavour needs a table [conditions] with at least one entry")));
  const std::string on_nothing =
      "[behaviours]\nstop = { number = 0 }\n[conditions]\nwhite_floor = { number = 0 }\n";
  EXPECT_THAT(complaints(on_nothing),
              ElementsAre(HasSubstr("conditions of the floor need `black`, `gray` and `white`")));
  EXPECT_THAT(complaints(on_nothing + "[floor]\nwhite = [200, 255]\n"), IsEmpty());
  EXPECT_THAT(complaints(kOnWatermelon + "[floor]\nblack = [30, 20]\n"),
              ElementsAre(HasSubstr("`black` is from [30, 20]; write the lower end first")));
  EXPECT_THAT(complaints(kOnWatermelon + "[floor]\nlabels = []\n"),
              ElementsAre(HasSubstr("color_detection needs four labels in [floor]")));
  EXPECT_THAT(complaints(kOnWatermelon + "[obstacles]\nnear = 1\n"),
              ElementsAre(HasSubstr("near_m")));
  EXPECT_THAT(complaints("base = \"wassermelone\"\n[behaviours]\nstop = { number = 0 }\n"
                         "[conditions]\ngray_floor = { number = 0 }\n"),
              ElementsAre(HasSubstr("`base` cannot be \"wassermelone\"")));
}

const std::string kColours =
    "base = \"watermelon\"\nstates = 12\n[behaviours]\nstop = { number = 1 }\n"
    "exploration = { number = 0 }\n"
    "go_to_color = { number = 8, kind = \"external\", parameters = [\n"
    "  { name = \"velocity\", token = \"vel\", type = \"real\", range = [0, 1] },\n"
    "  { name = \"color\", token = \"clr\", type = \"int\", range = [1, 6] } ] }\n"
    "[conditions]\nblack_floor = { number = 0 }\n"
    "message = { number = 3, kind = \"external\" }\n";

TEST(FlavourFile, ModulesThatOnlyOthersHaveAreReadAndWritten) {
  const auto read = value_of(parse_flavour("format = 1\n" + kColours, "colours.toml"));
  const ModuleSpec* module = read.find("go_to_color");
  ASSERT_NE(module, nullptr);
  EXPECT_TRUE(is_external(module->module));
  EXPECT_TRUE(is_behaviour(module->module));
  EXPECT_EQ(module->module, external_behaviour(8));
  ASSERT_EQ(module->parameters.size(), 2U);
  EXPECT_EQ(module->parameters[0].symbol, "VEL");
  EXPECT_EQ(module->parameters[0].digits, 2);
  EXPECT_EQ(module->parameters[1].type, ParameterSpec::Type::Integer);
  EXPECT_EQ(module->parameters[1].high, 6);
  EXPECT_FALSE(is_behaviour(read.find("message")->module));
  EXPECT_EQ(*parse_flavour(flavour_text(read), "colours.toml"), read);
}

TEST(FlavourFile, TextsOfExternalModulesAreReadAndPrintedAndNeverRun) {
  const Flavour colours = *parse_flavour("format = 1\n" + kColours, "colours.toml");
  const std::string text =
      "--nstates 2 --s0 8 --vel0 0.5 --clr0 3 --n0 1 --n0x0 0 --c0x0 3 --s1 1 --n1 1 --n1x0 0 "
      "--c1x0 0 --p1x0 0.25";
  const auto controller = value_of(parse_controller(text, colours));
  EXPECT_EQ(print_controller(controller, colours), text);
  const auto& machine = std::get<Machine>(controller);
  EXPECT_EQ(machine.states[0].behaviour, (Behaviour(ExternalBehaviour{8, {0.5, 3}})));
  EXPECT_EQ(parameters_of(machine.states[0].behaviour), (std::vector<double>{0.5, 3}));
  EXPECT_EQ(module_of(machine.states[0].transitions[0].condition), external_condition(3));
  EXPECT_EQ(complaint_about_running(controller, colours),
            "the module go_to_color of the flavour colours is external: this program can read it, "
            "but only your own program can run it");
  const auto own = parse_controller("--nstates 1 --s0 1", colours);
  EXPECT_EQ(complaint_about_running(*own, colours), std::nullopt);
  const auto other = parse_controller("--nstates 1 --s0 8 --vel0 0.5 --clr0 2.5", colours);
  ASSERT_FALSE(other.has_value());
  EXPECT_THAT(other.error().message, HasSubstr("`--clr0` must be an integer, not `2.5`"));
}

TEST(FlavourFile, AMachineHasAsManyStatesAsItsFlavourAllows) {
  const Flavour colours = *parse_flavour("format = 1\n" + kColours, "colours.toml");
  std::string text = "--nstates 12";
  for (int i = 0; i < 12; ++i) {
    const std::string own = std::to_string(i);
    text += " --s" + own + " 1 --n" + own + " 1 --n" + own + "x0 " + std::to_string(i % 11) +
            " --c" + own + "x0 0 --p" + own + "x0 1";
  }
  const auto machine = value_of(parse_controller(text, colours));
  EXPECT_EQ(print_controller(machine, colours), text);
  EXPECT_THAT(parse_controller(text, watermelon()).error().message,
              HasSubstr("a machine of 12 states; machines of 1 to 4 states are read"));
  EXPECT_THAT(check(machine, watermelon())->message, HasSubstr("a machine has 1 to 4 states"));
}

TEST(FlavourFile, WhatIsWrongWithAnExternalModuleIsSaid) {
  const auto with = [](const std::string& line) {
    return complaints(kOnWatermelon + "[behaviours]\nstop = { number = 1 }\n" + line);
  };
  EXPECT_THAT(with("stop_it = { number = 1, kind = \"external\" }"),
              ElementsAre(HasSubstr("`stop` and `stop_it` have the same number 1")));
  EXPECT_THAT(with("exploration = { number = 3, kind = \"external\" }"),
              ElementsAre(HasSubstr("`exploration` is a kind of this program")));
  EXPECT_THAT(
      with("Wave = { number = 3, kind = \"external\" }"),
      ElementsAre(HasSubstr("a module's name must consist of small letters, digits and `_`")));
  EXPECT_THAT(with("wave = { number = 3, kind = \"foreign\" }"),
              ElementsAre(HasSubstr("`kind` cannot be \"foreign\"")));
  EXPECT_THAT(with("gray_floor = { number = 3, kind = \"external\" }"),
              ElementsAre(HasSubstr("`gray_floor` is a kind of this program")));
  const auto parameter = [&](const std::string& keys) {
    return with("wave = { number = 3, kind = \"external\", parameters = [ { " + keys + " } ] }");
  };
  EXPECT_THAT(parameter("name = \"speed\", token = \"v\", type = \"real\", range = [2, 1]"),
              ElementsAre(HasSubstr("the range of speed is [2, 1]: write the lower end first")));
  EXPECT_THAT(parameter("name = \"speed\", token = \"v2\", type = \"real\", range = [1, 2]"),
              ElementsAre(HasSubstr("`token` must be 1 to 20 letters")));
  EXPECT_THAT(parameter("name = \"speed\", token = \"s\", type = \"int\", range = [1, 2]"),
              ElementsAre(HasSubstr("--s has another meaning in texts"),
                          HasSubstr("the search already has a parameter S")));
  EXPECT_THAT(parameter("name = \"speed\", token = \"p\", type = \"int\", range = [1, 2]"),
              ElementsAre(HasSubstr("--p has another meaning in texts")));
  EXPECT_THAT(parameter("token = \"v\", type = \"int\", range = [1, 2]"),
              ElementsAre(HasSubstr("needs `name`")));
  EXPECT_THAT(complaints(kOnWatermelon + "[conditions]\nblack_floor = { number = 0 }\n"
                                         "gray_floor = { number = 1, beta = [0, 0.5] }\n"),
              ElementsAre(HasSubstr("black_floor and gray_floor have parameters of the symbol P "
                                    "that differ")));
}

TEST(FlavourFile, OnlyModulesOfOtherProgramsMayReadAnUnknownReferenceModel) {
  EXPECT_THAT(complaints("base = \"chocolate-epuck\"\nreference = \"rm1.3\"\n"),
              ElementsAre("mine.toml:3:13: there is no reference model \"rm1.3\" (did you mean "
                          "\"rm1.1\"?); known are: rvr, rm1.1, rm1.2, rm1-2018"));
  for (const char* known : {"rvr", "rm1.1", "rm1.2", "rm1-2018"})
    EXPECT_THAT(complaints(kOnWatermelon + "reference = \"" + known + "\"\n"), IsEmpty());
  EXPECT_THAT(complaints("reference = \"rm3\"\n" + kColours), IsEmpty());
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
