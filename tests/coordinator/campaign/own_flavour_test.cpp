#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/campaign/campaign_text.h"
#include "coordinator/campaign/machine_space.h"
#include "coordinator/campaign/method_space.h"
#include "sim/control/flavour_file.h"
#include "sim/control/machine_text.h"
#include "tests/coordinator/campaign/campaign_support.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

/// A method with a flavour of a file.
const std::string kMethod = "name = \"m\"\nflavour = \"mine.toml\"\n";
const std::string kSixStates = "format = 1\nbase = \"watermelon\"\nstates = 6\n";
const std::string kExternal =
    "format = 1\nbase = \"watermelon\"\n[behaviours]\nstop = { number = 1 }\n"
    "exploration = { number = 0 }\nwave = { number = 9, kind = \"external\", parameters = [\n"
    "{ name = \"speed\", token = \"v\", type = \"real\", range = [0, 2] } ] }\n";

class OwnFlavour : public ::testing::Test {
 protected:
  CampaignOrErrors read(const std::string& flavour, const FileText& file) {
    std::ofstream(folder_ / "mine.toml") << flavour;
    return parse_campaign(file.text(), (folder_ / "x.toml").string());
  }
  std::vector<std::string> complaints(const std::string& flavour, const FileText& file) {
    return complaints_of(read(flavour, file));
  }

  TemporaryFolder folder_;
};

TEST_F(OwnFlavour, LivesWholeInTheCampaignsText) {
  const auto campaign = value_of(read(kSixStates, {.method = kMethod}));
  const Method& method = campaign.methods.front();
  EXPECT_EQ(method.flavour, "mine");
  ASSERT_NE(method.own_flavour, nullptr);
  EXPECT_EQ(method.own_flavour->most_states, 6);
  EXPECT_EQ(method.max_states, 6);
  const std::string text = normalised_text(campaign);
  EXPECT_THAT(text, HasSubstr("[method.flavour]\nname = \"mine\"\n"));
  const auto again = value_of(parse_campaign(text, "nowhere/stored.toml"));
  EXPECT_EQ(again.methods, campaign.methods);
  EXPECT_EQ(campaign_digest(again), campaign_digest(campaign));
  EXPECT_THAT(own_flavours_in(text), ElementsAre(method.own_flavour));
  EXPECT_THAT(own_flavours_in(normalised_text(parsed(FileText().text()))), ElementsAre());
}

TEST_F(OwnFlavour, ItsTurnClockHoldsForMethodsThatSetNone) {
  const std::string seconds =
      "format = 1\nbase = \"watermelon\"\n[exploration]\nturn_clock = \"seconds\"\n";
  for (const char* keys : {"", "baseline = \"random\"\n", "baseline = \"--nstates 1 --s0 1\"\n",
                           "baseline = \"random\"\narchitecture = \"network\"\n"}) {
    const auto campaign = value_of(read(seconds, {.method = kMethod + keys}));
    EXPECT_EQ(campaign.methods.front().turn_clock, TurnClock::Seconds) << keys;
    const auto again = value_of(parse_campaign(normalised_text(campaign), "stored.toml"));
    EXPECT_EQ(again.methods, campaign.methods) << keys;
  }
  const std::string own = "baseline = \"random\"\nturn_clock = \"cycles\"\n";
  const auto campaign = value_of(read(seconds, {.method = kMethod + own}));
  EXPECT_EQ(campaign.methods.front().turn_clock, TurnClock::Cycles);
}

TEST_F(OwnFlavour, HasTheDecimalsOfTheSearch) {
  const std::string fine =
      "format = 1\nbase = \"watermelon\"\n[conditions]\nfixed_probability = { number = 0, beta = { "
      "range = [0.0001, 0.5], digits = 4 } }\nneighbour_count = { number = 1 }\n";
  const auto digits = [&](const std::string& method, const std::string& race) {
    const auto campaign = read(fine, {.method = kMethod + method, .race = race});
    EXPECT_TRUE(campaign) << to_string(campaign.error().front());
    return campaign ? campaign->digits : 0;
  };
  const std::string race = FileText().race;
  EXPECT_EQ(digits("", race), 4);
  EXPECT_EQ(digits("", race + "digits = 5\n"), 5);
  EXPECT_EQ(digits("conditions = [\"neighbour_count\"]\n", race), 2);
}

