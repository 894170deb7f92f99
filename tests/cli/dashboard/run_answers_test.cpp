#include "cli/dashboard/run_answers.h"

#include <cmath>

#include "sim/control/machine_text.h"
#include "sim/engine/simulate.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"
#include "storage/store_at_rest.h"
#include "tests/cli/dashboard/asking.h"
#include "tests/support/checks.h"
#include "tests/support/one_design.h"
#include "tests/support/synthetic_real_run.h"

namespace swarmsmith::cli {
namespace {

using nlohmann::json;

const std::string kTwoStatesText =
    "--nstates 2 --s0 0 --rwm0 10 --n0 1 --n0x0 0 --c0x0 0 --p0x0 0.5 --s1 1";
constexpr std::int64_t kSeed = 21;

/// A run of the demo's mission, as a recorder sees it.
Measured simulated(const std::string& text, std::int64_t seed, const Mission& mission,
                   const Recorder& recorder = {}) {
  const Machine machine = *parse_machine(text, watermelon());
  const Instance instance = *instance_of(mission, seed);
  return simulate({.controller = machine,
                   .flavour = watermelon(),
                   .profile = *built_in_profile("rvr"),
                   .mission = mission,
                   .instance = instance,
                   .seed = seed},
                  recorder);
}

const Mission& demo_mission() {
  static const Campaign kCampaign = one_design_campaign();
  return kCampaign.missions.front().mission;
}

class RunAnswersTest : public testing::Test {
 protected:
  /// c1 has a true score on one pair, and a wrong one on another.
  void SetUp() override {
    const Campaign campaign = one_design_campaign();
    auto store = value_of(Store::open(store_, campaign_row(campaign), design_rows(campaign)));
    const DesignId design{1};
    const CandidateId candidate = candidate_id(design, 1);
    const Measured truth = simulated(kTwoStatesText, kSeed, demo_mission());
    store->append(
        {IterationRow{.design = design, .number = 1, .of = 2, .budget = 100, .configurations = 1},
         CandidateRow{.id = candidate,
                      .iteration = 1,
                      .parent = {},
                      .parameters = "{}",
                      .machine = kTwoStatesText,
                      .modules = "{}",
                      .states = 2,
                      .transitions = 1},
         PairRow{
             .design = design, .purpose = Purpose::Race, .number = 1, .instance = 1, .seed = kSeed},
         PairRow{
             .design = design, .purpose = Purpose::Race, .number = 2, .instance = 1, .seed = 22},
         EvaluationRow{.key = {candidate, Purpose::Race, 1},
                       .iteration = 1,
                       .measured = {.score = truth.score, .state_digest = truth.state_digest},
                       .source = "rvr"},
         EvaluationRow{.key = {candidate, Purpose::Race, 2},
                       .iteration = 1,
                       .measured = {.score = 0.25, .state_digest = 1},
                       .source = "rvr"}});
    store->flush();
  }

