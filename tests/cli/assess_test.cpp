#include <nlohmann/json.hpp>

#include "cli/commands/assessment_text.h"
#include "sim/files/profile_file.h"
#include "tests/cli/cli_support.h"
#include "tests/support/checks.h"

namespace swarmsmith::cli {
namespace {

using nlohmann::json;
using testing::ContainsRegex;

TEST(Assess, PrintsChecksRatesAndASummaryWithinAHundredColumns) {
  const Ran ran = run_well({"assess"});
  EXPECT_THAT(ran.out, ContainsRegex("\nexploration +gray arena +5  passes +[0-9]+ to [0-9]+ til"));
  EXPECT_THAT(ran.out, ContainsRegex("\nblack_floor +black spot, p = 0.3 +[0-9]+ +0\\.[0-9]+ +0"));
  EXPECT_THAT(ran.out,
              HasSubstr("\n11 of 11 modules pass: flavour watermelon, profile rvr, robot rvr\n"));
  std::istringstream lines(ran.out);
  for (std::string line; std::getline(lines, line);)
    EXPECT_LE(line.size(), 100U) << line;
}

TEST(Assess, ExitsWithOneWhenAModuleFailsAndSaysWhy) {
  const Ran ran = run({"assess", "--flavour", "watermelon-argos3", "--profile", "argos3"});
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.out, ContainsRegex("\nattraction +group, 0.5 to 0.7 m +5  FAILS"));
  EXPECT_THAT(ran.out, HasSubstr("\nattraction (group, 0.5 to 0.7 m) fails: "));
  EXPECT_THAT(ran.out, HasSubstr("\n10 of 11 modules pass"));
}

TEST(Assess, AnswersInJson) {
  const Ran ran = run_well({"assess", "--profile", "argos3", "--json"});
  const json report = json::parse(ran.out);
  EXPECT_EQ(report["flavour"], "watermelon");
  EXPECT_EQ(report["profile"], "argos3");
  EXPECT_EQ(report["robot"], "rvr");
  EXPECT_EQ(report["passed"], 11);
  ASSERT_EQ(report["modules"].size(), 11U);
  const json& exploration = report["modules"][0];
  EXPECT_EQ(exploration["module"], "exploration");
  EXPECT_EQ(exploration["passes"], true);
  EXPECT_EQ(exploration["checks"][0]["quantity"], "tiles_entered");
  EXPECT_EQ(exploration["checks"][0]["values"].size(), 5U);
  EXPECT_THAT(exploration["rates"], IsEmpty());
  const json& count = report["modules"][7]["rates"][1];
  EXPECT_EQ(count["setting"], "eta = 5, xi = 1, n = 1");
  EXPECT_EQ(count["expected"], 0.5);
  EXPECT_GT(count["measured"], count["low"]);
  EXPECT_LT(count["measured"], count["high"]);
}

// The flavour says which robot, the robot which profile.
TEST(Assess, TakesTheRobotThatTheFlavourFits) {
  const Ran ran = run_well({"assess", "--flavour", "chocolate-epuck"});
  EXPECT_THAT(ran.out, HasSubstr("\n12 of 12 modules pass: flavour chocolate-epuck, profile epuck, "
                                 "robot epuck\n"));
  const std::string turtlebot = SWARMSMITH_SOURCE_DIR "/examples/missions/robots/turtlebot4.toml";
  const Ran own = run({"assess", "--flavour", "chocolate", "--robot", turtlebot});
  EXPECT_THAT(own.out,
              HasSubstr(" modules pass: flavour chocolate, profile rvr, robot turtlebot4\n"));
  EXPECT_THAT(refusal({"assess", "--robot", "epuck"}),
              AllOf(HasSubstr("--flavour: the flavour `watermelon` takes distances"),
                    HasSubstr("; give another --flavour or --robot\n")));
}

TEST(Assess, RefusesWhatItDoesNotKnow) {
  EXPECT_THAT(refusal({"assess", "--flavour", "melon"}),
              HasSubstr("--flavour: there is no flavour `melon`; known are: "));
  EXPECT_THAT(refusal({"assess", "--profile", "mars"}), HasSubstr("--profile: "));
}

TEST(AssessmentText, MarksARateOutsideOfItsIntervalAndOneWithoutTrials) {
  assessment::Report report;
  report.modules.push_back(
      {.module = Module::BlackFloor,
       .checks = {{.setting = "black spot, p = 1", .runs = 10, .passes = true}},
       .rates = {{.setting = "far off",
                  .trials = 100,
                  .firings = 10,
                  .expected = 0.3,
                  .low = 0.05,
                  .high = 0.2},
                 {.setting = "never", .expected = 0.3}}});
  const Profile profile = *built_in_profile("rvr");
  const Robot robot = rvr();
  const assessment::Subject subject{watermelon(), profile, robot};
  const std::string text = assessment_text(report, subject);
  EXPECT_THAT(text, ContainsRegex("far off +100 +0.1000  0.0500 to 0.2000  0.3000 outside\n"));
  EXPECT_THAT(text, ContainsRegex("never +0 +-  - +0.3000\n"));
  const json rates = json::parse(assessment_json(report, subject))["modules"][0]["rates"];
  EXPECT_EQ(rates[0]["measured"], 0.1);
  EXPECT_TRUE(rates[1]["measured"].is_null());
}

}  // namespace
}  // namespace swarmsmith::cli
