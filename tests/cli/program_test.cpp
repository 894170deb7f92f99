#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "base/text/whole_file.h"
#include "cli/commands/commands.h"
#include "sim/control/flavour.h"
#include "sim/mission/score.h"
#include "tests/cli/cli_support.h"
#include "tests/support/checks.h"
#include "tests/support/not_empty.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith::cli {
namespace {

using nlohmann::json;

TEST(Program, WithoutACommandExplainsItselfAndExitsWithTwo) {
  EXPECT_THAT(refusal({}), HasSubstr("Commands:"));
}

TEST(Program, SuggestsTheCommandThatWasMeant) {
  EXPECT_THAT(refusal({"evalute"}),
              HasSubstr("there is no command `evalute` (did you mean \"evaluate\"?)"));
}

TEST(Program, SuggestsTheOptionThatWasMeant) {
  EXPECT_THAT(refusal({"evaluate", "x", "--misson", "aggregation"}),
              HasSubstr("`evaluate` has no option `--misson` (did you mean "
                        "\"--mission\"?)"));
}

TEST(Program, RefusesAWordTooMany) {
  EXPECT_THAT(refusal({"version", "now"}), HasSubstr("unexpected word `now`"));
}

TEST(Program, TakesNumbersWithUnderscores) {
  // The range complains about what remains.
  const Ran ran = run({"ls", "designs", "--limit", "2_000_000_000"});
  EXPECT_THAT(ran.err, HasSubstr("2000000000 not in range"));
  EXPECT_THAT(run({"ls", "designs", "--limit", "1_000"}).err, HasSubstr("no store given"));
}

TEST(Program, NamesWhatIsMissing) {
  EXPECT_THAT(refusal({"check"}), HasSubstr("FILE is required"));
}

TEST(Program, RefusesEveryEmptyPath) {
  int paths = 0;
  const json declared = json::parse(run({"--declared"}).out);
  for (const json& command : declared.at("commands")) {
    if (command.at("name") == "irace") continue;  // an empty path is R's default
    bool is_first = true;
    for (const json& option : command.at("options")) {
      const bool is_word = option.at("word");
      const std::string name = option.at("names").back();
      const std::string value = is_word ? name : std::string(option.at("value"));
      const bool is_path = value.ends_with("FILE") || value.ends_with("STORE") || value == "DIR";
      const bool can_be_first = !is_word || is_first;
      is_first = is_first && !is_word;
      if (!is_path || !can_be_first) continue;
      std::vector<std::string> words{command.at("name")};
      if (!is_word) words.push_back(name);
      words.emplace_back("");
      EXPECT_THAT(refusal(words), HasSubstr("the path is empty"))
          << command.at("name") << " " << name;
      ++paths;
    }
  }
  EXPECT_GT(paths, 60);
  EXPECT_THAT(run({"evaluate", ""}).err, HasSubstr("the path is empty; name a file"));
  EXPECT_THAT(run({"evaluate", ""}).err, Not(HasSubstr("leave it out"))) << "it is required";
  EXPECT_THAT(run({"evaluate", "--mission", ""}).err, HasSubstr("leave it out"));
}

/// Help is wrapped, commands with a backslash; a blank between words.
std::string on_one_line(std::string_view text) {
  std::istringstream words{std::string(text)};
  std::string line;
  for (std::string word; words >> word;) {
    if (word != "\\") line += word + " ";
  }
  return line;
}

TEST(Program, ExplainsEveryCommandOnStandardOutput) {
  int explained = 0;
  for (const ProgramCommand& command : commands()) {
    if (command.name == "track" || command.name == "robot") continue;  // becomes another program
    const Ran ran = run({std::string(command.name), "--help"});
    EXPECT_EQ(ran.code, 0) << command.name;
    const std::string help = on_one_line(ran.out);
    EXPECT_THAT(help, HasSubstr(on_one_line(command.summary)));
    EXPECT_THAT(help, HasSubstr(on_one_line(command.details)));
    EXPECT_THAT(help, HasSubstr("--json"));
    ++explained;
  }
  EXPECT_GT(explained, 30);
}

TEST(Program, HasEveryCommandInItsManual) {
  const std::string manual = whole_file(SWARMSMITH_SOURCE_DIR "/docs/command-line.md");
  for (const ProgramCommand& command : not_empty(commands())) {
    EXPECT_THAT(manual, HasSubstr("## `" + std::string(command.name)));
  }
}

TEST(Program, SaysItsVersionAsJson) {
  const json version = json::parse(run({"version", "--json"}).out);
  EXPECT_EQ(version["name"], "swarmsmith");
  EXPECT_TRUE(version["engine"].is_number_integer());
}

TEST(Init, WritesAFileThatCheckAccepts) {
  const TemporaryFolder folder;
  const std::string inside = (folder / "mine").string();
  for (const char* mission : {"aggregation", "grid_exploration", "color_selection"}) {
    const std::string place = inside + mission;
    EXPECT_EQ(run({"init", place, "--mission", mission}).code, 0);
    const auto campaign = value_of(read_campaign(place + "/campaign.toml"));
    EXPECT_EQ(campaign.missions[0].mission.name, mission);
  }
}

TEST(Init, NamesEveryFlavourAndKindOfScore) {
  const TemporaryFolder folder;
  run_well({"init", folder.path().string()});
  const std::string text = *read_whole_file((folder / "campaign.toml").string());
  EXPECT_THAT(text, HasSubstr(fmt::format("# {}\n", fmt::join(score_kinds(), ", "))));
  for (const Flavour* flavour : flavours_for(kRvrModel))
    EXPECT_THAT(text, HasSubstr(flavour->name));
}

TEST(Init, NeverOverwrites) {
  const TemporaryFolder folder;
  write_file(folder / "campaign.toml", "mine");
  EXPECT_THAT(refusal({"init", folder.path().string()}), HasSubstr("already exists"));
}

TEST(Check, ShowsThePlanAsJson) {
  const TemporaryFolder folder;
  run_well({"init", folder.path().string()});
  const Ran ran = run_well({"check", (folder / "campaign.toml").string(), "--json"});
  const json plan = json::parse(ran.out);
  EXPECT_EQ(plan["designs"], 1);
  EXPECT_EQ(plan["experiments"], 10'000);
  EXPECT_EQ(plan["tests"], 100);
  EXPECT_GT(plan["evaluation_ms"], 0);
}

TEST(Check, SimulatesOnlyTheBeginningOfALongMission) {
  const TemporaryFolder folder;
  write_file(folder / "x.toml",
             "format = 1\n[[mission]]\nname = \"day\"\npreset = \"aggregation\"\n"
             "duration = \"24 h\"\nrobots = 100\n[mission.arena]\nshape = \"square\"\nside = 10\n"
             "[[method]]\nname = \"watermelon\"\n[race]\nmax_experiments = 2000\n");
  const auto begin = std::chrono::steady_clock::now();
  const Ran ran = run({"check", (folder / "x.toml").string(), "--json"});
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));  // whole: minutes
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_GT(json::parse(ran.out)["evaluation_ms"], 10'000);
}

TEST(Check, PrintsAllThatIsWrongAndExitsWithTwo) {
  const TemporaryFolder folder;
  write_file(folder / "x.toml", "format = 1\nseed = 3\n");
  EXPECT_THAT(
      refusal({"check", (folder / "x.toml").string()}),
      AllOf(HasSubstr("x.toml:2:1: the file has no key `seed`"), HasSubstr("no [[mission]]")));
}

TEST(Check, WarnsOfAFlavourThatNoiseBlinds) {
  const TemporaryFolder folder;
  run_well({"init", folder.path().string(), "--flavour", "watermelon-argos3"});
  const Ran ran = run({"check", (folder / "campaign.toml").string()});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.err, HasSubstr("black_floor hardly ever holds"));
}

}  // namespace
}  // namespace swarmsmith::cli
