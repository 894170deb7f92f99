#include "tests/support/checks.h"
#include "tracking/rig/rig_file.h"

namespace swarmsmith {
namespace {

constexpr char kLog[] = R"(format = 1
name = "run07"
recorded = 2026-11-21
mission = "color_selection"
design = "d3"
source = "real"
start = "12.4 s"
[[video]]
camera = "ceiling"
file = "run07.mp4"
times = "run07.times.csv"
[[video]]
camera = "corner"
file = "corner.mp4"
ahead = "-20 ms"
[[patch]]
x = 0.3
y = 0
color = "green"
)";

std::vector<std::string> complaints_about(const std::string& text) {
  return complaints_of(parse_run_log(text, "run.toml"));
}

TEST(RunLogFile, SaysWhatAPersonKnowsOfARun) {
  const auto log = value_of(parse_run_log(kLog, "run.toml"));
  EXPECT_EQ(log.name, "run07");
  EXPECT_EQ(log.recorded, "2026-11-21");
  EXPECT_EQ(log.mission, *built_in_mission("color_selection"));
  EXPECT_EQ(log.design, "d3");
  EXPECT_EQ(log.start.time_s, 12.4);
  ASSERT_EQ(log.videos.size(), 2U);
  EXPECT_EQ(log.videos[0].times, "run07.times.csv");
  EXPECT_EQ(log.videos[1].clock_ahead_s, -0.02);
  EXPECT_EQ(log.layout.source, RunLayout::Source::Log);
  ASSERT_EQ(log.layout.patches.size(), 1U);
  EXPECT_EQ(log.layout.patches[0], (PatchPlacement{{0.3, 0}, {0, 255, 0}}));
}

TEST(RunLogFile, ReadsBackToTheSameBits) {
  RunLog log = *parse_run_log(kLog, "run.toml");
  log.start.time_s = 0.1 + 0.2;
  log.videos[1].clock_ahead_s = 1.0 / 3;
  log.points = {{.robot = "rvr2", .time_s = 43.2, .middle = {812.25, 455}, .who = "A. Person"},
                {.robot = "rvr1",
                 .camera = "east",
                 .time_s = 1.0 / 3,
                 .middle = {0.1, 7},
                 .heading_deg = -33.3,
                 .who = "B"}};
  log.notes = {{"rvr1", "run07.rvr1.log.csv", Verdict::Valid, {}},
               {"rvr2", "", Verdict::Invalid, {"proximity: silent for 1.2 s", "2 \"late\""}},
               {"rvr3", "logs/run07.rvr3.toml", std::nullopt, {}}};
  log.start.sync_tag = 99;
  log.start.sync = RunStart::Sync::Hidden;
  RunLog synced = log;
  synced.start = {std::nullopt, 99, RunStart::Sync::Shown};
  synced.robots = {"rvr1", "rvr \"3\""};
  synced.videos[0].length_s = 150.2;
  synced.design.clear();
  synced.candidate = "c812";
  synced.layout.source = RunLayout::Source::Measured;
  RunLog plain;
  plain.name = "plain";
  plain.recorded = "";
  for (const RunLog& one : {log, synced, plain}) {
    const std::string text = run_log_text(one);
    const auto again = parse_run_log(text, "run.toml");
    ASSERT_TRUE(again) << to_string(again.error().front()) << text;
    EXPECT_EQ(*again, one) << text;
    EXPECT_EQ(run_log_text(*again), text);
  }
}

TEST(RunLogFile, HasTheNameOfItsFileWhenItSaysNone) {
  const auto log = value_of(parse_run_log("format = 1\n", "some/run08.toml"));
  EXPECT_EQ(log.name, "run08");
  EXPECT_EQ(log.mission.name, "");
}

/// Whatever the file system takes, a store must be able to read its log again.
TEST(RunLogFile, ANameFromAFileIsAlwaysAName) {
  const std::vector<std::pair<std::string, std::string>> names = {
      {"run07.mp4", "run07"},
      {"films/my run (2).mp4", "my_run_2_"},
      {"a\"b'c.mkv", "a_b_c"},
      {"a\nb.mkv", "a_b"},
      {"-x.mkv", "-x"},
      {"a\xff\xfe.mkv", "a_"},
      {"\xe8\xb5\xb0.mkv", "_"},
      {"pictures/", "pictures"},
      {"", "run"},
      {std::string(3000, 'x') + ".mkv", "run"},
  };
  for (const auto& [file, name] : names) {
    EXPECT_EQ(run_name_of(file), name) << file;
    RunLog log = value_of(parse_run_log("format = 1\n", file));
    EXPECT_EQ(log.name, name);
    EXPECT_EQ(value_of(parse_run_log(run_log_text(log), "x.toml")), log);
  }
}

TEST(RunLogFile, NamesEachMistakeByPlaceKeyAndWhatIsAllowed) {
  EXPECT_THAT(
      complaints_about(R"(format = 1
recorded = "yesterday"
mision = "aggregation"
design = "best"
source = "a b"
start = "nan s"
sync = { tag = -1, when = "gone" }
layout = "guessed"
[[video]]
file = ""
ahead = 3
[[video]]
file = "b.mp4"
[[patch]]
x = nan
y = 0
color = "gren"
)"),
      ElementsAre(
          AllOf(HasSubstr("run.toml:2:12: E_CONFIG: `recorded` must be a date")),
          AllOf(HasSubstr("run.toml:3:1: E_CONFIG: "), HasSubstr("did you mean \"mission\"?")),
          AllOf(HasSubstr("run.toml:4:10: E_CONFIG: `design`"), HasSubstr("\"best\"")),
          HasSubstr("run.toml:5:10: E_CONFIG: `source`"),
          AllOf(HasSubstr("run.toml:6:9: E_CONFIG: `start` must be from")),
          AllOf(HasSubstr("run.toml:7:16: E_CONFIG: `tag` must be from 0"), HasSubstr("-1")),
          AllOf(HasSubstr("E_CONFIG: `when` cannot be \"gone\""), HasSubstr("hidden, shown")),
          AllOf(HasSubstr("E_CONFIG: `layout` cannot be \"guessed\""), HasSubstr("measured")),
          HasSubstr("run.toml:9:1: E_CONFIG: several [[video]]: each needs a `camera`"),
          HasSubstr("E_CONFIG: [[video]] needs a `file`"),
          HasSubstr("E_CONFIG: `ahead` must be a text"),
          AllOf(HasSubstr("E_CONFIG: `x` must be from -100 to 100, not nan")),
          AllOf(HasSubstr("E_CONFIG: there is no colour \"gren\""), HasSubstr("green"))));
}

TEST(RunLogFile, HasANoteOfEachRobotAndACheckOfTheStart) {
  const auto log = value_of(parse_run_log(R"(format = 1
robots = ["rvr1", "rvr2"]
start = "12.4 s"
sync = { tag = 99, when = "hidden" }
[[robot]]
name = "rvr1"
log = "run07.rvr1.log.csv"
[[robot]]
name = "rvr2"
verdict = "DEGRADED"
reasons = ["1.5 % of the cycles were skipped"]
)",
                                          "run.toml"));
  EXPECT_EQ(log.start.time_s, 12.4);
  EXPECT_EQ(log.start.sync_tag, 99);
  EXPECT_THAT(
      log.notes,
      ElementsAre(RobotNote{"rvr1", "run07.rvr1.log.csv", std::nullopt, {}},
                  RobotNote{"rvr2", "", Verdict::Degraded, {"1.5 % of the cycles were skipped"}}));
  EXPECT_THAT(complaints_about("format = 1\n[[robot]]\nverdict = \"fine\"\nlogs = \"a\"\n"),
              testing::UnorderedElementsAre(HasSubstr("E_CONFIG: [[robot]] needs a `name`"),
                                            HasSubstr("E_CONFIG: `verdict` cannot be \"fine\""),
                                            HasSubstr("did you mean \"log\"?")));
  EXPECT_THAT(complaints_about("format = 1\n[[robot]]\nname = \"a\"\n[[robot]]\nname = \"a\"\n"),
              ElementsAre(HasSubstr("E_CONFIG: two [[robot]] are for robot \"a\"")));
}

TEST(RunLogFile, SaysWhichMissionsThereAre) {
  EXPECT_THAT(complaints_about("format = 1\nmission = \"agregation\"\n"),
              ElementsAre(AllOf(HasSubstr("run.toml:2:11: E_CONFIG: "),
                                HasSubstr("did you mean \"aggregation\"?"))));
  EXPECT_THAT(complaints_about("format = 1\nmission = \"gone.toml\"\n"),
              ElementsAre(AllOf(HasSubstr("run.toml:2:11: E_CONFIG: gone.toml: "))));
  EXPECT_THAT(complaints_about("format = 1\ndesign = \"d1\"\ncandidate = \"c7\"\n"),
              ElementsAre(HasSubstr("run.toml:3:13: E_CONFIG: a candidate belongs to a design")));
  EXPECT_THAT(complaints_about("format = [\n"),
              ElementsAre(HasSubstr("E_CONFIG: this is not TOML")));
}

}  // namespace
}  // namespace swarmsmith
