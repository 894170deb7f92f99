#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sim/control/machine_text.h"
#include "sim/engine/simulate.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"
#include "sim/mission/trajectory.h"
#include "storage/internal/sqlite.h"
#include "storage/store_at_rest.h"
#include "tests/cli/cli_support.h"
#include "tests/support/checks.h"
#include "tests/support/one_design.h"
#include "tests/support/synthetic_real_run.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith::cli {
namespace {

using nlohmann::json;

Mission demo() {
  return one_design_campaign().missions.front().mission;
}

/// A filmed run of the demo's winner that a simulator made up: its trajectory, and its score.
RealRunRows filmed(std::uint64_t number, CandidateId candidate, const Mission& mission = demo()) {
  MissionEntry entry{.mission = mission};
  entry.mission.cycles = 100;
  const Machine machine = *parse_machine(kExploreText, watermelon());
  const auto seed = static_cast<std::int64_t>(number);
  const Instance instance = *instance_of(entry.mission, seed);
  RealRunRows rows = synthetic_real_run(number, candidate);
  rows.mission = entry.mission.name;
  rows.mission_file = mission_text(entry);
  rows.patches.clear();
  rows.cycles.clear();
  rows.robots.push_back({.robot = 2, .name = "rvr3", .tag = 3});
  const Measured result =
      simulate({.controller = machine,
                .flavour = watermelon(),
                .profile = *built_in_profile("rvr"),
                .mission = entry.mission,
                .instance = instance,
                .seed = seed},
               Recorder([&](const Snapshot& snapshot) {
                 for (std::size_t robot = 0; robot < snapshot.robots.size(); ++robot) {
                   const Pose& pose = snapshot.robots[robot].pose;
                   rows.cycles.push_back({snapshot.cycle, static_cast<std::int64_t>(robot), pose.x,
                                          pose.y, pose.theta, snapshot.cycle == 7 ? 1 : 0});
                 }
               }));
  rows.score.score = result.score;
  return rows;
}

class RealRuns : public WithStore {
 protected:
  void SetUp() override {
    WithStore::SetUp();
    add(filmed(1, candidate_id({1}, 1)));
    add(filmed(2, {}));
  }
  void add(const RealRunRows& rows) {
    auto store = value_of(StoreAtRest::open(store_, StoreAtRest::IfMissing::Make));
    const auto written = store->add_real_run(rows);
    ASSERT_TRUE(written) << to_string(written.error());
  }
  void change(const std::string& sql) {
    sqlite::Connection connection(store_, SQLITE_OPEN_READWRITE);
    connection.execute(sql);
  }
  std::string file(const std::string& name) { return (folder_ / name).string(); }
  std::string content(const std::string& name) { return whole_file(file(name)); }
};

TEST_F(RealRuns, AreListedAndShown) {
  const Ran listed = run_well({"ls", "runs", store_});
  EXPECT_THAT(listed.out, HasSubstr("r1"));
  EXPECT_THAT(listed.out, HasSubstr("run02"));
  const Ran shown = run_well({"show", "r1", store_, "--json"});
  const json answer = json::parse(shown.out);
  EXPECT_EQ(answer["real run"]["id"], "r1");
  EXPECT_EQ(answer["real run"]["candidate"], "c1");
  EXPECT_EQ(answer["real run"]["counts"], 1);
  EXPECT_EQ(answer["robots"].size(), 3U);
  EXPECT_EQ(answer["calibrations"].size(), 6U);
  EXPECT_EQ(run({"show", "r9", store_}).code, 4);
  EXPECT_THAT(run({"show", "c1", store_}).out, HasSubstr("real"));
}

TEST_F(RealRuns, AreScoredAgainByVerify) {
  const Ran clean = run({"verify", store_, "--json"});
  EXPECT_EQ(json::parse(clean.out)["real_runs"], 2) << clean.out;
  EXPECT_THAT(clean.out, Not(HasSubstr("real run r")));
  // A robot that stood on the spot at the end is put elsewhere.
  change("UPDATE real_cycle SET x = 0, y = 0 WHERE run = 1 AND cycle = 100");
  change("UPDATE real_score SET score = 1 WHERE run = 1");
  EXPECT_THAT(run({"verify", store_}).out,
              HasSubstr("real run r1: its cycles score 3, but the store has 1"));
  change("DELETE FROM real_cycle WHERE run = 2 AND cycle = 50 AND robot = 1");
  const Ran broken = run({"verify", store_});
  EXPECT_EQ(broken.code, 3);
  EXPECT_THAT(broken.out, HasSubstr("real run r2"));
  EXPECT_THAT(broken.out, HasSubstr("cycles are missing"));
  EXPECT_THAT(broken.out, HasSubstr("the real run r2 lacks rows of its cycles"));
}

TEST_F(RealRuns, AreReplayedBesideSimulationsFromTheSameStarts) {
  const Ran replayed = run_well({"replay", "r1", store_, "--seeds", "1,5", "--svg", file("r.svg"),
                                 "--csv", file("r.csv"), "--json"});
  const json answer = json::parse(replayed.out);
  EXPECT_EQ(answer["same_bits"], true);
  EXPECT_EQ(answer["starts_as_real"], true);
  ASSERT_EQ(answer["beside"].size(), 2U);
  // The run was made by this machine on this seed.
  EXPECT_EQ(answer["beside"][0]["score"], answer["score"]);
  const std::string svg = content("r.svg");
  for (const char* word : {"r1 run01, 2026-11-21, c1", "rvr, seed 5", "rvr2", "VALID"})
    EXPECT_THAT(svg, HasSubstr(word));
  const std::string csv = content("r.csv");
  EXPECT_THAT(csv, StartsWith("run,source,seed,cycle,time_s,robot,x,y,theta,kind\n"));
  EXPECT_THAT(csv, HasSubstr("\nr1,real,,7,0.7,2,"));
  EXPECT_THAT(csv, HasSubstr(",interpolated\n"));
  EXPECT_THAT(csv, HasSubstr("\n,rvr,5,100,10,0,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3 * 101 * 3);
  EXPECT_EQ(run({"replay", "r1", store_, "--beside", "2", "--svg", file("again.svg")}).code, 0);
  EXPECT_NE(content("again.svg"), svg);
}

TEST_F(RealRuns, OfSmallRobotsAreReplayedFromStartsNearEachOther) {
  Mission mission = demo();
  mission.robot = rvr_with(CircleOutline{0.035});
  mission.placement = PlaceAt{{{0, 0, 0}, {0.1, 0, 1}, {0, 0.1, 2}}};
  add(filmed(3, candidate_id({1}, 1), mission));
  const json answer =
      json::parse(run_well({"replay", "r3", store_, "--beside", "1", "--json"}).out);
  EXPECT_EQ(answer["starts_as_real"], true);
}

TEST_F(RealRuns, AreReplayedAloneAndDrawnWithoutACandidate) {
  const Ran alone = run_well({"replay", "r2", store_, "--svg", file("r.svg")});
  EXPECT_THAT(alone.out, StartsWith("r2: same score as stored: "));
  EXPECT_THAT(refusal({"replay", "r2", store_, "--beside", "1"}), HasSubstr("names no candidate"));
}

TEST_F(RealRuns, SayWhatCannotBeMeant) {
  EXPECT_EQ(run({"replay", "r9", store_}).code, 4);
  EXPECT_EQ(run({"replay", "r1", store_, "--seed", "4"}).code, 2);
  EXPECT_EQ(run({"replay", "r1", store_, "--beside", "2", "--seeds", "3"}).code, 2);
  EXPECT_EQ(run({"replay", "c1", store_, "--beside", "2"}).code, 2);
  EXPECT_EQ(run({"replay", "r1", store_, "--at", "3", "--svg", "-"}).code, 2);
  EXPECT_EQ(run({"replay", "r1", store_, "--csv", "-", "--json"}).code, 2);
  change("UPDATE real_score SET score = score + 1");
  const Ran differs = run({"replay", "r1", store_});
  EXPECT_EQ(differs.code, 1);
  EXPECT_THAT(differs.err, HasSubstr("the store holds"));
}

TEST_F(RealRuns, AreAmongTheScoresOfTheirDesign) {
  const Ran compared = run_well({"compare", store_, "--by", "source", "--json"});
  EXPECT_THAT(compared.out, HasSubstr("\"source\":\"real\""));
  EXPECT_EQ(run({"figure", "box", store_, "-o", file("box.svg")}).code, 0);
  EXPECT_THAT(content("box.svg"), HasSubstr("real"));
}

TEST(RealRunsAlone, AreReadByAllCommands) {
  const TemporaryFolder folder;
  const std::string store = (folder / "real.db").string();
  {
    auto made = StoreAtRest::open(store, StoreAtRest::IfMissing::Make);
    ASSERT_TRUE((*made)->add_real_run(filmed(1, {})));
  }
  for (const char* command : {"ls", "show", "verify", "digest", "status", "query"}) {
    std::vector<std::string> words{command};
    if (words[0] == "ls") words.emplace_back("runs");
    if (words[0] == "show") words.emplace_back("r1");
    words.push_back(store);
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, 0) << command << ": " << ran.err;
  }
  EXPECT_EQ(run({"replay", "r1", store}).code, 0);
  EXPECT_EQ(run({"replay", "e100001", store}).code, 3);
  const Ran report = run({"report", store, "-o", (folder / "report.html").string()});
  EXPECT_LT(report.code, 5) << report.err;
  EXPECT_EQ(run({"backup", store, (folder / "copy.db").string()}).code, 0);
}

}  // namespace
}  // namespace swarmsmith::cli
