#include <nlohmann/json.hpp>

#include "base/text/sha256.h"
#include "tests/support/checks.h"
#include "tests/tracking/report/reported_run.h"
#include "tracking/report/quality.h"
#include "tracking/report/result_text.h"
#include "tracking/scoring/real_run_rows.h"

namespace swarmsmith {
namespace {

using Json = nlohmann::json;

Json json_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

/// A run with all that a robot may have, in its four forms.
struct Rendered {
  Rendered() {
    run.observations.sightings.resize(1);  // that all samples were made of
    run.rig.files["ceiling.place.toml"] = {"ceiling.place.toml", "", std::string(64, 'd'), ""};
    Reality reality;
    reality.slip.way = {.gain = 0.875, .error = 0.0125, .seconds = 40, .reason = ""};
    run.scored.reality = {reality, std::nullopt, std::nullopt};
    const RunFindings findings = run.reported();
    report = Json::parse(quality_json(findings));
    JsonObject object;
    add_result(object, findings);
    result = Json::parse(object.text());
    text = result_text(findings, true);
    page = quality_html(findings);
    rows = real_run_rows(findings, "arena", {12.5});
  }

  MadeUpRun run;
  Json report;  ///< as a store keeps it
  Json result;  ///< as `score --json` prints it
  std::string text, page;
  RealRunRows rows;
};

TEST(SameNumbers, OfRobots) {
  const Rendered all;
  ASSERT_EQ(all.rows.robots.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const RealRobotRow& row = all.rows.robots[i];
    const Json& report = all.report["robots"][i];
    const Json& result = all.result["robots"][i];
    EXPECT_EQ(report["robot"], row.name);
    EXPECT_EQ(result["name"], row.name);
    EXPECT_EQ(report["tag"], row.tag);
    EXPECT_EQ(result["tag"], row.tag);
    EXPECT_EQ(report["cycles"], (Json{{"measured", row.measured},
                                      {"interpolated", row.interpolated},
                                      {"degraded", row.degraded},
                                      {"missing", row.missing}}));
    const double all_cycles =
        static_cast<double>(row.measured + row.interpolated + row.degraded + row.missing);
    EXPECT_EQ(result["measured"], static_cast<double>(row.measured) / all_cycles);
    EXPECT_EQ(result["missing_cycles"], row.missing);
    for (const Json* one : {&report, &result}) {
      EXPECT_EQ((*one)["longest_gap_s"], row.longest_gap_s);
      EXPECT_EQ((*one)["sigma_m"], row.sigma_m);
    }
    EXPECT_EQ(report["outliers"], row.outliers);
    EXPECT_EQ(report["scale"], row.scale);
    EXPECT_EQ(report["residual_m"], row.residual_m);
    EXPECT_EQ(result["border_m"], json_or_null(row.border_m));
    EXPECT_EQ(result["too_close"], row.too_close);
    EXPECT_EQ(report["border"].is_null(), !row.border_m);
    if (row.border_m) {
      EXPECT_EQ(report["border"]["signed_m"], *row.border_m);
    }
    EXPECT_EQ(report["offset"].is_null() ? "" : report["offset"]["sha256"], row.offset_calibration);
    // Numbers are written as 1 here and as 1.0 there.
    EXPECT_EQ(result["reality"], report["reality"]);
  }
}

TEST(SameNumbers, OfLogsAndLatencies) {
  const Rendered all;
  ASSERT_EQ(all.rows.logs.size(), 2U);
  for (const RealLogRow& row : all.rows.logs) {
    const Json& report = all.report["robots"][static_cast<std::size_t>(row.robot)];
    const Json& result = all.result["robots"][static_cast<std::size_t>(row.robot)];
    EXPECT_EQ(report["log"]["stepped"], row.stepped);
    EXPECT_EQ(report["log"]["held"], row.held);
    EXPECT_EQ(report["log"]["skipped"], row.skipped);
    EXPECT_EQ(report["log"]["clock_offset_s"], json_or_null(row.clock_offset_s));
    EXPECT_EQ(report["latency"]["seconds"], json_or_null(row.latency_s));
    EXPECT_EQ(report["latency"]["error_s"], json_or_null(row.latency_error_s));
    EXPECT_EQ(report["latency"]["agreement"], json_or_null(row.agreement));
    EXPECT_EQ(report["latency"]["reason"], row.latency_reason);
    EXPECT_EQ(result["latency_s"], report["latency"]["seconds"]);
    EXPECT_EQ(result["latency_error_s"], report["latency"]["error_s"]);
    EXPECT_EQ(result["agreement"], report["latency"]["agreement"]);
    EXPECT_EQ(result["latency_reason"], report["latency"]["reason"]);
  }
}

TEST(SameNumbers, OfTheRunItsCamerasAndItsChecks) {
  const Rendered all;
  for (const Json* one : {&all.report, &all.result}) {
    EXPECT_EQ((*one)["score"], json_or_null(all.rows.score.score));
    EXPECT_EQ((*one)["verdict"], all.rows.score.verdict);
    EXPECT_EQ((*one)["biased"], all.rows.score.biased);
    EXPECT_EQ((*one)["reasons"], Json::parse(all.rows.score.reasons));
    EXPECT_EQ((*one)["issues"].size(), all.rows.issues.size());
    EXPECT_EQ((*one)["checks"].size(), all.rows.checks.size());
  }
  EXPECT_EQ(all.report["checks"], all.result["checks"]);
  EXPECT_EQ(all.report["not_checked"], all.result["not_checked"]);
  const Json& camera = all.report["cameras"][0];
  const RealVideoRow& video = all.rows.videos.at(0);
  EXPECT_EQ(camera["sha256"], video.sha256);
  EXPECT_EQ(camera["frames"], video.frames);
  EXPECT_EQ(camera["damaged_frames"], video.damaged_frames);
  EXPECT_EQ(camera["times"], video.time_source);
  EXPECT_EQ(camera["calibration"]["sha256"], video.camera_calibration);
  EXPECT_EQ(camera["place"]["sha256"], video.place_calibration);
  EXPECT_EQ(video.place_calibration, std::string(64, 'd'));
}

TEST(SameNumbers, InTextsForPeople) {
  const Rendered all;
  EXPECT_THAT(all.text, HasSubstr("run07: aggregation, score 2, DEGRADED"));
  EXPECT_THAT(all.text, HasSubstr("rvr2  tag   2  seen  98.0 %  longest gap 0.83 s"));
  EXPECT_THAT(all.page, HasSubstr("98.0 %"));
  EXPECT_THAT(all.text, HasSubstr("latency 62 ms +- 0.5 ms"));
  EXPECT_THAT(all.page, HasSubstr("62 +- 0.5"));
  EXPECT_THAT(all.text, HasSubstr("1 of 3 checks passed"));
  EXPECT_THAT(all.page, HasSubstr("1 of 3 checks passed"));
}

/// Stores keep these bytes; scripts read them. The page has other words for the limits of a tag's
/// edge since then.
TEST(SameNumbers, AreWrittenInTheBytesOfVersion0_1) {
  const MadeUpRun run;
  EXPECT_EQ(sha256_of(quality_json(run.reported())),
            "4d18d0db5a25d10a6b179924a93a4e7ded6b7a4fc678183a76c80400da56d894");
  EXPECT_EQ(sha256_of(quality_html(run.reported())),
            "f36bb7ac77558b3a8ddc87001cad74ea91260899b52d9c4fae7c5b39652c72bc");
}

}  // namespace
}  // namespace swarmsmith
