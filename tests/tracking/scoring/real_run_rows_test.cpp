#include "tracking/scoring/real_run_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "base/math.h"
#include "storage/stored_enums.h"
#include "tests/support/checks.h"
#include "tests/tracking/motion/seen_run.h"
#include "tracking/robots/robot_logs.h"
#include "tracking/scoring/score_run.h"

namespace swarmsmith {
namespace {

/// A colour run with everything that rows keep, scored once.
class RealRunRowsTest : public testing::Test {
 protected:
  RealRunRowsTest() : seen(seen_run(on_circle, {.cycles = 200, .noise_px = 0.2})) {
    log.name = "run07";
    log.recorded = "2026-11-21";
    log.mission = built_in_mission("color_selection").value();
    log.mission.cycles = 200;
    log.start.time_s = 12.4;
    log.videos.push_back({.camera = "camera0", .file = "camera0.mp4"});
    patches = instance_of(log.mission, 4)->patches;
    log.layout.source = RunLayout::Source::Log;
    for (const Patch& patch : patches)
      log.layout.patches.push_back({std::get<Rectangle>(patch.shape).centre, patch.color});
    complete_calibrations();
    seen.hide(2, 5.02, 5.4);
    spoil();
    score();
  }

  /// What files must say and the sightings do not need.
  void complete_calibrations() {
    CameraCalibration camera = seen.rig.models.begin()->second;
    camera.rms_px = 0.07;
    camera.views = 17;
    camera.coverage = 0.8;
    camera.board = "charuco";
    camera.made = "2026-11-20T10:00:00Z";
    PlaceCalibration place = seen.rig.places.begin()->second;
    place.rms_px = 0.05;
    place.worst_left_out_m = 0.0011;
    place.coverage = 0.7;
    place.made = "2026-11-20T11:00:00Z";
    texts["camera0.camera.toml"] = calibration_text(camera);
    texts["camera0.place.toml"] = calibration_text(place);
    arena_text =
        "format = 1\nfamily = \"tag36h11\"\n[[camera]]\nname = \"camera0\"\n"
        "model = \"camera0.camera.toml\"\nplace = \"camera0.place.toml\"\n";
    for (const ReferenceTag& tag : seen.rig.references) {
      arena_text +=
          fmt::format("[[reference]]\ntag = {}\nx = {}\ny = {}\nangle = {}\nedge = {}\n", tag.tag,
                      tag.pose.x, tag.pose.y, tag.pose.theta * 180 / kPi, tag.edge_m);
    }
    for (const RobotSetup& robot : seen.rig.robots) {
      OffsetCalibration offset = seen.rig.offsets.at(robot.offset_file);
      offset.edge_m = robot.edge_m;
      offset.height_m = robot.height_m;
      offset.rms_m = 0.0004;
      offset.sigma_x_m = 1e-4;
      offset.sigma_y_m = 1e-4;
      offset.samples = 120;
      offset.turned_rad = 13;
      offset.made = "2026-11-20T12:00:00Z";
      texts[robot.offset_file] = calibration_text(offset);
      arena_text += fmt::format(
          "[[robot]]\nname = \"{}\"\ntag = {}\nedge = {}\nheight = {}\n"
          "offset = \"{}\"\n",
          robot.name, robot.tag, robot.edge_m, robot.height_m, robot.offset_file);
    }
    const auto find = [&](CalibrationKind, const std::string&,
                          const std::string& file) -> Expected<std::optional<std::string>> {
      return texts.at(file);
    };
    const auto rig = parse_rig(arena_text, "arena.toml", find);
    if (!rig) throw std::runtime_error(to_string(rig.error().front()));
    seen.rig = *rig;
  }

  /// A twin, an unknown tag, floor tags, an issue of the file.
  void spoil() {
    Observations& observations = seen.observations;
    Sighting twin = observations.sightings[300];
    for (ImagePoint& corner : twin.corners)
      corner.u += 150;
    observations.sightings.push_back(twin);
    twin.tag = 44;
    twin.hamming = 1;
    observations.sightings.push_back(twin);
    std::ranges::stable_sort(observations.sightings, {}, &Sighting::frame);
    observations.cameras[0].damaged_frames = 2;
    observations.issues.push_back({IssueCode::FramesDropped, "2 frames are damaged", "", 3.0, {}});
  }

  void score() {
    tracked = seen.track().value();
    scored = score_run(tracked, log.mission, patches, seen.observations.issues).value();
  }

  RealRunRows rows() const { return rows_of(seen.rig, log, seen.observations); }
  RealRunRows rows_of(const Rig& rig, const RunLog& of_run,
                      const Observations& observations) const {
    return real_run_rows(findings_of(rig, of_run, observations, tracked, scored), arena_text,
                         seen.options.span.starts_s);
  }

