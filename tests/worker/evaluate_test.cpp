#include "worker/evaluate.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "proto/scenario/scenario.h"
#include "sim/control/machine_text.h"
#include "sim/engine/self_test.h"
#include "sim/engine/simulate.h"
#include "sim/files/profile_file.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

const char* const kMachine = "--nstates 1 --s0 0 --rwm0 20";

WorkerScenario short_aggregation() {
  WorkerScenario scenario{.campaign_digest = "d",
                          .engine_version = kEngineVersion,
                          .missions = {*built_in_mission("aggregation")},
                          .methods = {{.flavour = "watermelon"}},
                          .profile = *built_in_profile("rvr")};
  scenario.missions[0].cycles = 50;
  return scenario;
}

LeasedTask item(std::int64_t seed, const std::string& machine = kMachine) {
  LeasedTask it;
  it.key = 8;
  it.seed = seed;
  it.machine = machine;
  return it;
}

TEST(Evaluate, GivesWhatTheSimulatorGives) {
  const WorkerScenario scenario = short_aggregation();
  const auto evaluator = value_of(make_evaluators()(to_bytes({scenario})));
  const Machine machine = *parse_machine(kMachine, watermelon());
  for (std::int64_t seed = 1; seed <= 5; ++seed) {
    const Instance instance = *instance_of(scenario.missions[0], seed);
    const Measured wanted = simulate({.controller = machine,
                                      .flavour = watermelon(),
                                      .profile = scenario.profile,
                                      .mission = scenario.missions[0],
                                      .instance = instance,
                                      .seed = seed});
    const Result result = (evaluator)(item(seed));
    ASSERT_EQ(result.failure, "");
    EXPECT_EQ(measured_fields(result.measured), measured_fields(wanted));
  }
}

TEST(Evaluate, RunsAMethodWithItsTurnClock) {
  WorkerScenario scenario = short_aggregation();
  scenario.missions[0].cycles = 600;
  scenario.methods = {{.flavour = "watermelon"}, {"watermelon", TurnClock::Seconds}};
  scenario.profile = *built_in_profile("pseudo-reality");  // control periods below 0.1 s
  const std::string bytes = to_bytes({scenario});
  const auto evaluator = value_of(make_evaluators()(bytes));
  const Machine machine = *parse_machine(kMachine, watermelon());
  const Instance instance = *instance_of(scenario.missions[0], 1);
  for (const std::size_t method : {0U, 1U}) {
    const Flavour flavour =
        *find_flavour("watermelon", method == 0 ? TurnClock::Cycles : TurnClock::Seconds);
    const Measured wanted = simulate({.controller = machine,
                                      .flavour = flavour,
                                      .profile = scenarios_from_bytes(bytes)->front().profile,
                                      .mission = scenario.missions[0],
                                      .instance = instance,
                                      .seed = 1});
    LeasedTask work = item(1);
    work.method = static_cast<std::uint32_t>(method);
    EXPECT_EQ((evaluator)(work).measured.state_digest, wanted.state_digest);
  }
}

TEST(Evaluate, RunsATestUnderTheProfileThatItNames) {
  WorkerScenario scenario = short_aggregation();
  scenario.test_profiles = {*built_in_profile("argos3"), *built_in_profile("pseudo-reality")};
  const auto evaluator = value_of(make_evaluators()(to_bytes({scenario})));
  const Machine machine = *parse_machine(kMachine, watermelon());
  const std::array profiles = {scenario.profile, scenario.test_profiles[0],
                               scenario.test_profiles[1]};
  for (std::uint32_t i = 0; i < profiles.size(); ++i) {
    const Measured wanted = simulate({.controller = machine,
                                      .flavour = watermelon(),
                                      .profile = profiles[i],
                                      .mission = scenario.missions[0],
                                      .instance = *instance_of(scenario.missions[0], 1),
                                      .seed = 1});
    LeasedTask work = item(1);
    work.profile = i;
    EXPECT_EQ((evaluator)(work).measured.state_digest, wanted.state_digest) << profiles[i].name;
  }
  LeasedTask unknown = item(1);
  unknown.profile = 3;
  EXPECT_EQ((evaluator)(unknown).failure, "a task for a profile that the scenario does not have");
}

/// Each campaign's own mission; one alone takes every item.
TEST(Evaluate, PassesEachItemToItsCampaign) {
  std::vector<WorkerScenario> scenarios = {short_aggregation(), short_aggregation()};
  scenarios[1].campaign_digest = "e";
  scenarios[1].missions[0].cycles = 80;
  const auto both = value_of(make_evaluators()(to_bytes(scenarios)));
  std::vector<std::uint64_t> digests;
  for (std::uint32_t campaign = 0; campaign < 2; ++campaign) {
    const auto alone = value_of(make_evaluators()(to_bytes({scenarios[campaign]})));
    LeasedTask work = item(1);
    work.key = pack(1, 0, 0, campaign);
    const Result result = (both)(work);
    const Result wanted = (alone)(work);
    EXPECT_EQ(result.failure, "");
    EXPECT_EQ(measured_fields(result.measured), measured_fields(wanted.measured));
    digests.push_back(result.measured.state_digest);
  }
  EXPECT_NE(digests[0], digests[1]);
  LeasedTask unknown = item(1);
  unknown.key = pack(1, 0, 0, 2);
  EXPECT_EQ((both)(unknown).failure, "no such campaign in the scenario");
}

TEST(Evaluate, FailsWithASentence) {
  const auto evaluator = value_of(make_evaluators()(to_bytes({short_aggregation()})));
  EXPECT_NE((evaluator)(item(1, "--nstates nonsense")).failure, "");
  // The first number that the scenario does not have, and one far beyond.
  for (const std::uint32_t number : {1U, 5U}) {
    LeasedTask of_mission = item(1);
    of_mission.mission = number;
    LeasedTask of_method = item(1);
    of_method.method = number;
    LeasedTask of_profile = item(1);
    of_profile.profile = number;
    for (const LeasedTask& strange : {of_mission, of_method}) {
      EXPECT_EQ((evaluator)(strange).failure,
                "a task for a mission or method that the scenario does not have");
    }
    EXPECT_EQ((evaluator)(of_profile).failure,
              "a task for a profile that the scenario does not have");
  }
}

TEST(Evaluate, RefusesScenariosThatItCannotRun) {
  EXPECT_FALSE(make_evaluators()("rubbish"));
  WorkerScenario scenario = short_aggregation();
  scenario.methods = {{.flavour = "vinegar"}};
  EXPECT_FALSE(make_evaluators()(to_bytes({scenario})));
  scenario = short_aggregation();
  for (const int other : {-1, 1}) {
    scenario.engine_version = kEngineVersion + other;
    EXPECT_EQ(why_not(make_evaluators()(to_bytes({scenario}))).message,
              "the campaign needs version " + std::to_string(kEngineVersion + other) +
                  " of the simulator, this program has version " + std::to_string(kEngineVersion));
  }
}

TEST(Evaluate, TheSelfTestRuns) {
  EXPECT_EQ(self_test_digest().size(), 32U);
  EXPECT_EQ(self_test_digest(), self_test_digest());
}

}  // namespace
}  // namespace swarmsmith
