#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/arguments/machine_words.h"
#include "console/seeds.h"
#include "sim/control/machine_text.h"
#include "sim/engine/simulate.h"
#include "sim/files/profile_file.h"
#include "tests/cli/cli_support.h"
#include "tests/support/checks.h"
#include "tests/support/not_empty.h"
#include "tests/support/one_design.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith::cli {
namespace {

using nlohmann::json;

std::vector<json> lines_of(const std::string& text) {
  std::vector<json> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    lines.push_back(json::parse(line));
  return lines;
}

/// What the engine itself says of kExploreText on a built-in mission.
double score_of(const std::string& mission_name, std::int64_t seed) {
  const Mission mission = *built_in_mission(mission_name);
  const Machine machine = *parse_machine(kExploreText, watermelon());
  const Instance instance = *instance_of(mission, seed);
  return simulate({.controller = machine,
                   .flavour = watermelon(),
                   .profile = *built_in_profile("rvr"),
                   .mission = mission,
                   .instance = instance,
                   .seed = seed})
      .score;
}

TEST(Evaluate, GivesOneJsonLineARunWithSeedAndScore) {
  const Ran ran = run_well({"evaluate", kExploreText, "--flavour", "watermelon", "--profile", "rvr",
                            "--mission", "grid_exploration", "--seeds", "4-5", "--json"});
  const auto lines = lines_of(ran.out);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0], (json{{"seed", 4}, {"score", score_of("grid_exploration", 4)}}));
  EXPECT_EQ(lines[1]["score"], score_of("grid_exploration", 5));
  EXPECT_LT(lines[0]["score"], 0);
}

TEST(Evaluate, TakesAMachineAsSeveralWordsBeforeAfterAndBehindDashes) {
  const std::string wanted = run({"evaluate", kExploreText, "--flavour", "watermelon", "--mission",
                                  "aggregation", "--seeds", "1-3"})
                                 .out;
  const std::vector<std::string> rest = {"--flavour",   "watermelon", "--mission",
                                         "aggregation", "--seeds",    "1-3"};
  const std::vector<std::string> machine = {"--nstates", "1", "--s0", "0", "--rwm0", "10"};
  const auto in_order = [](std::vector<std::string> first, const std::vector<std::string>& then) {
    first.insert(first.begin(), "evaluate");
    first.insert(first.end(), then.begin(), then.end());
    return first;
  };
  EXPECT_EQ(run(in_order(machine, rest)).out, wanted);
  EXPECT_EQ(run(in_order(rest, machine)).out, wanted);
  std::vector<std::string> dashed = machine;
  dashed.insert(dashed.begin(), "--");
  EXPECT_EQ(run(in_order(rest, dashed)).out, wanted);
  std::vector<std::string> config = machine;
  config.insert(config.begin(), "--fsm-config");
  EXPECT_EQ(run(in_order(rest, config)).out, wanted);
}

TEST(Evaluate, TakesAMachineFromAFileWithComments) {
  const TemporaryFolder folder;
  write_file(folder / "best.fsm", "# d1 c1\n\n--fsm-config " + kExploreText + "\n");
  const Ran ran = run_well({"evaluate", (folder / "best.fsm").string(), "--flavour", "watermelon",
                            "--mission", "aggregation"});
  EXPECT_THAT(ran.out, HasSubstr("seed 10  score "));
  EXPECT_THAT(ran.out, HasSubstr("95 % interval"));
}

TEST(Evaluate, TakesTheWorldThatAFileSays) {
  const TemporaryFolder folder;
  const std::string file = (folder / "machines.fsm").string();
  const std::string head =
      "#: format = 1\n#: flavour = \"watermelon\"\n#: profile = \"rvr\"\n"
      "#: mission = \"grid_exploration\"\n#: candidate = \"c7\"\n#: seeds = \"4,5\"\n";
  write_file(file, head + kExploreText + "\n" + head + kStopText + "\n");
  const Ran ran = run_well({"evaluate", file, "--json"});
  const auto lines = lines_of(ran.out);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0],
            (json{{"machine", "c7"}, {"seed", 4}, {"score", score_of("grid_exploration", 4)}}));
  EXPECT_EQ(lines[1]["score"], score_of("grid_exploration", 5));
  EXPECT_THAT(
      refusal({"evaluate", file, "--flavour", "chocolate"}),
      HasSubstr("the machine is of the flavour watermelon (" + file + ":7), not chocolate"));
  // Another mission or profile is a question that people have.
  EXPECT_EQ(run({"evaluate", file, "--mission", "aggregation", "--profile", "argos3"}).code, 0);
}

