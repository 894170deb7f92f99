#include "tracking/report/quality.h"

#include <nlohmann/json.hpp>

#include "tests/support/checks.h"
#include "tests/support/xml_check.h"
#include "tests/tracking/report/reported_run.h"
#include "tracking/robots/reality_text.h"

namespace swarmsmith {
namespace {

using Json = nlohmann::json;

TEST(QualityTest, JsonSaysWhatWasMeasured) {
  const MadeUpRun run;
  const Json report = Json::parse(quality_json(run.reported()));
  EXPECT_EQ(report["verdict"], "DEGRADED");
  EXPECT_EQ(report["score"], 2.0);
  EXPECT_EQ(report["run"]["duration_s"], 60.0);
  EXPECT_EQ(report["frames"]["dropped"], 9);
  const Json& second = report["robots"][1];
  EXPECT_EQ(second["cycles"],
            (Json{{"measured", 588}, {"interpolated", 4}, {"degraded", 8}, {"missing", 0}}));
  EXPECT_EQ(second["longest_gap_s"], 0.83);
  EXPECT_EQ(second["border"]["too_close"], true);
  EXPECT_TRUE(second["offset"].is_null());
  EXPECT_EQ(report["robots"][0]["offset"]["x_m"], 0.072);
  EXPECT_EQ(report["robots"][2]["samples"]["outliers"], 3);
  EXPECT_TRUE(report["robots"][2]["border"].is_null());
  EXPECT_EQ(report["issues"][0]["code"], "W_TOO_CLOSE_TO_CALL");
  EXPECT_TRUE(report["issues"][2]["from_s"].is_null());
}

TEST(QualityTest, JsonSaysHowCameraAndFloorTagsFared) {
  const MadeUpRun run;
  const Json camera = Json::parse(quality_json(run.reported()))["cameras"][0];
  EXPECT_EQ(camera["times"], name_of(TimeSource::Sidecar));
  EXPECT_EQ(camera["calibration"]["rms_px"], 0.0625);
  EXPECT_EQ(camera["calibration"]["sha256"], std::string(64, 'a'));
  EXPECT_EQ(camera["place"]["camera_height_m"], 2.75);
  const Json& tags = camera["reference_tags"];
  ASSERT_EQ(tags.size(), 4U);
  EXPECT_EQ(tags[0]["seen"], 5);
  EXPECT_EQ(tags[3]["seen"], 3);
  EXPECT_EQ(tags[3]["of"], 5);
  EXPECT_EQ(tags[2]["shift_px"], 2.0);
  // One kicked tag does not move the camera: medians of 0.25, 0.25, 2 and 0.25, 0.25, 0.25, 2.
  EXPECT_EQ(camera["shift_px"], 0.25);
}

TEST(QualityTest, SaysWhatRobotsWroteDownAndHowLateTheyMoved) {
  const MadeUpRun run;
  const Json robots = Json::parse(quality_json(run.reported()))["robots"];
  EXPECT_EQ(robots[0]["log"]["verdict"], "VALID");
  EXPECT_EQ(robots[0]["log"]["stepped"], 600);
  EXPECT_EQ(robots[0]["log"]["late_median_ms"], 1.5);
  EXPECT_EQ(robots[0]["log"]["late_most_ms"], 2.5);
  EXPECT_EQ(robots[0]["log"]["clock_offset_s"], -0.0035);
  EXPECT_EQ(robots[0]["latency"]["seconds"], 0.0625);
  EXPECT_TRUE(robots[1]["log"]["verdict"].is_null());
  EXPECT_EQ(robots[1]["log"]["skipped"], 1);
  EXPECT_TRUE(robots[1]["latency"]["seconds"].is_null());
  EXPECT_EQ(robots[1]["latency"]["reason"], "its commands did not move it");
  EXPECT_TRUE(robots[2]["log"].is_null());
  EXPECT_TRUE(robots[2]["latency"].is_null());
  const std::string page = quality_html(run.reported());
  EXPECT_EQ(xml_trouble(page), "");
  for (const char* said : {"62 +- 0.5", "cannot be determined: its commands did not move it",
                           "1.5, 2.5", "-3.5", "none: it was killed", "SCHED_FIFO 20"})
    EXPECT_THAT(page, HasSubstr(said));
}

TEST(QualityTest, TellsWhatLogsAndFilmSayOfTheRobotsWorld) {
  MadeUpRun run;
  EXPECT_THAT(quality_html(run.reported()), Not(HasSubstr("Way, of that commanded")));
  Reality reality;
  reality.slip.way = {.gain = 0.875, .error = 0.0125, .seconds = 40, .reason = ""};
  reality.slip.turn.reason = "it would be known to 9.0 %, and 5 % are allowed";
  reality.neighbours = {.there = 400, .seen = 300, .phantoms = 2, .error = 0.03, .reason = ""};
  reality.period_s = 0.1;
  reality.states_s = {{0, 42.5}, {1, 17.5}};
  run.scored.reality = {reality, std::nullopt, std::nullopt};
  const std::string page = quality_html(run.reported());
  EXPECT_EQ(xml_trouble(page), "");
  for (const char* said : {"Way, of that commanded", "87.5 +- 1.2", "25.0 +- 3.0 of 400",
                           "9.0 %, and 5 %", "0: 42.5, 1: 17.5"})
    EXPECT_THAT(page, HasSubstr(said));
  const Json report = Json::parse(quality_json(run.reported()));
  EXPECT_TRUE(report["robots"][1]["reality"].is_null());
  const Json& told = report["robots"][0]["reality"];
  EXPECT_EQ(told["way"]["gain"], 0.875);
  EXPECT_TRUE(told["turn"]["gain"].is_null());
  EXPECT_EQ(told["neighbours"]["miss_rate"], 0.25);
  EXPECT_EQ(told["states"][1]["seconds"], 17.5);
  // A store keeps no readings: what followed from them comes from the report.
  const std::string first = report["robots"][0]["robot"];
  EXPECT_EQ(neighbours_in_report(report.dump(), first), reality.neighbours);
  for (const std::string& other : {std::string("{}"), std::string("no json"), std::string()})
    EXPECT_THAT(neighbours_in_report(other, first).reason, HasSubstr("`rescore` it with --run"));
}

TEST(QualityTest, ARunWithoutLogsSpeaksOfNone) {
  MadeUpRun run;
  run.observations.logs.clear();
  run.scored.latencies.clear();
  EXPECT_THAT(quality_html(run.reported()), Not(HasSubstr("SCHED_FIFO")));
  EXPECT_THAT(quality_html(run.reported()), Not(HasSubstr("Latency")));
  EXPECT_TRUE(Json::parse(quality_json(run.reported()))["robots"][0]["latency"].is_null());
}

TEST(QualityTest, ListsWhatWasCheckedAndWhatCouldNotBe) {
  const MadeUpRun run;
  const Json report = Json::parse(quality_json(run.reported()));
  ASSERT_EQ(report["checks"].size(), 3U);
  EXPECT_EQ(report["checks"][0]["value"], 30);
  EXPECT_EQ(report["checks"][0]["limit"], 10);
  EXPECT_EQ(report["checks"][1]["outcome"], "warned");
  EXPECT_TRUE(report["checks"][2]["value"].is_null());
  EXPECT_EQ(report["checks"][2]["reason"], "the run log names no log of it");
  EXPECT_EQ(report["not_checked"], Json::array({"motion as commanded"}));
  const std::string page = quality_html(run.reported());
  for (const char* said :
       {"Not checked: motion as commanded.", "1 of 3 checks passed, 1 warned, 0 failed",
        "30 frames/s", "at least 10 frames/s", "the run log names no log of it"})
    EXPECT_THAT(page, HasSubstr(said));
  // What did not pass comes first.
  EXPECT_LT(page.find("cycles in long gaps"), page.find("frame rate<"));
}

TEST(QualityTest, ARunWithoutADateSpeaksOfNone) {
  MadeUpRun run;
  run.log.recorded.clear();
  const std::string page = quality_html(run.reported());
  EXPECT_THAT(page, HasSubstr("<p>aggregation, score 2</p>"));
  EXPECT_THAT(page, HasSubstr("the run log gives no date"));
}

TEST(QualityTest, AnOverrideCountsAboveTheVerdict) {
  MadeUpRun run;
  run.overrides = {{Verdict::Valid, "A. Person", "seen on the film"}};
  const Json report = Json::parse(quality_json(run.reported()));
  EXPECT_EQ(report["verdict"], "VALID");
  EXPECT_EQ(report["measured_verdict"], "DEGRADED");
  const std::string page = quality_html(run.reported());
  EXPECT_THAT(page, HasSubstr("A. Person has set the verdict to VALID: seen on the film"));
}

TEST(QualityTest, AnOverrideOfAnEarlierScoringDoesNotCount) {
  MadeUpRun run;
  run.overrides = {{Verdict::Valid, "A. Person", "seen on the film", false}};
  const Json report = Json::parse(quality_json(run.reported()));
  EXPECT_EQ(report["verdict"], "DEGRADED");
  EXPECT_EQ(report["overrides"][0]["counts"], false);
  EXPECT_THAT(quality_html(run.reported()),
              HasSubstr("A. Person had set the verdict to VALID: seen on the film. That no longer "
                        "counts"));
}

TEST(QualityTest, PageSaysTheVerdictFirst) {
  const MadeUpRun run;
  const std::string page = quality_html(run.reported());
  EXPECT_EQ(xml_trouble(page), "");
  EXPECT_THAT(page, HasSubstr("<h1>run07: DEGRADED</h1>"));
  const std::size_t reason = page.find("rvr2 was bridged for 0.83 s from 30.0 s on &lt;its tag");
  const std::size_t picture = page.find("<svg");
  ASSERT_NE(reason, std::string::npos);
  EXPECT_LT(reason, picture);
  for (const char* said : {"98.0 %", "0.7 %", "1.3 %", "TOO CLOSE TO CALL", "+210.0, black spot",
                           "72.0, -4.0 (2026-11-20 10:30)", "tag used as centre", "3 of 5",
                           "9 (0.5 %)", "14.50 / 30.00 / 31.00", "aaaaaaaaaaaaaaaa"})
    EXPECT_THAT(page, HasSubstr(said));
  EXPECT_THAT(page, Not(HasSubstr("BIASED")));
}

TEST(QualityTest, ABiasedScoreIsCalledThat) {
  MadeUpRun run;
  run.scored.biased = true;
  EXPECT_THAT(quality_html(run.reported()), HasSubstr("BIASED"));
}

TEST(QualityTest, WhatIsMissingIsSaidToBeMissing) {
  MadeUpRun run;
  run.rig = {};
  run.tracked = {};
  run.scored = {};
  run.observations.cameras[0].references.clear();
  const Json report = Json::parse(quality_json(run.reported()));
  EXPECT_TRUE(report["score"].is_null());
  EXPECT_TRUE(report["cameras"][0]["calibration"].is_null());
  EXPECT_EQ(xml_trouble(quality_html(run.reported())), "");
}

TEST(QualityTest, SameRunSameBytes) {
  EXPECT_EQ(quality_html(MadeUpRun().reported()), quality_html(MadeUpRun().reported()));
  EXPECT_EQ(quality_json(MadeUpRun().reported()), quality_json(MadeUpRun().reported()));
}

}  // namespace
}  // namespace swarmsmith
