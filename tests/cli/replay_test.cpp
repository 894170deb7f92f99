#include <nlohmann/json.hpp>

#include "cli/arguments/thing_id.h"
#include "sim/control/machine_text.h"
#include "sim/engine/simulate.h"
#include "sim/files/profile_file.h"
#include "sim/mission/trajectory_csv.h"
#include "tests/cli/cli_support.h"
#include "tests/support/checks.h"
#include "tests/support/one_design.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith::cli {
namespace {

using nlohmann::json;

/// A machine whose robots turn up in several states.
const std::string kTwoStatesText =
    "--nstates 2 --s0 0 --rwm0 10 --n0 1 --n0x0 0 --c0x0 0 --p0x0 0.5 --s1 1";

Measured result_of(const std::string& machine_text, std::int64_t seed) {
  const CampaignMission mission = one_design_campaign().missions.front();
  const Machine machine = *parse_machine(machine_text, watermelon());
  const Instance instance = *instance_of(mission.mission, seed);
  return simulate({.controller = machine,
                   .flavour = watermelon(),
                   .profile = *built_in_profile("rvr"),
                   .mission = mission.mission,
                   .instance = instance,
                   .seed = seed});
}

/// A store whose candidate c1 has true results on seeds 21 to 25 (race) and 99 (test), a rejected
/// evaluation (e100006), a filmed one (e100001s), one without a pair (e100007), and one that was
/// changed by hand (e100001a). `campaign` may be changed before it is written.
void write_true_store(const std::filesystem::path& file, const CampaignRow& campaign) {
  auto store = value_of(Store::open(file, campaign, design_rows(one_design_campaign())));
  const DesignId design{1};
  const CandidateId candidate = candidate_id(design, 1);
  std::vector<Row> rows = {
      IterationRow{.design = design, .number = 1, .of = 2, .budget = 100, .configurations = 2},
      CandidateRow{.id = candidate,
                   .iteration = 1,
                   .parent = {},
                   .parameters = "{}",
                   .machine = kTwoStatesText,
                   .modules = "{}",
                   .states = 2,
                   .transitions = 1}};
  const auto add = [&](Purpose purpose, std::int64_t pair, std::int64_t seed,
                       const EvaluationRow& row) {
    if (seed > 0) {
      rows.emplace_back(PairRow{
          .design = design, .purpose = purpose, .number = pair, .instance = pair, .seed = seed});
    }
    EvaluationRow complete = row;
    complete.key = {candidate, purpose, pair};
    if (complete.source.empty()) complete.source = "rvr";
    rows.emplace_back(complete);
  };
  for (std::int64_t pair = 1; pair <= 5; ++pair) {
    const Measured result = result_of(kTwoStatesText, 20 + pair);
    add(Purpose::Race, pair, 20 + pair,
        {.iteration = 1, .measured = {.score = result.score, .state_digest = result.state_digest}});
  }
  add(Purpose::Race, 6, 26, {.iteration = 1, .status = EvaluationStatus::Rejected});
  add(Purpose::Race, 7, 0, {.iteration = 1, .measured = {.score = 1}});
  const Measured test = result_of(kTwoStatesText, 99);
  add(Purpose::Test, 1, 99, {.measured = {.score = test.score, .state_digest = test.state_digest}});
  add(Purpose::Audit, 1, 99,
      {.measured = {.score = test.score, .state_digest = test.state_digest + 1}});
  add(Purpose::Score, 1, 3, {.measured = {.score = 2}, .source = "real"});
  store->append(std::move(rows));
  store->flush();
}

class Replay : public testing::Test {
 protected:
  void SetUp() override { write_true_store(store_, campaign_row(one_design_campaign())); }