TEST_F(OwnFlavour, IsTheOnlyOneOfItsName) {
  const auto method_of = [&](const std::string& flavour, const std::string& name) {
    const std::string text = normalised_text(*read(flavour, {.method = kMethod}));
    std::string method = text.substr(text.find("[[method]]"));
    method.resize(method.find("[race]"));
    return method.replace(method.find("\"m\""), 3, "\"" + name + "\"");
  };
  const std::string text = normalised_text(*read(kSixStates, {.method = kMethod}));
  const auto with = [&](const std::string& method) {
    std::ofstream(folder_ / "x.toml") << std::string(text).insert(text.find("[race]"), method);
    return read_campaign(folder_ / "x.toml");
  };
  EXPECT_TRUE(with(method_of(kSixStates, "n")));
  const auto two = with(method_of(kSixStates + "speed_mps = 0.2\n", "n"));
  ASSERT_FALSE(two);
  EXPECT_THAT(two.error()[0].message, HasSubstr("have two flavours of the name mine"));
}

TEST_F(OwnFlavour, DecidesTheDigestUnlessItIsBuiltIn) {
  FileText built_in;
  built_in.method = "name = \"m\"\n";
  const auto one = read(kSixStates, {.method = kMethod});
  const auto other = read(kSixStates + "speed_mps = 0.2\n", {.method = kMethod});
  EXPECT_NE(campaign_digest(*one), campaign_digest(*other));
  EXPECT_NE(campaign_digest(*one), campaign_digest(parsed(built_in.text())));
  // A table of the text that says what the built-in one says is its name.
  FileText table = built_in;
  table.method += "[method.flavour]\nname = \"watermelon\"\nbase = \"watermelon\"\n";
  EXPECT_EQ(campaign_digest(parsed(table.text())), campaign_digest(parsed(built_in.text())));
}

TEST_F(OwnFlavour, ItsSpaceHasMachinesOfAllItsStates) {
  const auto campaign = read(kSixStates, {.method = kMethod});
  const Method& method = campaign->methods.front();
  const auto space = value_of(MachineSpace::make(method, *method.own_flavour, 2));
  Rng rng(3);
  std::size_t most = 0;
  for (int i = 0; i < 50; ++i) {
    const Machine machine = space.to_machine(random_configuration(space.parameters(), rng));
    most = std::max(most, machine.states.size());
    const std::string text = print_machine(machine, *method.own_flavour);
    EXPECT_EQ(parse_machine(text, *method.own_flavour).value(), machine);
    EXPECT_EQ(space.to_machine(space.from_machine(machine)), machine);
  }
  EXPECT_EQ(most, 6U);
}

TEST_F(OwnFlavour, ModulesThatOnlyOthersHaveAreForPrograms) {
  EXPECT_THAT(
      complaints(kExternal, {.method = kMethod}),
      ElementsAre(HasSubstr("x.toml:7:11: `wave` of the flavour mine is external, which only "
                            "programs run: leave it out of `behaviours`")));
  EXPECT_THAT(complaints(kExternal, {.method = kMethod + "behaviours = [\"stop\"]\n"}),
              ElementsAre());
  EXPECT_THAT(
      complaints(kExternal, {.method = kMethod + "baseline = \"--nstates 1 --s0 9 --v0 1\"\n"}),
      ElementsAre(HasSubstr("the module wave of the flavour mine is external")));
  const FileText programs{.mission = "name = \"theirs\"\n",
                          .method = kMethod,
                          .rest = "[simulator]\nkind = \"command\"\ncommand = [\"/bin/true\"]\n"};
  EXPECT_THAT(complaints(kExternal, programs), ElementsAre());
  const auto campaign = value_of(read(kExternal, programs));
  const Method& method = campaign.methods.front();
  const auto space = MethodSpace::make(method, 2);
  ASSERT_TRUE(space.has_value());
  const auto machine = parse_machine("--nstates 1 --s0 9 --v0 1.5", *method.own_flavour);
  EXPECT_EQ(modules_json(*machine, *method.own_flavour), R"({"wave":1})");
  const auto machines = MachineSpace::make(method, *method.own_flavour, 2);
  EXPECT_EQ(machines->to_machine(machines->from_machine(*machine)), *machine);
}

TEST_F(OwnFlavour, WhatIsWrongInItsFileIsSaidThere) {
  EXPECT_THAT(complaints(kSixStates + "speed = 1\n", {.method = kMethod}),
              ElementsAre(HasSubstr("mine.toml:4:1: the file has no key `speed`")));
  EXPECT_THAT(
      complaints("format = 1\nbase = \"chocolate-epuck\"\n", {.method = kMethod}),
      ElementsAre(HasSubstr("the flavour `mine` takes strengths from proximity sensors, but the "
                            "robot `rvr` gives distances")));
  FileText file{.method = kMethod};
  file.method = "name = \"m\"\n[method.flavour]\nname = \"watermelon\"\nbase = \"chocolate\"\n";
  EXPECT_THAT(complaints("", file),
              ElementsAre(HasSubstr("`watermelon` is built in with other values")));
}

}  // namespace
}  // namespace swarmsmith