TEST(Evaluate, AsksForAFlavourThatIsNotGiven) {
  const TemporaryFolder folder;
  write_file(folder / "best.fsm", kExploreText + "\n");
  for (const std::string& machine : {kExploreText, (folder / "best.fsm").string()}) {
    EXPECT_THAT(refusal({"evaluate", machine, "--mission", "aggregation"}),
                HasSubstr("--flavour: the machine's flavour is unknown; add"));
  }
}

TEST(Evaluate, TakesStartsFromATable) {
  const TemporaryFolder folder;
  write_file(folder / "starts.csv",
             "seed,robot,x,y,theta\n5,0,0.1,0.2,0\n5,1,-0.6,0,1\n5,2,0.6,0.6,7\n");
  const std::vector<std::string> command = {
      "evaluate",  kStopText,     "--flavour", "watermelon",
      "--mission", "aggregation", "--starts",  (folder / "starts.csv").string(),
      "--json",    "--seeds"};
  auto seeds = command;
  seeds.emplace_back("5");
  EXPECT_EQ(run(seeds).out, "{\"seed\":5,\"score\":1}\n");
  seeds.back() = "5-6";
  EXPECT_THAT(refusal(seeds), HasSubstr("the starts have no row for seed 6"));
  seeds.back() = "5";
  EXPECT_THAT(run(seeds).err, Not(HasSubstr("overlap")));
  for (const char* option : {"--csv", "--objects-csv", "--svg"}) {
    auto onto_input = seeds;
    onto_input.insert(onto_input.end(), {option, (folder / "starts.csv").string()});
    const Ran ran = run(onto_input);
    EXPECT_EQ(ran.code, 2);
    EXPECT_THAT(ran.err, HasSubstr("starts.csv: is an input of this command")) << option;
  }
  write_file(folder / "starts.csv",
             "seed,robot,x,y,theta\n5,0,0.1,0.2,0\n5,1,0.1,0.3,1\n5,2,0.6,0.6,7\n"
             "6,0,0.1,0.2,0\n6,1,-0.6,0,1\n6,2,0.6,0.6,7\n");
  seeds.back() = "5-6";
  const Ran overlapping = run(seeds);
  EXPECT_EQ(overlapping.code, 0) << overlapping.err;
  EXPECT_THAT(overlapping.err, HasSubstr("note: in the starts of 1 of 2 seeds, robots overlap each "
                                         "other, a wall or something in the arena (seed 5)\n"));
}

TEST(Evaluate, TakesPatchesFromATable) {
  const TemporaryFolder folder;
  write_file(folder / "starts.csv",
             "seed,robot,x,y,theta\n1,0,0.75,0.25,0\n1,1,-0.25,-0.25,0\n1,2,0.25,0.75,0\n");
  write_file(folder / "patches.csv",
             "seed,x,y,color\n1,0.75,0.25,yellow\n1,-0.25,-0.25,red\n1,0.25,0.75,green\n"
             "1,0.75,-0.25,yellow\n1,0.25,-0.25,yellow\n1,0.25,0.25,yellow\n1,0.25,-0.75,red\n"
             "1,-0.25,0.25,red\n1,-0.25,-0.75,red\n1,-0.25,0.75,green\n1,-0.75,-0.25,green\n"
             "1,-0.75,0.25,green\n");
  std::vector<std::string> command = {"evaluate",  kStopText,
                                      "--flavour", "watermelon",
                                      "--mission", "color_selection",
                                      "--starts",  (folder / "starts.csv").string(),
                                      "--patches", (folder / "patches.csv").string(),
                                      "--json",    "--seeds",
                                      "1"};
  EXPECT_EQ(run(command).out, "{\"seed\":1,\"score\":3}\n");
  write_file(folder / "patches.csv", "seed,x,y,color\n1,0.7,0.25,yellow\n");
  EXPECT_THAT(refusal(command),
              HasSubstr("patches, seed 1: there is no free place for a patch at (0.7"));
}

