#include "robot/log/track_log.h"

#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

constexpr char kSidecar[] =
    "frame,time_s,clock_s\n0,0.000000,5010.250000\n1,0.033000,5010.283000\n"
    "2,130.000000,5140.250000\n";

StartedRun run07() {
  return {.run = "run07",
          .recorded = "2026-11-25",
          .mission = "aggregation",
          .design = "d3",
          .at_clock_s = 5012.75,
          .video = "run07.mkv",
          .camera = "ceiling",
          .nodes = {{"rvr1", "run07.rvr1.log.csv", RunVerdict::Valid, {}},
                    {"rvr2", "run07.rvr2.log.csv", RunVerdict::Degraded, {"1.5 % were \"late\""}},
                    {"rvr3", "", std::nullopt, {}}}};
}

TEST(TrackLogTest, SaysTheStartOnTheTimesOfTheVideo) {
  const auto clock = value_of(camera_clock_of(kSidecar, "run07.times.csv"));
  const TrackLog log = track_log_of(run07(), clock);
  EXPECT_THAT(log.warnings, IsEmpty());
  EXPECT_EQ(log.text, R"(# Written by `swarmsmith-robot start`, for `swarmsmith track score --run`.
format = 1
name = "run07"
recorded = 2026-11-25
mission = "aggregation"
design = "d3"
source = "real"
robots = ["rvr1", "rvr2", "rvr3"]
start = "2.500000 s"

[[video]]
camera = "ceiling"
file = "run07.mkv"

[[robot]]
name = "rvr1"
log = "run07.rvr1.log.csv"
verdict = "VALID"

[[robot]]
name = "rvr2"
log = "run07.rvr2.log.csv"
verdict = "DEGRADED"
reasons = ["1.5 % were \"late\""]

[[robot]]
name = "rvr3"
verdict = "INVALID"
reasons = ["it did not answer after the run"]
)");
}

TEST(TrackLogTest, CountsFromTheFirstFrameWhateverItsTimeIs) {
  const auto clock = value_of(camera_clock_of(
      "frame,clock_s,time_s\n0,900.5,1764075000.125\n1,901,1764075000.625\n", "t.csv"));
  StartedRun run = run07();
  run.at_clock_s = 900.75;
  EXPECT_THAT(track_log_of(run, clock).text, HasSubstr("start = \"1764075000.375000 s\""));
}

TEST(TrackLogTest, TakesARecordingThatGoesOn) {
  // Its last row is being written.
  const auto clock =
      value_of(camera_clock_of("frame,time_s,clock_s\n0,0.0,10.0\n1,3.0,13.0\n2,3.03,1", "t"));
  EXPECT_EQ(clock.last_clock_s, 13.0);
  EXPECT_THAT(camera_clock_of("frame,time_s,clock_s\n0,0.0", "t.csv").error().message,
              HasSubstr("it has no frame yet"));
}

TEST(TrackLogTest, FrameTimesWithoutAClockSayWhatToDo) {
  const Error none = why_not(camera_clock_of("frame,time_s\n0,0.0\n", "t.csv"));
  EXPECT_THAT(to_string(none), HasSubstr("t.csv"));
  EXPECT_THAT(none.message, HasSubstr("no column `clock_s`"));
  EXPECT_THAT(none.message, HasSubstr("--start"));
  EXPECT_THAT(camera_clock_of("a,b\n1,2\n", "t.csv").error().message, HasSubstr("`time_s`"));
  EXPECT_THAT(to_string(camera_clock_of("time_s,clock_s\n1,2\nx,3\n", "t.csv").error()),
              HasSubstr("t.csv:3"));
  EXPECT_FALSE(camera_clock_of("", "t.csv"));
}

TEST(TrackLogTest, LeavesOutAStartThatTheVideoCannotHaveSeen) {
  const CameraClock clock{0, 5010.25, 5140.25};
  StartedRun early = run07();
  early.at_clock_s = 5009;
  const TrackLog before = track_log_of(early, clock);
  EXPECT_THAT(before.warnings,
              ElementsAre(HasSubstr("run07.mkv begins 1.25 s after the robots did")));
  EXPECT_THAT(before.text, Not(HasSubstr("\nstart")));
  EXPECT_THAT(before.text, HasSubstr("# The robots began at 5009.000000 s"));
  StartedRun late = run07();
  late.at_clock_s = 99'000;
  EXPECT_THAT(track_log_of(late, clock).warnings,
              ElementsAre(HasSubstr("ends 93859.75 s before the robots began")));
  EXPECT_THAT(track_log_of(run07(), std::nullopt).warnings, ElementsAre(HasSubstr("not known")));
  StartedRun unfilmed = run07();
  unfilmed.video.clear();
  const TrackLog none = track_log_of(unfilmed, std::nullopt);
  EXPECT_THAT(none.warnings, ElementsAre(HasSubstr("no video was given")));
  EXPECT_THAT(none.text, Not(HasSubstr("[[video]]")));
}

TEST(TrackLogTest, ACandidateStandsForItsDesign) {
  StartedRun run = run07();
  run.candidate = "c812";
  run.has_patches = true;
  run.sync_tag = 99;
  const std::string text = track_log_of(run, CameraClock{0, 5010.25, 5140.25}).text;
  EXPECT_THAT(text, HasSubstr("candidate = \"c812\"\n"));
  EXPECT_THAT(text, Not(HasSubstr("design")));
  EXPECT_THAT(text, HasSubstr("layout = \"measured\"\n"));
  EXPECT_THAT(text, HasSubstr("sync = { tag = 99, when = \"hidden\" }\n"));
}

}  // namespace
}  // namespace swarmsmith