  TemporaryFolder folder_;
  std::string store_ = (folder_ / "demo.db").string();
};

TEST_F(Replay, FindsTheSameBits) {
  const Measured wanted = result_of(kTwoStatesText, 22);
  const Ran ran = run_well({"replay", "e100002", store_});
  EXPECT_THAT(ran.out, StartsWith("e100002: same bits as stored: score "));
  const json found = json::parse(run({"replay", "e100002", store_, "--json"}).out);
  EXPECT_EQ(found["id"], "e100002");
  EXPECT_EQ(found["candidate"], "c1");
  EXPECT_EQ(found["seed"], 22);
  EXPECT_EQ(found["score"], wanted.score);
  EXPECT_EQ(found["stored_score"], wanted.score);
  EXPECT_EQ(found["same_bits"], true);
  EXPECT_EQ(found["digest"], found["stored_digest"]);
  EXPECT_EQ(found["engine"], kEngineVersion);
  EXPECT_EQ(run({"replay", "e100001t", store_}).code, 0);
}

TEST_F(Replay, ADifferenceIsAnErrorThatShowsBoth) {
  const Ran ran = run({"replay", "e100001a", store_});
  EXPECT_EQ(ran.code, 1);
  EXPECT_EQ(ran.out, "");
  EXPECT_THAT(ran.err, HasSubstr("e100001a: the replay gives score "));
  EXPECT_THAT(ran.err, HasSubstr("; the store holds score "));
  EXPECT_THAT(ran.err, Not(HasSubstr("version")));
  const Ran as_json = run({"replay", "e100001a", store_, "--json"});
  EXPECT_EQ(as_json.code, 1);
  const json found = json::parse(as_json.out);
  EXPECT_EQ(found["same_bits"], false);
  EXPECT_EQ(found["score"], found["stored_score"]);
  EXPECT_NE(found["digest"], found["stored_digest"]);
}

TEST_F(Replay, ExplainsADifferenceOfAnotherEngine) {
  CampaignRow campaign = campaign_row(one_design_campaign());
  const std::string ours = "\"engine.version\":\"" + std::to_string(kEngineVersion) + "\"";
  const std::size_t at = campaign.deciding.find(ours);
  ASSERT_NE(at, std::string::npos);
  campaign.deciding.replace(at, ours.size(), "\"engine.version\":\"1\"");
  const std::string older = (folder_ / "older.db").string();
  write_true_store(older, campaign);
  const Ran ran = run({"replay", "e100001a", older});
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.err, HasSubstr("the store's scores are of version 1 of the engine, this program "
                                 "has version " +
                                 std::to_string(kEngineVersion)));
  EXPECT_EQ(run({"replay", "e100001", older}).code, 0);
}

TEST_F(Replay, TakesACandidateWithASeedAndComparesWhatIsStoredOfIt) {
  const json stored = json::parse(run({"replay", "c1", store_, "--seed", "23", "--json"}).out);
  EXPECT_EQ(stored["id"], "e100003");
  EXPECT_EQ(stored["same_bits"], true);
  const Ran ran = run_well({"replay", "c1", store_, "--seed", "5"});
  EXPECT_THAT(ran.out, StartsWith("c1, seed 5: score "));
  EXPECT_THAT(ran.out, HasSubstr("no such evaluation to compare with"));
  const json fresh = json::parse(run({"replay", "c1", store_, "--seed", "5", "--json"}).out);
  EXPECT_EQ(fresh["id"], nullptr);
  EXPECT_EQ(fresh["same_bits"], nullptr);
  EXPECT_EQ(fresh["score"], result_of(kTwoStatesText, 5).score);
}

TEST_F(Replay, TellsWhatCannotBeCompared) {
  const Ran rejected = run_well({"replay", "e100006", store_});
  EXPECT_THAT(rejected.out, HasSubstr("it was rejected"));
  EXPECT_THAT(refusal({"replay", "e100001s", store_}),
              HasSubstr("e100001s: it was filmed, not simulated"));
  EXPECT_THAT(refusal({"replay", "e100007", store_}),
              HasSubstr("e100007: the store does not say on which seed"));
}

TEST_F(Replay, OfASampleCountsTheDifferences) {
  const Ran ran = run({"replay", "--sample", "100", store_, "--json"});
  EXPECT_EQ(ran.code, 1);
  EXPECT_EQ(json::parse(ran.out),
            json::parse(R"({"replayed":7,"same_bits":6,"different":["e100001a"]})"));
  EXPECT_THAT(ran.err, HasSubstr("e100001a: the replay gives"));
  // Ordered by candidate, purpose and pair, the third, fifth and seventh: two of the race, the
  // test.
  const Ran three = run_well({"replay", "--sample", "3", "--store", store_});
  EXPECT_EQ(three.out, "3 evaluations replayed, 3 with the same bits as stored\n");
}