  TemporaryFolder folder_;
  std::string store_ = (folder_ / "demo.db").string();
};

TEST_F(RunAnswersTest, ARunHasTheStoredBits) {
  const json run = Asking(store_).json("c1/runs/e100001/trajectory");
  EXPECT_EQ(run["same_bits"], true);
  EXPECT_EQ(run["score"], run["stored_score"]);
  EXPECT_EQ(run["digest"], run["stored_digest"]);
  EXPECT_EQ(run["candidate"], "c1");
  EXPECT_EQ(run["design"], "d1");
  EXPECT_EQ(run["seed"], kSeed);
  EXPECT_EQ(run["source"], "rvr");
  EXPECT_EQ(run["mission"], "aggregation");
  // The one without noise fits each robot.
  EXPECT_EQ(run["profiles"],
            json::array({"rvr", "argos3", "pseudo-reality", "thesis-robots", "epuck-ideal"}));
  EXPECT_EQ(Asking(store_).json("c1/runs/e100002/trajectory")["same_bits"], false);
}

TEST_F(RunAnswersTest, PosesStatesAndScoresAreThoseOfTheSimulator) {
  const json run = Asking(store_).json("c1/runs/e100001/trajectory");
  const int cycles = demo_mission().cycles;
  EXPECT_EQ(run["cycles"], cycles);
  EXPECT_EQ(run["score_at"].size(), static_cast<std::size_t>(cycles) + 1);
  EXPECT_TRUE(run["score_at"][0].is_null());
  EXPECT_EQ(run["score_at"].back(), run["score"]);
  EXPECT_EQ(run["behaviours"][0], "exploration");
  const auto state_at = [&](std::size_t robot, int cycle) {
    json state;
    for (const json& change : run["robots"][robot]["state"])
      if (change[0].get<int>() <= cycle) state = change[1];
    return state;
  };
  int compared = 0;
  simulated(kTwoStatesText, kSeed, demo_mission(), Recorder([&](const Snapshot& snapshot) {
              if (snapshot.cycle % 100 != 0) return;
              const auto cycle = static_cast<std::size_t>(snapshot.cycle);
              for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
                const json& robot = run["robots"][i];
                EXPECT_EQ(robot["x_mm"][cycle], std::llround(1000 * snapshot.robots[i].pose.x));
                EXPECT_EQ(robot["y_mm"][cycle], std::llround(1000 * snapshot.robots[i].pose.y));
                EXPECT_EQ(robot["theta_mrad"][cycle],
                          std::llround(1000 * snapshot.robots[i].pose.theta));
                EXPECT_EQ(state_at(i, snapshot.cycle), snapshot.robots[i].state);
                ++compared;
              }
            }));
  EXPECT_GT(compared, 30);
}

TEST_F(RunAnswersTest, TheArenaIsAllThatIsNeededToDrawIt) {
  const json run = Asking(store_).json("c1/runs/e100001/trajectory");
  EXPECT_EQ(run["arena"]["walls"].size(), 12U);
  EXPECT_EQ(run["arena"]["floor"].get<std::string>().size(), 7U);
  EXPECT_FALSE(run["arena"]["patches"].empty());
  for (const json& patch : run["arena"]["patches"]) {
    EXPECT_TRUE(patch.contains("corners") || patch.contains("radius_m")) << patch;
    EXPECT_EQ(patch["color"].get<std::string>().substr(0, 1), "#");
  }
  EXPECT_EQ(run["body"]["corners"].size(), 4U);
}

TEST_F(RunAnswersTest, TheTableHasTheBytesOfReplay) {
  const Asking asking(store_);
  EXPECT_EQ(asking.text("c1/runs/e100001/trajectory.csv"),
            run({"replay", "e100001", store_, "--csv", "-"}).out);
  EXPECT_EQ(asking.text("c1/runs/c1-7/trajectory.csv"),
            run({"replay", "c1", store_, "--seed", "7", "--csv", "-"}).out);
}

TEST_F(RunAnswersTest, ACandidateRunsOnAnySeed) {
  const Asking asking(store_);
  const json other = asking.json("c1/runs/c1-7/trajectory");
  const json told = json::parse(run({"replay", "c1", store_, "--seed", "7", "--json"}).out);
  EXPECT_EQ(other["score"], told["score"]);
  EXPECT_EQ(other["digest"], told["digest"]);
  EXPECT_TRUE(other["same_bits"].is_null());
  EXPECT_TRUE(other["evaluation"].is_null());
  const json known = asking.json("c1/runs/c1-21/trajectory");
  EXPECT_EQ(known["evaluation"], "e100001");
  EXPECT_EQ(known["same_bits"], true);
}

TEST_F(RunAnswersTest, ACandidateRunsUnderAnotherProfile) {
  const Asking asking(store_);
  const json own = asking.json("c1/runs/c1-21/trajectory");
  const json other = asking.json("c1/runs/c1-21@pseudo-reality/trajectory");
  EXPECT_EQ(other["source"], "pseudo-reality");
  EXPECT_NE(other["digest"], own["digest"]);
  EXPECT_TRUE(other["same_bits"].is_null());
  EXPECT_TRUE(other["evaluation"].is_null());
  // Its own profile by name is its own run.
  EXPECT_EQ(asking.json("c1/runs/c1-21@rvr/trajectory")["same_bits"], true);
  EXPECT_EQ(asking.error("c1/runs/c1-21@nowhere/trajectory"), "400 bad_input");
}

TEST_F(RunAnswersTest, ACandidateRunsUnderAProfileOfItsCampaign) {
  const std::filesystem::path profile = folder_ / "slow.toml";
  write_file(profile, "format = 1\nbase = \"rvr\"\n[proximity]\nrange = 0.2\n");
  const Campaign campaign = value_of(parse_campaign(
      "format = 1\n[campaign]\nname = \"two\"\n[[mission]]\nname = \"aggregation\"\n[[method]]\n"
      "name = \"watermelon\"\n[race]\nmax_experiments = 2_000\n[tests]\nprofiles = [\"rvr\", \"" +
          profile.string() + "\"]\n",
      (folder_ / "two.toml").string()));
  const std::string file = (folder_ / "two.db").string();
  write_store(file, campaign);
  const json run = Asking(file).json("c1/runs/c1-7@slow/trajectory");
  EXPECT_EQ(run["source"], "slow");
  EXPECT_TRUE(run["evaluation"].is_null());
}

TEST_F(RunAnswersTest, WhatIsNoRunIsSaidToBeNone) {
  const Asking asking(store_);
  for (const char* id : {"c1", "d1", "e", "c1-", "c1-x", "c1-0", "e100001-3", "c1-99999999999",
                         "..", "c1-7@", "e100001@rvr", "r1-0", "r1-x", "r1@rvr", "r1-2@rvr"})
    EXPECT_EQ(asking.error(std::string("c1/runs/") + id + "/trajectory"), "400 bad_input") << id;
  EXPECT_EQ(asking.error("c1/runs/e100077/trajectory"), "404 not_found");
  EXPECT_EQ(asking.error("c1/runs/c77-1/trajectory"), "404 not_found");
  EXPECT_EQ(asking.error("c1/runs/r7/trajectory"), "404 not_found");
}

TEST_F(RunAnswersTest, ARealRunIsShownAsItWasMeasured) {
  MissionEntry entry{.mission = demo_mission()};
  entry.mission.cycles = 100;
  RealRunRows rows = synthetic_real_run(1, candidate_id(DesignId{1}, 1));
  rows.mission = entry.mission.name;
  rows.mission_file = mission_text(entry);
  rows.patches.clear();
  rows.cycles.clear();
  rows.robots.push_back({.robot = 2, .name = "<b>rvr3</b>", .tag = 3});
  std::vector<Pose> last;
  const Measured result =
      simulated(kTwoStatesText, 5, entry.mission, Recorder([&](const Snapshot& snapshot) {
                  last.clear();
                  for (std::size_t robot = 0; robot < snapshot.robots.size(); ++robot) {
                    const Pose& pose = snapshot.robots[robot].pose;
                    last.push_back(pose);
                    rows.cycles.push_back({snapshot.cycle, static_cast<std::int64_t>(robot), pose.x,
                                           pose.y, pose.theta,
                                           snapshot.cycle == 7   ? 1
                                           : snapshot.cycle == 8 ? 3
                                                                 : 0});
                  }
                }));
  rows.score.score = result.score;
  {
    auto store = value_of(StoreAtRest::open(store_, StoreAtRest::IfMissing::Make));
    const auto added = store->add_real_run(rows);
    ASSERT_TRUE(added) << to_string(added.error());
  }
  const Asking asking(store_);
  const json run = asking.json("c1/runs/r1/trajectory");
  EXPECT_EQ(run["cycles"], 100);
  EXPECT_EQ(run["same_bits"], true);
  EXPECT_TRUE(run["seed"].is_null());
  EXPECT_EQ(run["robots"].size(), 3U);
  EXPECT_EQ(run["robots"][2]["name"], "<b>rvr3</b>");
  EXPECT_EQ(run["robots"][1]["x_mm"][100], std::llround(1000 * last[1].x));
  EXPECT_TRUE(run["robots"][0]["x_mm"][8].is_null());
  EXPECT_EQ(run["robots"][0]["kind"],
            json::parse(R"([[0,"measured"],[7,"interpolated"],[8,"missing"],[9,"measured"]])"));
  EXPECT_EQ(asking.text("c1/runs/r1/trajectory.csv"),
            cli::run({"replay", "r1", store_, "--csv", "-"}).out);
  // Beside it: its machine from the same starts, which the store knows nothing of.
  const json beside = asking.json("c1/runs/r1-5/trajectory");
  EXPECT_EQ(beside["seed"], 5);
  EXPECT_EQ(beside["source"], "rvr");
  EXPECT_EQ(beside["cycles"], 100);
  EXPECT_TRUE(beside["same_bits"].is_null());
  for (const std::size_t robot : {0U, 1U, 2U})
    EXPECT_EQ(beside["robots"][robot]["x_mm"][0], run["robots"][robot]["x_mm"][0]);
  // The film was made of that very run.
  EXPECT_EQ(beside["robots"][1]["x_mm"][100], run["robots"][1]["x_mm"][100]);
  EXPECT_NE(asking.json("c1/runs/r1-6/trajectory")["digest"], beside["digest"]);
  const json list = asking.json("c1/real-runs");
  EXPECT_EQ(list["id"][0], "r1");
  EXPECT_TRUE(list.contains("reasons"));
}

}  // namespace
}  // namespace swarmsmith::cli