TEST(Evaluate, TakesMissionAndProfileFromFiles) {
  const TemporaryFolder folder;
  write_file(folder / "mine.toml", "format = 1\npreset = \"grid_exploration\"\n");
  run_well({"profile", "rvr", "-o", (folder / "my_rvr.toml").string()});
  const std::vector<std::string> command = {"evaluate",  kExploreText,
                                            "--flavour", "watermelon",
                                            "--mission", (folder / "mine.toml").string(),
                                            "--profile", (folder / "my_rvr.toml").string(),
                                            "--seeds",   "4",
                                            "--json"};
  const Ran ran = run_well(command);
  EXPECT_EQ(lines_of(ran.out)[0]["score"], score_of("grid_exploration", 4));
  write_file(folder / "mine.toml", "format = 1\nrobots = 0\nfloor = 1\n");
  const std::string wrong = refusal(command);
  EXPECT_THAT(wrong, HasSubstr("mine.toml:2:10: `robots` must be from 1 to 100"));
  EXPECT_THAT(wrong, HasSubstr("mine.toml:3:1: the file has no key `floor`"));
}

TEST(Evaluate, TakesTheProfileOfTheMissionsRobot) {
  const TemporaryFolder folder;
  write_file(folder / "own.toml", "format = 1\nbase = \"epuck\"\n[drive]\ntrack = 0.06\n");
  write_file(folder / "mine.toml",
             "format = 1\npreset = \"aggregation\"\nduration = \"5 s\"\nrobot = \"own.toml\"\n");
  const auto evaluate = [&](const std::string& profile) {
    std::vector<std::string> words = {
        "evaluate",        kExploreText, "--flavour",
        "chocolate-epuck", "--mission",  (folder / "mine.toml").string(),
        "--seeds",         "1",          "--json"};
    if (!profile.empty()) words.insert(words.end(), {"--profile", profile});
    return words;
  };
  EXPECT_EQ(run_well(evaluate("")).out, run_well(evaluate("epuck")).out);
  EXPECT_THAT(refusal(evaluate("rvr")),
              HasSubstr("give another --profile (argos3, epuck, epuck-ideal, "
                        "epuck-pseudo-reality), or a --mission of another robot"));
}

TEST(Evaluate, TakesAFlavourFromAFile) {
  const TemporaryFolder folder;
  const std::string file = (folder / "mine.toml").string();
  run_well({"flavour", "watermelon", "-o", file});
  const auto evaluate = [](const std::string& machine, const std::string& flavour) {
    return run({"evaluate", machine, "--flavour", flavour, "--mission", "grid_exploration",
                "--seeds", "4", "--json"});
  };
  const Ran same = evaluate(kExploreText, file);
  ASSERT_EQ(same.code, 0) << same.err;
  EXPECT_EQ(lines_of(same.out)[0]["score"], score_of("grid_exploration", 4));
  write_file(folder / "mine.toml", "format = 1\nbase = \"watermelon\"\nspeed_mps = 0.1\n");
  EXPECT_NE(lines_of(evaluate(kExploreText, file).out)[0]["score"],
            score_of("grid_exploration", 4));
  write_file(folder / "mine.toml",
             "format = 1\nbase = \"watermelon\"\n[behaviours]\n"
             "wave = { number = 9, kind = \"external\" }\n");
  const Ran external = evaluate("--nstates 1 --s0 9", file);
  EXPECT_EQ(external.code, 2);
  EXPECT_THAT(external.err, HasSubstr("the module wave of the flavour mine is external"));
  const Ran robot = evaluate("--nstates 1 --s0 1", "chocolate-epuck");
  EXPECT_EQ(robot.code, 2);
  EXPECT_THAT(robot.err, HasSubstr("takes strengths from proximity sensors, but the robot `rvr` "
                                   "gives distances; give another --flavour, or a --mission of "
                                   "another robot\n"));
  write_file(folder / "mine.toml", "format = 1\nbase = \"watermelon\"\nstates = 20\n");
  EXPECT_THAT(evaluate(kExploreText, file).err,
              HasSubstr("mine.toml:3:10: `states` must be from 1 to 16, not 20"));
}