TEST_F(Replay, WritesATableThatGivesTheScoreAgain) {
  const std::string file = (folder_ / "run.csv").string();
  for (const std::int64_t seed : {21, 22, 99}) {
    run_well({"replay", "c1", store_, "--seed", std::to_string(seed), "--csv", file});
    const auto read = value_of(parse_trajectory_csv(whole_file(file)));
    const Mission mission = one_design_campaign().missions.front().mission;
    const Instance instance = *instance_of(mission, seed);
    EXPECT_EQ(read.starts, instance.starts);
    EXPECT_EQ(read.trajectory.instants(), mission.cycles);
    EXPECT_EQ(score_of(mission, instance, read.trajectory), result_of(kTwoStatesText, seed).score);
  }
}

TEST_F(Replay, WritesCommandsStatesAndReadingsToStandardOutput) {
  const Ran ran =
      run_well({"replay", "e100001", store_, "--csv", "-", "--readings", "ground_color"});
  EXPECT_THAT(ran.out, StartsWith("cycle,time_s,robot,x,y,theta,cmd_left,cmd_right,state,behaviour,"
                                  "leds,ground_r,ground_g,ground_b\n0,0,0,"));
  EXPECT_THAT(
      ran.out,
      HasSubstr(",0,0,0,exploration,#000000 #000000 #000000 #000000 #000000,,,\n"));  // before the
                                                                                      // first cycle
  EXPECT_THAT(ran.out, HasSubstr("\n1200,120,2,"));
  EXPECT_THAT(ran.out, HasSubstr(",1,stop,"));
  EXPECT_THAT(ran.err, StartsWith("e100001: same bits as stored"));
}

TEST_F(Replay, IsNotChangedByWritingItDown) {
  const std::string file = (folder_ / "run.csv").string();
  for (const char* id : {"e100001", "e100004"}) {
    const Ran ran =
        run_well({"replay", id, store_, "--csv", file, "--readings", "all,lidar", "--json"});
    EXPECT_EQ(json::parse(ran.out)["same_bits"], true);
  }
}

/// The outline that is filled with the first robot's colour.
std::string body_of_robot_0(const std::string& svg) {
  const std::size_t fill = svg.find("\" fill=\"#0072b2\" stroke=\"#ffffff\"");
  if (fill == std::string::npos) return "no body of robot 0";
  const std::size_t begin = svg.rfind("d=\"M", fill);
  return svg.substr(begin, fill - begin);
}

TEST_F(Replay, DrawsTheRunOrAPartOfIt) {
  // Wide enough for all to be said in one line, so that all have the same scale.
  const auto draw = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"replay", "e100001", store_, "--svg", "-", "--width", "10cm"});
    return run(words);
  };
  const Ran whole = draw({});
  ASSERT_EQ(whole.code, 0) << whole.err;
  EXPECT_THAT(whole.out, StartsWith("<svg "));
  EXPECT_THAT(whole.out, HasSubstr("width=\"100mm\""));
  EXPECT_THAT(whole.out, HasSubstr(">aggregation</text>"));
  EXPECT_THAT(whole.out, HasSubstr("c1 \xc2\xb7 seed 21 \xc2\xb7 score "));
  EXPECT_THAT(whole.out, HasSubstr("0 s (hollow) to 120 s"));
  EXPECT_LT(whole.out.size(), 200'000U);
  const Ran part = draw({"--from", "118", "--to", "119.5 s"});
  EXPECT_THAT(part.out, HasSubstr("118 s (hollow) to 119.5 s"));
  const Ran instant = draw({"--at", "0"});
  EXPECT_THAT(instant.out, HasSubstr("at 0 s"));
  EXPECT_THAT(instant.out, HasSubstr(">0 exploration</text>"));
  // Where robot 0 starts is in the whole run's picture and not in that of the last seconds; where
  // it is at 119.5 s is in theirs.
  EXPECT_THAT(whole.out, HasSubstr(body_of_robot_0(instant.out)));
  EXPECT_THAT(part.out, Not(HasSubstr(body_of_robot_0(instant.out))));
  const Ran end = draw({"--at", "119.5"});
  EXPECT_THAT(part.out, HasSubstr(body_of_robot_0(end.out)));
}