  SeenRun seen;
  RunLog log;
  std::vector<Patch> patches;
  std::string arena_text;
  std::map<std::string, std::string> texts;
  TrackedRun tracked;
  ScoredRun scored;
};

TEST_F(RealRunRowsTest, HoldWhatTheRunIs) {
  const RealRunRows run = rows();
  EXPECT_EQ(run.name, "run07");
  EXPECT_EQ(run.mission, "color_selection");
  EXPECT_DOUBLE_EQ(run.duration_s, 20);
  EXPECT_EQ(run.calibrations.size(), 5U);
  EXPECT_EQ(run.calibrations[2].subject, "rvr1");
  ASSERT_EQ(run.videos.size(), 1U);
  EXPECT_EQ(run.videos[0].camera_calibration, run.calibrations[0].sha256);
  EXPECT_EQ(run.videos[0].damaged_frames, 2);
  ASSERT_EQ(run.robots.size(), 3U);
  EXPECT_EQ(run.robots[1].measured + run.robots[1].interpolated, 200);
  EXPECT_GT(run.robots[1].interpolated, 0);
  EXPECT_TRUE(run.robots[0].border_m.has_value());
  EXPECT_EQ(run.robots[0].offset_calibration, run.calibrations[2].sha256);
  EXPECT_EQ(run.samples.size(), seen.observations.sightings.size());
  EXPECT_EQ(std::ranges::count(run.samples, std::int64_t{2}, &RealSampleRow::use), 1);
  EXPECT_EQ(std::ranges::count(run.samples, std::int64_t{-1}, &RealSampleRow::robot), 1);
  EXPECT_EQ(run.cycles.size(), 3U * 201U);
  EXPECT_EQ(run.cycles.back().x, tracked.trajectory.at(199)[2].x);
  EXPECT_EQ(run.patches.size(), 12U);
  EXPECT_EQ(run.score.score, scored.score);
  EXPECT_EQ(run.score.verdict, "DEGRADED");
  EXPECT_EQ(run.score.reasons, R"(["W_FRAMES_DROPPED: 2 frames are damaged"])");
  EXPECT_EQ(std::ranges::count(run.issues, true, &RealIssueRow::of_observing), 1);
  EXPECT_GT(run.issues.size(), 1U);
}

TEST_F(RealRunRowsTest, ScoreAgainToTheSameBits) {
  const RealRunRows run = rows();
  const auto stored = value_of(stored_run(run));
  const TrackedRun again =
      track_run(stored.observations, stored.rig, seen.arena, seen.options).value();
  EXPECT_EQ(again.trajectory, tracked.trajectory);
  EXPECT_EQ(again.starts, tracked.starts);
  EXPECT_EQ(again.issues, tracked.issues);
  const ScoredRun rescored =
      score_run(again, stored.log.mission, patches, stored.observations.issues).value();
  EXPECT_EQ(rescored.score, scored.score);
  EXPECT_EQ(rescored.issues, scored.issues);
  EXPECT_EQ(stored.log, log);
}

TEST_F(RealRunRowsTest, AreTheSameRowsAfterARoundTrip) {
  const RealRunRows run = rows();
  const auto stored = stored_run(run).value();
  const RealRunRows again = rows_of(stored.rig, stored.log, stored.observations);
  EXPECT_EQ(again.key, run.key);
  EXPECT_EQ(again.log, run.log);
  EXPECT_EQ(again.mission_file, run.mission_file);
  EXPECT_EQ(again.patches, run.patches);
  ASSERT_EQ(again.samples.size(), run.samples.size());
  for (std::size_t i = 0; i < run.samples.size(); ++i) {
    EXPECT_EQ(again.samples[i].corners, run.samples[i].corners);
    EXPECT_EQ(again.samples[i].robot, run.samples[i].robot);
  }
  EXPECT_GT(run.references.size(), 100U);
  EXPECT_EQ(again.references, run.references);
  ASSERT_EQ(again.calibrations.size(), run.calibrations.size());
  for (std::size_t i = 0; i < run.calibrations.size(); ++i)
    EXPECT_EQ(again.calibrations[i].file, run.calibrations[i].file);
}

/// Two robots have logs; the second one's node was killed.
TEST_F(RealRunRowsTest, HoldTheRobotsLogsFromWhichLatencyFollowsAgain) {
  for (const int robot : {0, 1}) {
    RobotLog& own = seen.observations.logs.emplace_back();
    own.robot = fmt::format("rvr{}", robot + 1);
    own.file = own.robot + ".log.csv";
    LogHead& head = own.record.head;
    head.run = "run07";
    head.robot = own.robot;
    head.machine = "--nstates 1 --s0 1";
    head.machine_digest = "aa11";
    head.flavour = "watermelon";
    head.turn_clock = "seconds";
    head.host = "pi";
    head.start_clock_s = 1.0 / 3;
    head.clock_offset_s = 0.004;
    if (robot == 0) {
      head.end = RunEnd{.state = "ended",
                        .verdict = RunVerdict::Degraded,
                        .reasons = {"late"},
                        .stepped = 198,
                        .held = 1,
                        .skipped = 1};
    }
    for (int cycle = 1; cycle <= 200; ++cycle) {
      if (cycle == 77) continue;
      LogRow& row = own.record.rows.emplace_back();
      row.cycle = cycle;
      row.sensed.time_s = cycle * 0.1;
      row.clock_s = head.start_clock_s + cycle * 0.1;
      row.late_ms = 0.1 + robot;
      row.act = cycle == 78 ? Act::Hold : Act::Step;
      row.state = cycle % 2;
      row.command = {0.3, 0.3 - 0.002 * (cycle % 40)};
      row.age_ms[0] = 1.0 / 7;
      row.drawn = 5;
      row.event = cycle == 78 ? "proximity: silent, \"so\"" : "";
    }
  }
  const RobotFindings found = judge_robots(tracked, seen.observations.logs, log);
  scored.latencies = found.latencies;
  const RealRunRows run = rows();
  ASSERT_EQ(run.logs.size(), 2U);
  EXPECT_EQ(run.logs[0].verdict, "DEGRADED");
  EXPECT_EQ(run.logs[0].reasons, R"(["late"])");
  EXPECT_EQ(run.logs[0].skipped, 1);
  EXPECT_EQ(run.logs[1].state, "");
  EXPECT_EQ(run.logs[1].skipped, 1);
  EXPECT_EQ(run.logs[1].held, 1);
  EXPECT_EQ(run.logs[1].stepped, 198);
  EXPECT_EQ(run.logs[1].agreement, found.latencies[1]->agreement);
  ASSERT_EQ(run.log_cycles.size(), 398U);
  EXPECT_EQ(run.log_cycles[1].robot, 1);
  EXPECT_EQ(run.log_cycles[1].cycle, 1);
  EXPECT_EQ(run.log_cycles[1].ages_ms[0], 1.0 / 7);
  EXPECT_FALSE(run.log_cycles[1].ages_ms[1]);
  const auto stored = value_of(stored_run(run));
  const RobotFindings again = judge_robots(tracked, stored.observations.logs, stored.log);
  EXPECT_EQ(again.issues, found.issues);
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_EQ(again.latencies[i]->seconds, found.latencies[i]->seconds);
    EXPECT_EQ(again.latencies[i]->agreement, found.latencies[i]->agreement);
    EXPECT_EQ(again.latencies[i]->reason, found.latencies[i]->reason);
  }
  const RealRunRows once_more = rows_of(stored.rig, stored.log, stored.observations);
  EXPECT_EQ(once_more.logs, run.logs);
  EXPECT_EQ(once_more.log_cycles, run.log_cycles);
}

/// The key is of what was filmed, not of what it was scored with.
TEST_F(RealRunRowsTest, HaveTheKeyOfTheirVideosAndTheirStart) {
  std::set<std::string> keys{rows().key};
  tracked.issues.clear();
  log.name = "another";
  keys.insert(rows().key);
  EXPECT_EQ(keys.size(), 1U);
  seen.options.span.starts_s[0] += 1;
  keys.insert(rows().key);
  seen.observations.cameras[0].sha256 = "other";
  keys.insert(rows().key);
  EXPECT_EQ(keys.size(), 3U);
}

/// One lens file for all cameras of a model, and one offset for all robots.
TEST_F(RealRunRowsTest, HoldACalibrationForEachSubjectThatUsesIt) {
  CameraSetup second = seen.rig.cameras.front();
  second.name = "camera1";
  seen.rig.cameras.push_back(second);
  const std::string own = seen.rig.robots[1].offset_file;
  seen.rig.files.at(own) = seen.rig.files.at(seen.rig.robots[0].offset_file);
  const RealRunRows run = rows();
  const auto has = [&](const std::string& kind, const std::string& subject,
                       const std::string& file) {
    return std::ranges::any_of(run.calibrations, [&](const CalibrationRow& row) {
      return row.kind == kind && row.subject == subject &&
             row.sha256 == seen.rig.files.at(file).sha256;
    });
  };
  for (const char* camera : {"camera0", "camera1"}) {
    EXPECT_TRUE(has("camera", camera, second.model_file)) << camera;
    EXPECT_TRUE(has("place", camera, second.place_file)) << camera;
  }
  EXPECT_TRUE(has("offset", "rvr1", own));
  EXPECT_TRUE(has("offset", "rvr2", own));
  EXPECT_EQ(run.calibrations.size(), 7U);
}

TEST_F(RealRunRowsTest, SayWhenATagWasTakenForTheCentre) {
  seen.rig.offsets.erase("rvr2.offset.toml");
  seen.rig.files.erase("rvr2.offset.toml");
  seen.options.takes_tags_for_centres = true;
  score();
  const RealRunRows run = rows();
  EXPECT_EQ(run.robots[1].offset_calibration, "");
  EXPECT_TRUE(run.score.biased);
  EXPECT_FALSE(stored_run(run)->rig.offsets.contains("rvr2.offset.toml"));
}

TEST(Verdicts, OfAStoreAreThoseOfARun) {
  EXPECT_THAT(kVerdicts, ElementsAre(name_of(Verdict::Valid), name_of(Verdict::Degraded),
                                     name_of(Verdict::Invalid)));
}

}  // namespace
}  // namespace swarmsmith