TEST(Flavours, AreListedPrintedAndWrittenButNotOver) {
  EXPECT_THAT(run({"flavour"}).out, StartsWith("watermelon\nwatermelon-argos3\n"));
  EXPECT_THAT(run({"flavour", "chocolate"}).out, HasSubstr("[behaviours]\n"));
  EXPECT_EQ(json::parse(run({"flavour", "--json"}).out)["flavours"].size(), all_flavours().size());
  const json listed = json::parse(run({"ls", "flavours", "--json"}).out);
  EXPECT_EQ(listed["rows"].size(), all_flavours().size());
  EXPECT_EQ(listed["rows"][0]["flavour"], "watermelon");
  EXPECT_EQ(listed["rows"][0]["states"], 4);
  const TemporaryFolder folder;
  const std::string file = (folder / "f.toml").string();
  EXPECT_EQ(run({"flavour", "chocolate", "-o", file}).code, 0);
  EXPECT_EQ(run({"flavour", "chocolate", "-o", file}).code, 2);
  EXPECT_THAT(run({"flavour", file}).out, HasSubstr("reference = \"rvr\""));
  EXPECT_THAT(run({"flavour", "chocolat"}).err, HasSubstr("did you mean \"chocolate\"?"));
}

TEST(Robots, AreListed) {
  const json rows = json::parse(run({"ls", "robots", "--json"}).out)["rows"];
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0]["robot"], "rvr");
  EXPECT_EQ(rows[0]["neighbours"], "sight");
  EXPECT_EQ(rows[1]["robot"], "epuck");
  EXPECT_EQ(rows[1]["track_m"], 0.053);
  EXPECT_EQ(rows[1]["light_sensors"], 8);
  EXPECT_EQ(rows[1]["neighbours"], "radio");
}

TEST(BuiltInLists, TakeConditionsOrderAndLimitAsRowsOfAStoreDo) {
  const auto names = [](const std::vector<std::string>& words, const char* kind) {
    std::vector<std::string> command = {"ls", kind, "--json"};
    command.insert(command.end(), words.begin(), words.end());
    std::vector<std::string> found;
    const json answer = json::parse(run_well(command).out);
    for (const json& row : answer["rows"])
      found.push_back(row[std::string(kind) == "robots" ? "robot" : "flavour"]);
    return found;
  };
  EXPECT_THAT(names({"--where", "mass_kg > 1"}, "robots"), ElementsAre("rvr"));
  EXPECT_THAT(names({"--sort", "mass_kg"}, "robots"), ElementsAre("epuck", "rvr"));
  EXPECT_THAT(names({"--sort", "flavour DESC", "--limit", "1"}, "flavours"),
              ElementsAre("watermelon-argos3"));
  EXPECT_THAT(run_well({"ls", "robots", "--limit", "1"}).err, HasSubstr("only the first row"));
  EXPECT_THAT(refusal({"ls", "robots", "--where", "(("}), HasSubstr("syntax error"));
  EXPECT_THAT(refusal({"ls", "flavours", "--sort", "nonsense"}),
              HasSubstr("no such column: nonsense\n"));
  EXPECT_THAT(refusal({"ls", "robots", "campaign.db"}), HasSubstr("leave the store out"));
}

TEST(Evaluate, NamesAllProfilesInItsHelp) {
  const std::string help = run({"evaluate", "--help"}).out;
  for (const std::string& name : not_empty(profile_names()))
    EXPECT_THAT(help, HasSubstr(name));
}

TEST(Profiles, AreListedPrintedAndWrittenButNotOver) {
  EXPECT_EQ(run({"profile"}).out,
            "rvr\nargos3\npseudo-reality\nthesis-robots\nepuck\nepuck-ideal\n"
            "epuck-pseudo-reality\n");
  EXPECT_THAT(run({"profile", "pseudo-reality"}).out, HasSubstr("jitter = 0.05"));
  EXPECT_EQ(json::parse(run({"profile", "--json"}).out)["profiles"].size(), 7U);
  const TemporaryFolder folder;
  const std::string file = (folder / "p.toml").string();
  EXPECT_EQ(run({"profile", "rvr", "-o", file}).code, 0);
  EXPECT_EQ(run({"profile", "rvr", "-o", file}).code, 2);
  EXPECT_THAT(run({"profile", "rvx"}).err, HasSubstr("did you mean \"rvr\"?"));
}

TEST(Profiles, OfAFileArePrintedWhole) {
  const TemporaryFolder folder;
  for (const std::string& name : not_empty(profile_names())) {
    const std::filesystem::path mine = folder / "mine.toml";
    write_file(mine, "format = 1\nbase = \"" + name + "\"\ncontacts = \"box2d\"\n");
    const auto printed = parse_profile(run({"profile", mine.string()}).out, mine);
    const auto read = find_profile(mine.string(), "");
    ASSERT_TRUE(printed && read) << name;
    EXPECT_EQ(*printed, *read) << name;
    EXPECT_EQ(printed->contacts, ContactModel::Box2d);
  }
}