struct Misuse {
  std::vector<std::string> words;
  const char* sentence;
  int code = 2;
};

TEST_F(Replay, ExplainsWhatIsWrongWithItsArguments) {
  const Misuse misuses[] = {
      {{}, "ID: is required"},
      {{"best"}, "ID: \"best\" is not an evaluation (e81200007"},
      {{"d1"}, "is not an evaluation"},
      {{"c1"}, "c1: no seed given; add one, such as --seed 7"},
      {{"e100001", "--seed", "3"}, "--seed: an evaluation has its own seed"},
      {{"c99", "--seed", "3"}, "the store has no candidate c99", 4},
      {{"e100009"}, "the store has no evaluation e100009", 4},
      {{"e100001", "--csv", "-", "--json"}, "only one of --csv -"},
      {{"e100001", "--csv", "-", "--svg", "-"}, "only one of --csv -"},
      {{"e100001", "--csv", "x", "--objects-csv", "./x"},
       "--objects-csv: names the same file as --csv: ./x; give each its own file"},
      {{"e100001", "--csv", "x", "--svg", "gone/../x"}, "--svg: names the same file as --csv"},
      {{"e100001", "--at", "3"}, "add --svg FILE"},
      {{"e100001", "--readings", "all"}, "--readings: needs --csv FILE"},
      {{"e100001", "--csv", "x", "--readings", "al"}, "--readings: there is no sensor `al`"},
      {{"e100001", "--svg", "x", "--at", "121"}, "--at: must be seconds from 0 to 120"},
      {{"e100001", "--svg", "x", "--at", "nan"}, "--at: must be seconds from 0 to 120"},
      {{"e100001", "--svg", "x", "--at", "1", "--to", "2"}, "--at: draws one instant"},
      {{"e100001", "--svg", "x", "--from", "3", "--to", "2"}, "--to: the span ends before"},
      {{"e100001", "--svg", "x", "--width", "3mm"}, "--width: a picture is 40mm to 1000mm"},
      {{"e100001", "--svg", "/nowhere/x.svg"},
       "/nowhere/x.svg: cannot be written: there is no folder /nowhere",
       1},
      {{"--sample", "2", "--csv", "x"}, "--sample: replays many evaluations"},
      {{"e100001", "other.db", "--sample", "2"}, "--sample: takes no ID"},
  };
  for (const Misuse& misuse : misuses) {
    std::vector<std::string> words = misuse.words;
    words.insert(words.begin(), "replay");
    words.insert(words.end(), {"--store", store_});
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, misuse.code) << misuse.sentence;
    EXPECT_EQ(ran.out, "") << misuse.sentence;
    EXPECT_THAT(ran.err, HasSubstr(misuse.sentence));
  }
  EXPECT_FALSE(std::filesystem::exists("x"));
  EXPECT_EQ(run({"replay", "e100001", store_ + ".gone"}).code, 3);
}

TEST_F(Replay, EmptiesNoOutputBeforeAllAreAllowed) {
  const std::string table = (folder_ / "run.csv").string();
  const std::string text = (folder_ / "notes.txt").string();
  std::ofstream(table) << "a,b\n1,2\n";
  std::ofstream(text) << "notes of a person\n";
  const Ran ran = run({"replay", "e100001", "--store", store_, "--csv", table, "--svg", text});
  EXPECT_EQ(ran.code, 2);
  EXPECT_THAT(ran.err, HasSubstr("notes.txt: already exists and is a text"));
  EXPECT_GT(std::filesystem::file_size(table), 0);
}

TEST(ThingId, IsALetterWithDigits) {
  EXPECT_EQ(parse_thing_id("e81200007t")->digits, "81200007");
  EXPECT_EQ(parse_thing_id("e81200007t")->purpose, "t");
  EXPECT_EQ(parse_thing_id("d3")->letter, 'd');
  EXPECT_EQ(parse_thing_id("r7")->letter, 'r');
  for (const char* wrong :
       {"", "e", "et", "c1t", "r1t", "x1", "e-1", "e1x", "1", "e1234567890123456789"})
    EXPECT_FALSE(parse_thing_id(wrong)) << wrong;
}

}  // namespace
}  // namespace swarmsmith::cli
