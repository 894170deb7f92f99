#include "robot/log/track_log.h"

#include "tests/support/checks.h"
#include "tracking/rig/rig_file.h"

namespace swarmsmith {
namespace {

/// What `swarmsmith-robot start` writes is what the tracker reads.
TEST(TrackLogTest, IsReadByTheTracker) {
  const StartedRun run{.run = "run07",
                       .recorded = "2026-11-25",
                       .mission = "color_selection",
                       .design = "d3",
                       .has_patches = true,
                       .at_clock_s = 5012.75,
                       .video = "run07.mkv",
                       .camera = "ceiling",
                       .sync_tag = 99,
                       .nodes = {{"rvr1", "run07.rvr1.log.csv", RunVerdict::Valid, {}},
                                 {"rvr2", "", std::nullopt, {"silent \"radio\"\n"}}}};
  const TrackLog written = track_log_of(run, CameraClock{0, 5010.25, 5140.25});
  const auto log = parse_run_log(written.text, "run07.toml");
  ASSERT_TRUE(log) << to_string(log.error().front()) << written.text;
  EXPECT_EQ(log->name, "run07");
  EXPECT_EQ(log->recorded, "2026-11-25");
  EXPECT_EQ(log->mission.name, "color_selection");
  EXPECT_EQ(log->design, "d3");
  EXPECT_EQ(log->start.time_s, 2.5);
  EXPECT_EQ(log->start.sync_tag, 99);
  EXPECT_EQ(log->layout.source, RunLayout::Source::Measured);
  EXPECT_THAT(log->robots, ElementsAre("rvr1", "rvr2"));
  ASSERT_EQ(log->videos.size(), 1U);
  EXPECT_EQ(log->videos[0].file, "run07.mkv");
  EXPECT_EQ(log->videos[0].camera, "ceiling");
  EXPECT_THAT(log->notes,
              ElementsAre(RobotNote{"rvr1", "run07.rvr1.log.csv", Verdict::Valid, {}},
                          RobotNote{"rvr2", "", Verdict::Invalid, {"silent \"radio\"\n"}}));
}

TEST(TrackLogTest, WithoutAVideoIsReadAllTheSame) {
  StartedRun run{.run = "run07", .nodes = {{"rvr1", "", RunVerdict::Valid, {}}}};
  const TrackLog written = track_log_of(run, std::nullopt);
  const auto log = parse_run_log(written.text, "run07.toml");
  ASSERT_TRUE(log) << to_string(log.error().front()) << written.text;
  EXPECT_FALSE(log->start.time_s);
  EXPECT_TRUE(log->videos.empty());
}

}  // namespace
}  // namespace swarmsmith