TEST(Evaluate, WritesARunDown) {
  const TemporaryFolder folder;
  write_file(folder / "best.fsm", kExploreText + "\n");
  const std::string svg = (folder / "run.svg").string();
  const Ran ran =
      run_well({"evaluate", (folder / "best.fsm").string(), "--flavour", "watermelon", "--mission",
                "aggregation", "--seeds", "7", "--csv", "-", "--svg", svg});
  EXPECT_THAT(ran.out, StartsWith("cycle,time_s,robot,x,y,theta,cmd_left,"));
  EXPECT_THAT(ran.err, HasSubstr("seed 7  score "));
  EXPECT_THAT(whole_file(svg), HasSubstr(">best.fsm \xc2\xb7 seed 7 \xc2\xb7 score "));
}

TEST(Evaluate, WritesOverAFileOfItsKindAlone) {
  const TemporaryFolder folder;
  const std::string svg = (folder / "run.svg").string();
  const std::string csv = (folder / "run.csv").string();
  const auto written = [](const std::string& option, const std::string& file) {
    return run({"evaluate", kStopText, "--flavour", "watermelon", "--mission", "aggregation",
                "--seeds", "7", option, file});
  };
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(written("--svg", svg).code, 0);
    EXPECT_EQ(written("--csv", csv).code, 0);
  }
  const Ran picture = written("--svg", csv);
  EXPECT_EQ(picture.code, 2);
  EXPECT_THAT(picture.err, HasSubstr("is a table (CSV), not an SVG picture"));
  EXPECT_THAT(written("--csv", svg).err, HasSubstr("is an SVG picture, not a table (CSV)"));
}

struct Misuse {
  std::vector<std::string> words;
  const char* sentence;
};

TEST(Evaluate, ExplainsWhatIsWrongWithItsArguments) {
  const Misuse misuses[] = {
      {{kStopText}, "--mission: no mission given"},
      {{kStopText, "--mission", "gird"}, "--mission: there is no mission `gird`"},
      {{kStopText, "--mission", "aggregation", "--flavour", "melon"}, "--flavour: there is no"},
      {{kStopText, "--mission", "aggregation", "--profile", "x"}, "--profile: "},
      {{kStopText, "--mission", "aggregation", "--seeds", "3-1"}, "--seeds: seeds are written"},
      {{kStopText, "--mission", "aggregation", "--csv", "x"}, "name one machine and one seed"},
      {{kStopText, "--mission", "aggregation", "--at", "3"}, "add --svg FILE"},
      {{"--nstates 1 --s0 9", "--mission", "aggregation"}, "MACHINE, token"},
      {{"nothing.fsm", "--mission", "aggregation"}, "nothing.fsm: not a machine"},
      {{"c1", "--mission", "aggregation"}, "no store given"},
  };
  for (const Misuse& misuse : misuses) {
    std::vector<std::string> words = misuse.words;
    words.insert(words.begin(), "evaluate");
    if (!words[1].starts_with("c") && std::ranges::find(words, "--flavour") == words.end()) {
      words.insert(words.end(), {"--flavour", "watermelon"});
    }
    EXPECT_THAT(refusal(words), HasSubstr(misuse.sentence));
  }
}

using EvaluateFromStore = WithStore;

TEST_F(EvaluateFromStore, TakesFlavourProfileAndMissionFromTheCandidatesCampaign) {
  const Ran ran = run_well({"evaluate", "c1", "--store", store_, "--seeds", "1-2", "--json"});
  EXPECT_EQ(lines_of(ran.out)[1]["score"], score_of("aggregation", 2));
}

TEST_F(EvaluateFromStore, StoresTheScoreAndKnowsItAgain) {
  const std::string before = (*StoreReader::open(store_))->digest();
  const std::vector<std::string> words = {"evaluate", "c1", "--store", store_,
                                          "--seeds",  "2",  "--json"};
  const json first = lines_of(run(words).out).at(0);
  EXPECT_EQ(first, (json{{"design", "d1"},
                         {"candidate", "c1"},
                         {"source", "rvr"},
                         {"seed", 2},
                         {"score", score_of("aggregation", 2)},
                         {"id", "e100001s"},
                         {"stored", "new"}}));
  EXPECT_EQ(lines_of(run(words).out).at(0)["stored"], "known");
  // Another candidate of the design gets the same pair.
  EXPECT_EQ(lines_of(run({"evaluate", "c2", "--store", store_, "--seeds", "2", "--json"}).out)
                .at(0)["id"],
            "e200001s");
  EXPECT_EQ((*StoreReader::open(store_))->digest(), before);
}

