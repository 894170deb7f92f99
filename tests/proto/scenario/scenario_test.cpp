#include "proto/scenario/scenario.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "base/text/toml_text.h"
#include "proto/key.h"
#include "proto/scenario.pb.h"
#include "sim/files/profile_file.h"
#include "tests/sim/every_noise.h"
#include "tests/sim/random_mission.h"
#include "tests/support/checks.h"
#include "tests/support/score_rules.h"

namespace swarmsmith {
namespace {

WorkerScenario some_scenario() {
  return {.campaign_digest = "0123456789abcdef0123456789abcdef",
          .engine_version = 3,
          .missions = {*built_in_mission("aggregation"), *built_in_mission("color_selection")},
          .methods = {{.flavour = "watermelon"}, {"watermelon-argos3", TurnClock::Seconds}},
          .profile = *built_in_profile("rvr")};
}

WorkerScenario with_programs() {
  WorkerScenario scenario{.campaign_digest = "d", .engine_version = 3};
  scenario.target = Target{.runner = "/r",
                           .launcher = "/l",
                           .command_line = "{seed}",
                           .evaluator = "/e",
                           .folder = "/f",
                           .retries = 2,
                           .timeout_s = 60,
                           .timeout_is_rejection = true,
                           .aclib = true,
                           .batch_mode = BatchMode::HtCondor,
                           .prints_time = true,
                           .min_measurable_time = 0.5,
                           .debug_level = 3};
  scenario.instances = {{{"a", "b c"}, {"t\xff"}}, {}};
  return scenario;
}

Expected<WorkerScenario> read_back(const WorkerScenario& scenario) {
  Expected<PoolScenario> scenarios = scenarios_from_bytes(to_bytes({scenario}));
  if (!scenarios) return Unexpected(scenarios.error());
  EXPECT_EQ(scenarios->size(), 1U);
  return scenarios->front();
}

/// What is said of a scenario with this text of missions and profile.
std::string complaint_about(const std::string& simulation) {
  pb::PoolScenario message;
  message.add_campaigns()->set_simulation(simulation);
  const auto read = scenarios_from_bytes(message.SerializeAsString());
  return read ? "" : to_string(read.error());
}

/// The text of a scenario.
std::string simulation_of(const WorkerScenario& scenario) {
  pb::PoolScenario message;
  EXPECT_TRUE(message.ParseFromString(to_bytes({scenario})));
  return message.campaigns(0).simulation();
}

TEST(Scenarios, GiveBackSeveralCampaignsAndNameTheFaultyOne) {
  WorkerScenario other = some_scenario();
  other.missions.pop_back();
  const PoolScenario both = {some_scenario(), other};
  EXPECT_EQ(scenarios_from_bytes(to_bytes(both)), both);
  other.missions[0].cycles = 0;
  EXPECT_THAT(scenarios_from_bytes(to_bytes({some_scenario(), other})).error().where,
              StartsWith("campaigns[1].simulation:"));
  EXPECT_EQ(why_not(scenarios_from_bytes("")),
            (Error{ErrorKind::BadInput, "scenarios of 0 campaigns; wanted 1 to 64", "campaigns"}));
  const PoolScenario most(kMaxCampaigns, with_programs());
  EXPECT_EQ(scenarios_from_bytes(to_bytes(most)), most);
  EXPECT_EQ(
      why_not(scenarios_from_bytes(to_bytes(PoolScenario(kMaxCampaigns + 1, with_programs())))),
      (Error{ErrorKind::BadInput, "scenarios of 65 campaigns; wanted 1 to 64", "campaigns"}));
}

TEST(Scenarios, GiveBackTheScenario) {
  WorkerScenario scenario = some_scenario();
  EXPECT_EQ(read_back(scenario), scenario);
  scenario.profile = every_noise();
  EXPECT_EQ(read_back(scenario), scenario);
  scenario.test_profiles = {*built_in_profile("pseudo-reality"), every_noise()};
  EXPECT_EQ(read_back(scenario), scenario);
}

TEST(Scenarios, RefuseAClockOfTurnsThatIsNotKnown) {
  pb::PoolScenario message;
  ASSERT_TRUE(message.ParseFromString(to_bytes({some_scenario()})));
  message.mutable_campaigns(0)->mutable_methods(1)->set_turn_clock(
      static_cast<pb::Method::TurnClock>(7));
  EXPECT_EQ(why_not(scenarios_from_bytes(message.SerializeAsString())),
            (Error{ErrorKind::BadInput, "a turn clock that this program does not know",
                   "methods[1].turn_clock"}));
}

TEST(Scenarios, GiveBackTheMethods) {
  EXPECT_EQ(read_back(some_scenario())->methods, some_scenario().methods);
}

TEST(Scenarios, HaveAFlavourThatIsNotBuiltInWhole) {
  Flavour mine = watermelon();
  mine.name = "mine";
  mine.speed_mps = 0.2;
  WorkerScenario scenario = some_scenario();
  const std::string before = to_bytes({scenario});
  scenario.methods.front() = {
      .flavour = mine.name, .turn_clock = TurnClock::Cycles, .own_flavour = kept_flavour(mine)};
  const auto read = value_of(read_back(scenario));
  EXPECT_EQ(read.methods, scenario.methods);
  EXPECT_EQ(*read.methods.front().own_flavour, mine);
  EXPECT_NE(to_bytes({scenario}), before);
  pb::PoolScenario message;
  ASSERT_TRUE(message.ParseFromString(to_bytes({scenario})));
  message.mutable_campaigns(0)->mutable_methods(0)->set_own_flavour("format = 1\nspeed_mps = -1\n");
  const auto wrong = scenarios_from_bytes(message.SerializeAsString());
  ASSERT_FALSE(wrong.has_value());
  EXPECT_THAT(to_string(wrong.error()), HasSubstr("methods[0].own_flavour: mine.toml:2:13"));
}

TEST(Scenarios, AreTheSameBytesForTheSameScenario) {
  EXPECT_EQ(to_bytes({some_scenario()}), to_bytes({some_scenario()}));
}

TEST(Scenarios, GiveBackMissionsWithEverythingBitForBit) {
  WorkerScenario scenario = some_scenario();
  scenario.missions.clear();
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
    scenario.missions.push_back(random_mission(seed));
  EXPECT_EQ(read_back(scenario), scenario);
}

TEST(Scenarios, GiveBackEveryKindOfScore) {
  WorkerScenario scenario = some_scenario();
  for (const ScoreRule& rule : rules_of_every_kind()) {
    scenario.missions[0].rule = rule;
    EXPECT_EQ(read_back(scenario), scenario) << kind_of(rule);
  }
  scenario.missions[0].rule = Coverage{.tiles = 7, .side_m = 1.0 / 3};
  EXPECT_EQ(read_back(scenario), scenario);
}

TEST(Scenarios, SayWhatIsWrongAndWhere) {
  EXPECT_EQ(why_not(scenarios_from_bytes("\xff\xff\xff")),
            (Error{ErrorKind::BadInput, "bytes that are not scenarios", ""}));
  const auto complaint = [](const std::function<void(WorkerScenario&)>& spoil) {
    WorkerScenario scenario = some_scenario();
    spoil(scenario);
    return complaint_about(simulation_of(scenario));
  };
  EXPECT_EQ(complaint([](WorkerScenario&) {}), "");
  const std::pair<const char*, std::function<void(WorkerScenario&)>> spoilt[] = {
      {"`duration`", [](auto& s) { s.missions[1].cycles = 0; }},
      {"`duration`", [](auto& s) { s.missions[1].cycles = 2'000'000; }},
      {"`robots`", [](auto& s) { s.missions[0].robots = 0; }},
      {"`diameter`", [](auto& s) { s.missions[0].robot.body.outline = CircleOutline{0}; }},
      {"a polygon has at least 3", [](auto& s) { s.missions[0].arena.walls.resize(2); }},
      {"`side`", [](auto& s) { s.missions[0].rule = Coverage{.side_m = std::nan("")}; }},
      {"`sd`", [](auto& s) { s.profile.proximity.sd_m = -1; }},
      {"`miss_rate`", [](auto& s) { s.profile.neighbours.miss_rate = std::nan(""); }},
      {"`delays`",
       [](auto& s) {
         s.profile.timing.delays = {{10, 0.5}};
       }},
      {"`period`", [](auto& s) { s.profile.timing.least_period = 2; }},
      {"`tag`", [](auto& s) { s.profile.tracking.tag.y = 7; }},
  };
  for (const auto& [key, spoil] : spoilt) {
    EXPECT_THAT(complaint(spoil), HasSubstr(key));
    EXPECT_THAT(complaint(spoil), StartsWith("simulation:"));
  }
}

TEST(Scenarios, MayNameNoFileOfTheWorker) {
  const std::string profile = text_of(profile_sections(*built_in_profile("rvr"), "profile"));
  const std::string mission = "[[mission]]\nname = \"aggregation\"\n";
  EXPECT_EQ(complaint_about(mission + profile), "");
  EXPECT_THAT(complaint_about("[[mission]]\nname = \"m\"\npreset = \"/etc/m.toml\"\n" + profile),
              HasSubstr("begins with a built-in one"));
  const std::string place = "x = 0, y = 0, width = 1, height = 1";
  EXPECT_THAT(complaint_about(mission + "[mission.arena]\nspots = [{ shape = \"image\", " + place +
                              ", file = \"/dev/zero\" }]\n" + profile),
              HasSubstr("an image needs its `data` here"));
}

TEST(Scenarios, RefuseTextsThatAreNoSimulation) {
  EXPECT_THAT(complaint_about(""), HasSubstr("mission"));
  const std::string mission = "[[mission]]\nname = \"aggregation\"\n";
  EXPECT_EQ(complaint_about(mission), "simulation:1:1: a simulation needs a [profile]");
  EXPECT_THAT(complaint_about("profile = 3\n" + mission), StartsWith("simulation:1:11: `profile`"));
  for (const std::string& text : {"more = 1\n" + simulation_of(some_scenario()),
                                  simulation_of(some_scenario()) + "more = 1\n"})
    EXPECT_THAT(complaint_about(text), HasSubstr("`more`"));
  EXPECT_THAT(complaint_about("a = " + std::string(100'000, '[')), HasSubstr("64 levels"));
  std::string many = "a = [0";
  for (int i = 0; i < 1'000'000; ++i)
    many += ",0";
  EXPECT_THAT(complaint_about(many + "]\n"), HasSubstr("more than 1000000 values"));
}

TEST(ScenariosOfPrograms, GiveBackThePrograms) {
  EXPECT_EQ(read_back(with_programs()), with_programs());
}

TEST(ScenariosOfPrograms, AreCheckedWhenTheyCome) {
  const auto complaint = [](const std::function<void(Target&)>& spoil) {
    WorkerScenario scenario = with_programs();
    spoil(*scenario.target);
    const auto read = read_back(scenario);
    return read ? "fine" : to_string(read.error());
  };
  const std::string longest(128 * 1024, 'x');
  constexpr std::int64_t kTenYears_s = std::int64_t{10} * 365 * 86'400;
  const double infinite = std::numeric_limits<double>::infinity();
  const std::function<void(Target&)> fine[] = {[](auto&) {},
                                               [](auto& t) { t.launcher.clear(); },
                                               [](auto& t) { t.batch_mode = BatchMode::None; },
                                               [](auto& t) {
                                                 t.batch_mode = BatchMode::None;
                                                 t.evaluator.clear();
                                               },
                                               [&](auto& t) { t.command_line = longest; },
                                               [&](auto& t) { t.runner = "/" + longest.substr(1); },
                                               [](auto& t) { t.retries = 0; },
                                               [](auto& t) { t.retries = 1'000'000; },
                                               [](auto& t) { t.timeout_s = 0; },
                                               [](auto& t) { t.timeout_s = kTenYears_s; },
                                               [](auto& t) { t.min_measurable_time = 0; },
                                               [](auto& t) { t.debug_level = 0; }};
  for (const auto& change : fine)
    EXPECT_EQ(complaint(change), "fine") << &change - fine;
  const std::string path = ": not an absolute path";
  const std::string number = ": a number outside of its limits";
  const std::string text = ": too long, or with a NUL byte";
  const std::pair<std::string, std::function<void(Target&)>> faulty[] = {
      {"runner" + path, [](auto& t) { t.runner = "r"; }},
      {"runner" + path, [](auto& t) { t.runner.clear(); }},
      {"runner" + path, [&](auto& t) { t.runner = "/" + longest; }},
      {"launcher" + path, [](auto& t) { t.launcher = "l"; }},
      {"evaluator" + path, [](auto& t) { t.evaluator = "e"; }},
      {"folder" + path, [](auto& t) { t.folder = ""; }},
      {"folder" + path, [](auto& t) { t.folder += '\0'; }},
      {"command_line" + text, [](auto& t) { t.command_line += '\0'; }},
      {"command_line" + text, [&](auto& t) { t.command_line = longest + "x"; }},
      {"retries" + number, [](auto& t) { t.retries = -1; }},
      {"retries" + number, [](auto& t) { t.retries = 1'000'001; }},
      {"timeout_s" + number, [](auto& t) { t.timeout_s = -1; }},
      {"timeout_s" + number, [](auto& t) { t.timeout_s = kTenYears_s + 1; }},
      {"min_measurable_time" + number, [](auto& t) { t.min_measurable_time = std::nan(""); }},
      {"min_measurable_time" + number, [&](auto& t) { t.min_measurable_time = infinite; }},
      {"min_measurable_time" + number, [](auto& t) { t.min_measurable_time = -0.5; }},
      {"debug_level" + number, [](auto& t) { t.debug_level = -1; }},
      {"debug_level" + number, [](auto& t) { t.debug_level = 4; }},
      {"batch_mode: a batch system that this program does not know",
       [](auto& t) { t.batch_mode = static_cast<BatchMode>(9); }},
      {"evaluator: batch mode needs a targetEvaluator, which prints the costs",
       [](auto& t) { t.evaluator.clear(); }}};
  for (const auto& row : faulty)
    EXPECT_EQ(complaint(row.second), "target." + row.first);
  for (const bool test : {false, true}) {
    const auto with_instance = [&](const std::string& instance) {
      WorkerScenario scenario = with_programs();
      InstanceTexts& texts = scenario.instances[0];
      (test ? texts.test : texts.training)[0] = instance;
      const auto read = read_back(scenario);
      return read ? "fine" : to_string(read.error());
    };
    const std::string wrong = "instances: an instance that is too long, or has a NUL byte";
    EXPECT_EQ(with_instance(longest), "fine");
    EXPECT_EQ(with_instance(longest + "x"), wrong);
    EXPECT_EQ(with_instance(std::string("a\0", 2)), wrong);
  }
}

}  // namespace
}  // namespace swarmsmith