TEST_F(EvaluateFromStore, TakesASeedThatNoRaceAndNoTestHadAlwaysTheSame) {
  const auto seed = [&] {
    return lines_of(run({"evaluate", "best", "--store", store_, "--json"}).out).at(0)["seed"];
  };
  const json first = seed();
  EXPECT_NE(first, 77);
  EXPECT_NE(first, 99);
  EXPECT_EQ(seed(), first);
}

TEST_F(EvaluateFromStore, ShoutsWhenTheBitsDifferFromWhatIsStored) {
  {
    auto store = Store::open(store_, campaign_row(one_design_campaign()),
                             design_rows(one_design_campaign()));
    (*store)->append(
        {PairRow{.design = {1}, .purpose = Purpose::Score, .number = 1, .instance = 1, .seed = 2},
         EvaluationRow{.key = {{1}, Purpose::Score, 1},
                       .measured = {.score = 77, .state_digest = 5},
                       .source = "rvr"}});
  }
  const Ran ran = run({"evaluate", "c1", "--store", store_, "--seeds", "2"});
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.err, HasSubstr("e100001s: seed 2 gives score"));
  EXPECT_THAT(run({"query", store_, "SELECT conflicts FROM v_campaign_status", "--csv"}).out,
              HasSubstr("1"));
}

TEST_F(EvaluateFromStore, SimulatesNothingForWhichTheDesignHasNoPair) {
  {
    auto store = Store::open(store_, campaign_row(one_design_campaign()),
                             design_rows(one_design_campaign()));
    constexpr std::int64_t kLast = kPairsPerCandidate - 2;
    (*store)->append(
        {PairRow{
             .design = {1}, .purpose = Purpose::Score, .number = kLast, .instance = 1, .seed = 2},
         EvaluationRow{.key = {{1}, Purpose::Score, kLast},
                       .measured = {.score = score_of("aggregation", 2)},
                       .source = "rvr"}});
  }
  const Ran ran = run({"evaluate", "c1", "--store", store_, "--seeds", "2-4"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_EQ(ran.out, "");
  EXPECT_THAT(ran.err, HasSubstr("d1 would have scores on 100000 pairs (of source, instance and "
                                 "seed); a design can have at most 99999: give fewer seeds, or add "
                                 "--no-store to print the scores only"));
  const std::vector<std::string> count{
      "query", store_, "SELECT count(*) AS n FROM v_evaluations WHERE purpose = 'score'", "--csv"};
  EXPECT_EQ(run(count).out, "n\n1\n");
  EXPECT_EQ(run({"evaluate", "c1", "--store", store_, "--seeds", "2-3"}).code, 0);
  EXPECT_EQ(run({"evaluate", "c2", "--store", store_, "--seeds", "2-3"}).code, 0);
  EXPECT_EQ(run(count).out, "n\n4\n");
}

TEST_F(EvaluateFromStore, StoresNothingThatIsNoScoreOfTheDesign) {
  const Misuse misuses[] = {
      {{"--mission", "grid_exploration"}, "the design is one for the mission aggregation"},
      {{"--flavour", "watermelon-argos3"}, "the design's machines are of the flavour watermelon"},
      {{"--campaign", store_}, "the candidate has a campaign of its own"},
      {{"--starts", "x.csv"}, "a stored score follows from its seed"},
  };
  for (const Misuse& misuse : misuses) {
    std::vector<std::string> words = {"evaluate", "c1", "--store", store_, "--seeds", "2"};
    words.insert(words.end(), misuse.words.begin(), misuse.words.end());
    EXPECT_THAT(refusal(words), AllOf(HasSubstr(misuse.sentence), HasSubstr("--no-store")));
  }
  EXPECT_EQ(run({"evaluate", "c1", "--store", store_, "--seeds", "2", "--no-store"}).code, 0);
  EXPECT_EQ(run({"evaluate", "best", "--design", "d2", "--store", store_}).code, 4);
  EXPECT_EQ(run({"query", store_, "SELECT count(*) AS n FROM v_evaluations WHERE purpose = 'score'",
                 "--csv"})
                .out,
            "n\n0\n");
}

TEST_F(EvaluateFromStore, StaysOutWhileACampaignWrites) {
  const auto writer =
      Store::open(store_, campaign_row(one_design_campaign()), design_rows(one_design_campaign()));
  const Ran ran = run({"evaluate", "best", "--store", store_});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, HasSubstr("--no-store"));
  EXPECT_EQ(run({"evaluate", "best", "--store", store_, "--no-store"}).code, 0);
}

/// Final score of kExploreText where control cycles come too early.
double hasty_score(const Flavour& flavour, std::int64_t seed) {
  const Mission mission = *built_in_mission("grid_exploration");
  const Machine machine = *parse_machine(kExploreText, flavour);
  return simulate({.controller = machine,
                   .flavour = flavour,
                   .profile = *built_in_profile("pseudo-reality"),
                   .mission = mission,
                   .instance = *instance_of(mission, seed),
                   .seed = seed})
      .score;
}

TEST(EvaluateFromAStoreOfTimedTurns, TakesTheTurnClockOfTheCandidatesMethod) {
  const TemporaryFolder folder;
  const std::string store = (folder / "timed.db").string();
  Campaign campaign = one_design_campaign();
  campaign.methods[0].turn_clock = TurnClock::Seconds;
  write_store(store, campaign);
  const auto score = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {
        "evaluate",         "c1",        "--store",        store,     "--mission",
        "grid_exploration", "--profile", "pseudo-reality", "--seeds", "3",
        "--json",           "--no-store"};
    words.insert(words.end(), more.begin(), more.end());
    return lines_of(run(words).out).at(0)["score"].get<double>();
  };
  const Flavour timed = find_flavour("watermelon", TurnClock::Seconds).value();
  EXPECT_EQ(score({}), hasty_score(timed, 3));
  EXPECT_EQ(score({"--flavour", "watermelon"}), hasty_score(timed, 3));
  EXPECT_NE(score({}), hasty_score(watermelon(), 3));
  EXPECT_EQ(score({"--flavour", "watermelon-argos3"}), hasty_score(watermelon_argos3(), 3));
}

TEST_F(EvaluateFromStore, ExitsWithFourForACandidateThatIsNotThere) {
  EXPECT_EQ(run({"evaluate", "c99", "--store", store_}).code, 4);
  EXPECT_EQ(run({"evaluate", "c1", "--store", store_ + "x"}).code, 3);
}

TEST(MachineWords, LeaveOtherWordsAlone) {
  const std::vector<std::string> words = {"best.fsm", "--seeds", "1-3"};
  EXPECT_EQ(with_machine_as_one_word(words), words);
  EXPECT_THAT(with_machine_as_one_word({"--nstates", "1", "--s0", "1", "--seeds", "2", "--store"}),
              ElementsAre(" --nstates 1 --s0 1", "--seeds", "2", "--store"));
}

TEST(MachineWords, MayHaveTheSwitchesOfAnyFlavour) {
  EXPECT_THAT(
      with_machine_as_one_word({"--nstates", "2", "--s0", "8", "--vel0", "0.5", "--n0", "1",
                                "--n0x0", "0", "--c0x0", "3", "--msg0x0", "85", "--seeds", "1-3"}),
      ElementsAre(" --nstates 2 --s0 8 --vel0 0.5 --n0 1 --n0x0 0 --c0x0 3 --msg0x0 85", "--seeds",
                  "1-3"));
}

TEST(Seeds, AreRangesAndLists) {
  EXPECT_THAT(*parse_seeds("1,4,7-9"), ElementsAre(1, 4, 7, 8, 9));
  for (const char* wrong : {"", "0", "1-", "-3", "a", "2147483648", "1,,2", "1-99999999999"}) {
    EXPECT_FALSE(parse_seeds(wrong)) << wrong;
  }
  for (const char* twice : {"3,3,3", "1-4,3", "3,1-4"}) {
    const auto seeds = parse_seeds(twice);
    ASSERT_FALSE(seeds) << twice;
    EXPECT_EQ(to_string(seeds.error()), "--seeds: seed 3 occurs twice");
  }
}

}  // namespace
}  // namespace swarmsmith::cli
