#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "storage/internal/mend_real_runs.h"
#include "storage/internal/real_run_parts.h"
#include "storage/internal/real_run_reader.h"
#include "storage/internal/real_run_writer.h"
#include "storage/internal/schema.h"
#include "storage/internal/sqlite.h"
#include "storage/store_at_rest.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"
#include "tests/support/faulty_disk.h"
#include "tests/support/synthetic_real_run.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;
using Cells = std::vector<std::string>;
using IfMissing = StoreAtRest::IfMissing;

const CandidateId kWinner = candidate_id({1}, 1);

/// A store with a finished campaign whose first design's winner is c1 or another.
struct RealRunsTest : testing::Test {
  TemporaryFolder folder;
  fs::path path = folder / "s.db";
  SyntheticCampaign campaign = synthetic_campaign({.designs = 2, .iterations = 1});
  std::string digest;

  void SetUp() override {
    fill_store(path, campaign);
    digest = digest_of(path);
  }
  std::unique_ptr<StoreAtRest> opened() {
    return value_of(StoreAtRest::open(path, IfMissing::Make));
  }
  RealRunId added(const RealRunRows& rows) {
    const auto written = opened()->add_real_run(rows);
    EXPECT_TRUE(written) << (written ? "" : to_string(written.error()));
    return written ? written->id : RealRunId{};
  }
  RealRunRows stored(RealRunId id) { return value_of(open_reader(path)->real_run(id)); }
  std::vector<Cells> all(const std::string& sql) { return cells_of(*open_reader(path), sql); }
};

/// The calibrations come back by kind and subject.
RealRunRows in_order(RealRunRows rows) {
  std::ranges::sort(rows.calibrations, {}, [](const CalibrationRow& row) {
    return std::tuple(row.kind, row.subject, row.sha256);
  });
  return rows;
}

TEST_F(RealRunsTest, ComeBackAsTheyWereWrittenAndAreNoPartOfTheAnswer) {
  const RealRunRows rows = synthetic_real_run(3, kWinner);
  const RealRunId id = added(rows);
  EXPECT_EQ(id, RealRunId{1});
  EXPECT_EQ(stored(id), in_order(rows));
  EXPECT_EQ(digest_of(path), digest);
  EXPECT_THAT(open_reader(path)->integrity(), IsEmpty());
  const auto heads = open_reader(path)->real_runs();
  ASSERT_EQ(heads.size(), 1U);
  const RealRunHead& head = heads[0];
  EXPECT_EQ(std::tie(head.id, head.key, head.name, head.mission, head.candidate, head.score,
                     head.verdict, head.counts, head.scorings),
            std::tuple(id, rows.key, rows.name, rows.mission, kWinner, std::optional(3.25),
                       std::string("VALID"), true, 1));
  // Tags of no robot have no pose.
  EXPECT_THAT(all("SELECT DISTINCT tag, robot, x, y, theta FROM v_real_samples"
                  " WHERE robot IS NULL OR x IS NULL OR y IS NULL OR theta IS NULL OR robot < 0"),
              ElementsAre(Cells{"77", "NULL", "NULL", "NULL", "NULL"}));
}

/// Every field has a value that no other field of its row has.
TEST_F(RealRunsTest, HaveEachFieldInItsPlace) {
  RealRunRows rows = synthetic_real_run(1, kWinner);
  rows.source = "filmed";
  rows.arena_file = "an arena";
  rows.mission_file = "a mission";
  rows.log = "a log";
  rows.score.reasons = R"(["a reason"])";
  rows.score.biased = true;
  double number = 1;
  const auto next = [&number](auto&... fields) {
    ((fields = static_cast<std::remove_reference_t<decltype(fields)>>(++number)), ...);
  };
  const auto maybe = [&number](auto&... fields) { ((fields = ++number + 0.5), ...); };
  RealRobotRow& robot = rows.robots[0];
  next(robot.tag, robot.measured, robot.interpolated, robot.degraded, robot.missing,
       robot.longest_gap_s, robot.outliers, robot.scale, robot.residual_m, robot.sigma_m,
       robot.sigma_rad);
  maybe(robot.border_m);
  RealSampleRow& sample = rows.samples[0];
  next(sample.frame, sample.time_s, sample.tag, sample.hamming, sample.margin, sample.x, sample.y,
       sample.theta, sample.use);
  for (double& corner : sample.corners)
    next(corner);
  RealReferenceRow& reference = rows.references[0];
  next(reference.time_s, reference.tag, reference.frames);
  for (double& corner : reference.corners)
    next(corner);
  RealVideoRow& video = rows.videos[0];
  next(video.width, video.height, video.frames, video.damaged_frames);
  RealPatchRow& patch = rows.patches[0];
  next(patch.x, patch.y, patch.width_m, patch.height_m, patch.radius_m);
  RealCycleRow& cycle = rows.cycles[0];
  next(cycle.x, cycle.y, cycle.theta, cycle.kind);
  RealLogRow& log = rows.logs[0];
  log.reasons = R"(["another"])";
  log.latency_reason = "a doubt";
  next(log.stepped, log.held, log.skipped);
  maybe(log.clock_offset_s, log.latency_s, log.latency_error_s, log.agreement);
  RealLogCycleRow& step = rows.log_cycles[0];
  step.event = "an event";
  next(step.time_s, step.clock_s, step.late_ms, step.state, step.left_mps, step.right_mps,
       step.drawn);
  maybe(step.ages_ms[0], step.ages_ms[1], step.ages_ms[2], step.ages_ms[3]);
  rows.issues[0].robot = "rvr2";
  maybe(rows.issues[0].from_s, rows.issues[0].to_s);
  rows.checks[0].subject = "ceiling";
  rows.checks[0].reason = "none";
  maybe(rows.checks[0].value, rows.checks[0].limit);
  const RealRunId id = added(rows);
  EXPECT_EQ(stored(id), in_order(rows));
  ASSERT_TRUE(opened()->rescore_real_run(id, rows));
  EXPECT_EQ(stored(id), in_order(rows)) << "scored again";
}

constexpr double kBad = std::numeric_limits<double>::infinity();

TEST(RealRunRows, WithANumberThatIsNotFiniteAreRefused) {
  const RealRunRows good = synthetic_real_run(1, {});
  EXPECT_NO_THROW(require_whole(good));
  using Change = std::function<void(RealRunRows&)>;
  const std::pair<const char*, Change> changes[] = {
      {"the run run01", [](auto& r) { r.duration_s = kBad; }},
      {"the run run01", [](auto& r) { r.score.score = -kBad; }},
      {"the calibration of rvr2", [](auto& r) { r.calibrations.back().rms = kBad; }},
      {"the frame times of run1-wall.mp4", [](auto& r) { r.videos[1].frame_times[2] = kBad; }},
      {"the robot rvr2", [](auto& r) { r.robots[1].longest_gap_s = kBad; }},
      {"the robot rvr2", [](auto& r) { r.robots[1].scale = kBad; }},
      {"the robot rvr2", [](auto& r) { r.robots[1].residual_m = kBad; }},
      {"the robot rvr2", [](auto& r) { r.robots[1].sigma_m = kBad; }},
      {"the robot rvr2", [](auto& r) { r.robots[1].sigma_rad = kBad; }},
      {"the robot rvr2", [](auto& r) { r.robots[1].border_m = kBad; }},
      {"tag 77 of frame 0", [](auto& r) { r.samples[2].time_s = kBad; }},
      {"tag 77 of frame 0", [](auto& r) { r.samples[2].margin = kBad; }},
      {"tag 77 of frame 0", [](auto& r) { r.samples[2].x = kBad; }},
      {"tag 77 of frame 0", [](auto& r) { r.samples[2].y = kBad; }},
      {"tag 77 of frame 0", [](auto& r) { r.samples[2].theta = kBad; }},
      {"tag 77 of frame 0", [](auto& r) { r.samples[2].corners[7] = kBad; }},
      {"the floor tag 101", [](auto& r) { r.references[1].time_s = kBad; }},
      {"the floor tag 101", [](auto& r) { r.references[1].corners[0] = kBad; }},
      {"a patch", [](auto& r) { r.patches[1].x = kBad; }},
      {"a patch", [](auto& r) { r.patches[1].y = kBad; }},
      {"a patch", [](auto& r) { r.patches[1].width_m = kBad; }},
      {"a patch", [](auto& r) { r.patches[1].height_m = kBad; }},
      {"a patch", [](auto& r) { r.patches[1].radius_m = kBad; }},
      {"cycle 1", [](auto& r) { r.cycles[2].x = kBad; }},
      {"cycle 1", [](auto& r) { r.cycles[2].y = kBad; }},
      {"cycle 1", [](auto& r) { r.cycles[2].theta = kBad; }},
      {"the log run01.rvr2.log.csv", [](auto& r) { r.logs[1].clock_offset_s = kBad; }},
      {"the log run01.rvr2.log.csv", [](auto& r) { r.logs[1].latency_s = kBad; }},
      {"the log run01.rvr2.log.csv", [](auto& r) { r.logs[1].latency_error_s = kBad; }},
      {"the log run01.rvr2.log.csv", [](auto& r) { r.logs[1].agreement = kBad; }},
      {"cycle 2 of a robot's log", [](auto& r) { r.log_cycles[2].time_s = kBad; }},
      {"cycle 2 of a robot's log", [](auto& r) { r.log_cycles[2].clock_s = kBad; }},
      {"cycle 2 of a robot's log", [](auto& r) { r.log_cycles[2].late_ms = kBad; }},
      {"cycle 2 of a robot's log", [](auto& r) { r.log_cycles[2].left_mps = kBad; }},
      {"cycle 2 of a robot's log", [](auto& r) { r.log_cycles[2].right_mps = kBad; }},
      {"cycle 2 of a robot's log", [](auto& r) { r.log_cycles[2].ages_ms[3] = kBad; }},
      {"the check scale of the tag", [](auto& r) { r.checks[1].value = kBad; }},
      {"the check scale of the tag", [](auto& r) { r.checks[1].limit = kBad; }},
      {"the issue W_OUTLIERS", [](auto& r) { r.issues[1].from_s = kBad; }},
      {"the issue W_OUTLIERS", [](auto& r) { r.issues[1].to_s = kBad; }}};
  int place = 0;
  for (const auto& [what, change] : changes) {
    RealRunRows rows = good;
    change(rows);
    ++place;
    try {
      require_whole(rows);
      ADD_FAILURE() << place << ": " << what;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(), "a number is not finite in " + std::string(what)) << place;
    }
  }
}

TEST(RealRunRows, NameTheCalibrationThatIsNotAmongThem) {
  const RealRunRows good = synthetic_real_run(1, {});
  const auto complaint = [&](const std::function<void(RealRunRows&)>& change) {
    RealRunRows rows = good;
    change(rows);
    try {
      require_whole(rows);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint([](auto& r) { r.videos[1].camera_calibration = "x"; }),
            "the camera calibration of wall is not among the rows");
  EXPECT_EQ(complaint([](auto& r) { r.videos[0].place_calibration = "x"; }),
            "the place calibration of ceiling is not among the rows");
  EXPECT_EQ(complaint([](auto& r) { r.robots[1].offset_calibration = "x"; }),
            "the offset calibration of rvr2 is not among the rows");
  EXPECT_EQ(complaint([](auto& r) { r.robots[1].offset_calibration = ""; }), "");
  // The same file for another camera, or of another kind, is another calibration.
  EXPECT_EQ(complaint([](auto& r) { r.videos[1].camera = "ceiling"; }),
            "the camera calibration of ceiling is not among the rows");
  EXPECT_EQ(
      complaint([](auto& r) { r.videos[0].camera_calibration = r.videos[0].place_calibration; }),
      "the camera calibration of ceiling is not among the rows");
}

/// What a score follows from, one by one.
TEST(RealRunRows, HaveOtherInputsWithEachChangeOfOne) {
  const RealRunRows a = synthetic_real_run(1, kWinner);
  const std::vector<std::pair<std::string, std::function<void(RealRunRows&)>>> changes{
      {"the candidate", [](auto& r) { r.candidate = {}; }},
      {"the mission", [](auto& r) { r.mission = "x"; }},
      {"the mission", [](auto& r) { r.mission_file = "x"; }},
      {"the run log", [](auto& r) { r.log = "x"; }},
      {"the run log", [](auto& r) { r.source = "x"; }},
      {"the run log", [](auto& r) { r.name = "x"; }},
      {"the run log", [](auto& r) { r.recorded = "x"; }},
      {"the arena file", [](auto& r) { r.arena_file = "x"; }},
      {"calibrations", [](auto& r) { r.videos[1].camera_calibration = "x"; }},
      {"calibrations", [](auto& r) { r.videos[1].place_calibration = "x"; }},
      {"calibrations", [](auto& r) { r.robots[1].offset_calibration = "x"; }},
      {"the robots' logs", [](auto& r) { r.logs[1].head = "x"; }},
      {"the robots' logs", [](auto& r) { r.log_cycles.pop_back(); }}};
  EXPECT_THAT(differing_inputs(a, a), IsEmpty());
  EXPECT_TRUE(same_scoring(a, a));
  RealRunRows all = a;
  for (const auto& [what, change] : changes) {
    RealRunRows b = a;
    change(b);
    change(all);
    EXPECT_EQ(differing_inputs(a, b), std::vector{what});
    EXPECT_FALSE(same_scoring(a, b)) << what;
    EXPECT_TRUE(same_sightings(a, b)) << what;
  }
  EXPECT_THAT(differing_inputs(a, all),
              ElementsAre("the candidate", "the mission", "the run log", "the arena file",
                          "calibrations", "the robots' logs"));
  int place = 0;
  for (const std::function<void(RealRunRows&)>& change :
       std::vector<std::function<void(RealRunRows&)>>{
           [](auto& r) { r.key = "x"; }, [](auto& r) { r.score.score = 9; },
           [](auto& r) { r.score.verdict = "INVALID"; }, [](auto& r) { r.score.biased = true; },
           [](auto& r) { r.score.reasons = "[1]"; }}) {
    RealRunRows b = a;
    change(b);
    EXPECT_THAT(differing_inputs(a, b), IsEmpty());
    EXPECT_FALSE(same_scoring(a, b)) << ++place;
  }
  for (const std::function<void(RealRunRows&)>& change :
       std::vector<std::function<void(RealRunRows&)>>{
           [](auto& r) { r.videos[1].sha256 = "x"; }, [](auto& r) { r.videos.pop_back(); },
           [](auto& r) { r.samples[1].video = 1; }, [](auto& r) { r.samples[1].frame = 1; },
           [](auto& r) { r.samples[1].tag = 9; }, [](auto& r) { r.samples[1].corners[7] += 0.001; },
           [](auto& r) { r.samples.pop_back(); }}) {
    RealRunRows b = a;
    change(b);
    EXPECT_FALSE(same_sightings(a, b)) << ++place;
  }
  RealRunRows b = a;
  b.samples[1].corners[7] += 0.0001;  // is stored as the same
  b.samples[1].x += 1;
  EXPECT_TRUE(same_sightings(a, b));
}

/// A run that lost rows of one table; its score stays if it follows from the others.
TEST_F(RealRunsTest, ThatLostPartsAreMendedAndNameThem) {
  added(synthetic_real_run(1, kWinner));
  RealRunRows biased = synthetic_real_run(2, kWinner);
  biased.score.biased = true;
  added(biased);
  const fs::path whole = folder / "whole.db";
  fs::copy_file(path, whole);
  const auto mended = [&](const std::string& sql) {
    fs::copy_file(whole, path, fs::copy_options::overwrite_existing);
    sqlite::Connection connection(path.string(), SQLITE_OPEN_READWRITE);
    connection.execute("PRAGMA foreign_keys = OFF; " + sql);
    return mend_real_runs(connection);
  };
  const auto scores = [&] {
    return all(
        "SELECT run, scoring, score, verdict, biased, reasons, program, report"
        " FROM v_real_scores WHERE program = 'swarmsmith recover' ORDER BY run");
  };
  const auto lost = [](const std::string& what) {
    return R"(["rows of its )" + what + R"( were lost with the damaged store"])";
  };
  EXPECT_EQ(mended(""), 0);
  EXPECT_THAT(scores(), IsEmpty());
  for (const RealRunPart& part : kRealRunParts) {
    EXPECT_EQ(mended(std::string("DELETE FROM ") + part.table + " WHERE run = 2"), 0);
    EXPECT_THAT(scores(), ElementsAre(Cells{"2", "2", part.is_scored ? "NULL" : "2.25", "INVALID",
                                            "1", lost(part.column), "swarmsmith recover", "{}"}));
    sqlite::Connection connection(path.string(), SQLITE_OPEN_READONLY);
    EXPECT_THAT(faults_of_real_runs(connection), IsEmpty()) << part.table;
  }
  EXPECT_EQ(mended("DELETE FROM real_score WHERE run = 1; DELETE FROM real_video WHERE run = 1;"
                   "DELETE FROM calibration WHERE kind = 'offset'"),
            0);
  EXPECT_THAT(scores(),
              ElementsAre(Cells{"1", "1", "NULL", "INVALID", "0",
                                lost("scores, videos, calibrations"), "swarmsmith recover", "{}"},
                          Cells{"2", "2", "2.25", "INVALID", "1", lost("calibrations"),
                                "swarmsmith recover", "{}"}));
  EXPECT_EQ(mended("UPDATE real_run SET candidate = 999 WHERE id = 2"), 0);
  EXPECT_THAT(all("SELECT id, candidate FROM v_real_runs"),
              ElementsAre(Cells{"r1", "1"}, Cells{"r2", "NULL"}));
}

TEST_F(RealRunsTest, ThatLostTheirRowLoseTheirParts) {
  added(synthetic_real_run(1, kWinner));
  added(synthetic_real_run(2, kWinner));
  ASSERT_TRUE(opened()->add_override({{2}, "VALID", "ada", "x"}));
  std::int64_t rows = 0;
  std::vector<std::string> tables(std::begin(kRealRunNotes), std::end(kRealRunNotes));
  for (const RealRunPart& part : kRealRunParts)
    tables.emplace_back(part.table);
  for (const std::string& table : tables)
    rows += std::stoll(all("SELECT count(*) FROM " + table + " WHERE run = 2")[0][0]);
  sqlite::Connection connection(path.string(), SQLITE_OPEN_READWRITE);
  connection.execute("PRAGMA foreign_keys = OFF; DELETE FROM real_run WHERE id = 2");
  EXPECT_EQ(mend_real_runs(connection), rows);
  for (const std::string& table : tables)
    EXPECT_EQ(all("SELECT count(*) FROM " + table + " WHERE run <> 1")[0], Cells{"0"}) << table;
  EXPECT_EQ(stored({1}), in_order(synthetic_real_run(1, kWinner)));
}

/// Stores of the first schema that had real runs, and of the one before it.
TEST(RealRunsOfEarlySchemas, AreReadFromTheFifthOn) {
  for (const std::int64_t schema : {4, 5}) {
    sqlite::Connection memory(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    create_tables(memory, schema);
    finish_schema(memory, schema);
    if (schema == 5) {
      memory.execute(
          "INSERT INTO real_run (id, key, source, mission, name, recorded, duration, mission_file,"
          " arena_file, log, samples) VALUES (3, 'k', 's', 'm', 'n', '', 1.5, '', '', '', 2)");
    }
    const auto run = read_real_run(memory, {3});
    ASSERT_EQ(run.has_value(), schema == 5);
    if (run) EXPECT_EQ(run->duration_s, 1.5);
    EXPECT_EQ(faults_of_real_runs(memory),
              schema == 5 ? (std::vector<std::string>{
                                "the real run r3 has no score",
                                "the real run r3 lacks rows of its samples, or has too many"})
                          : std::vector<std::string>{});
    EXPECT_FALSE(read_real_run(memory, {4}));
  }
}

TEST_F(RealRunsTest, TimesKeepTheirBitsAndCornersTheirThousandths) {
  RealRunRows rows = synthetic_real_run(1, kWinner);
  rows.videos[0].frame_times = {1.0 / 3, std::nextafter(0.5, 1), 1e-7, 1e6 + 1.0 / 7};
  rows.samples[0].corners[0] = 12.34567;
  const RealRunRows back = stored(added(rows));
  EXPECT_EQ(back.videos[0].frame_times, rows.videos[0].frame_times);
  EXPECT_EQ(back.samples[0].corners[0], 12.346);
}

TEST_F(RealRunsTest, TheSameRunIsStoredOnce) {
  const RealRunRows rows = synthetic_real_run(1, kWinner);
  const RealRunId id = added(rows);
  const auto again = value_of(opened()->add_real_run(rows));
  EXPECT_EQ(again.id, id);
  EXPECT_FALSE(again.is_new);
  EXPECT_NE(added(synthetic_real_run(2, kWinner)), id);
  EXPECT_EQ(all("SELECT count(*) FROM v_real_scores")[0], Cells{"2"});
}

TEST_F(RealRunsTest, OtherInputsOfAStoredRunAreRefusedWithTheWayOut) {
  const RealRunRows rows = synthetic_real_run(1, kWinner);
  added(rows);
  RealRunRows mended = rows;
  mended.calibrations[1].sha256 = "another place";
  mended.videos[0].place_calibration = "another place";
  mended.log += "# changed\n";
  const Error refused = why_not(opened()->add_real_run(mended));
  EXPECT_EQ(refused.kind, ErrorKind::Conflict);
  EXPECT_THAT(refused.message, HasSubstr("with other inputs (the run log, calibrations);"));
  EXPECT_THAT(refused.message, HasSubstr("swarmsmith track rescore r1"));
  EXPECT_EQ(stored({1}), in_order(rows));
}

TEST_F(RealRunsTest, OtherLogsOfRobotsAreOtherInputs) {
  RealRunRows rows = synthetic_real_run(1, kWinner);
  added(rows);
  // What follows from them is not input.
  rows.logs[0].latency_s = 0.3;
  const auto again = value_of(opened()->add_real_run(rows));
  EXPECT_FALSE(again.is_new);
  rows.log_cycles[3].left_mps = 0.1;
  EXPECT_THAT(complaint_of(opened()->add_real_run(rows)),
              HasSubstr("with other inputs (the robots' logs);"));
}

TEST_F(RealRunsTest, CommandsOfRobotsStandBesideWhatTheCameraSaw) {
  added(synthetic_real_run(1, kWinner));
  EXPECT_THAT(all("SELECT c.cycle, l.act, l.left_mps, l.age_ground_ms, l.age_light_ms, l.event"
                  " FROM v_real_cycles AS c LEFT JOIN v_real_log_cycles AS l"
                  " USING (run, cycle, robot) WHERE c.robot = 1 AND c.cycle IN (1, 2, 4)"),
              ElementsAre(Cells{"1", "step", "0.3", "80", "NULL", "NULL"},
                          Cells{"2", "NULL", "NULL", "NULL", "NULL", "NULL"},
                          Cells{"4", "hold", "0", "80", "NULL", "proximity is silent"}));
  EXPECT_THAT(
      all("SELECT name, state, verdict, skipped, latency_s, latency_reason FROM v_real_logs"),
      ElementsAre(Cells{"rvr1", "ended", "VALID", "0", "0.061", "NULL"},
                  Cells{"rvr2", "NULL", "NULL", "1", "NULL", "its commands did not move it"}));
}

TEST_F(RealRunsTest, SayWhatTheyWereAskedAndWhatCouldNotBe) {
  added(synthetic_real_run(1, kWinner));
  EXPECT_THAT(all("SELECT name, subject, outcome, value, bound, unit, reason FROM v_real_checks"),
              ElementsAre(Cells{"film covers the run", "NULL", "passed", "0.3333333333333333",
                                "0.5", "s", "NULL"},
                          Cells{"scale of the tag", "rvr1", "warned", "2", "1", "%", "NULL"},
                          Cells{"motion as commanded", "rvr2", "not run", "NULL", "NULL", "NULL",
                                "its commands did not move it"}));
  {
    sqlite::Connection connection(path.string(), SQLITE_OPEN_READWRITE);
    connection.execute("DELETE FROM real_check WHERE number = 2");
  }
  EXPECT_THAT(open_reader(path)->integrity(),
              ElementsAre(HasSubstr("r1 lacks rows of its checks")));
}

TEST_F(RealRunsTest, ALostRowOfALogIsFound) {
  added(synthetic_real_run(1, kWinner));
  {
    sqlite::Connection connection(path.string(), SQLITE_OPEN_READWRITE);
    connection.execute("DELETE FROM real_log_cycle WHERE cycle = 3 AND robot = 0");
  }
  EXPECT_THAT(open_reader(path)->integrity(),
              ElementsAre(HasSubstr("r1 lacks rows of its log_cycles")));
}

TEST_F(RealRunsTest, WhatIsWrongIsRefusedAndNothingIsWritten) {
  RealRunRows rows = synthetic_real_run(1, {999'999});
  const Error refused = why_not(opened()->add_real_run(rows));
  EXPECT_EQ(refused.kind, ErrorKind::NotFound);
  EXPECT_THAT(refused.message, HasSubstr("no candidate c999999"));
  rows = synthetic_real_run(1, kWinner);
  rows.cycles.back().x = std::nan("");
  EXPECT_THROW(static_cast<void>(opened()->add_real_run(rows)), std::invalid_argument);
  rows = synthetic_real_run(1, kWinner);
  rows.robots[1].offset_calibration = "unheard of";
  EXPECT_THROW(static_cast<void>(opened()->add_real_run(rows)), std::invalid_argument);
  rows = synthetic_real_run(1, kWinner);
  rows.cycles.push_back(rows.cycles.back());  // twice: no store takes that
  EXPECT_FALSE(opened()->add_real_run(rows));
  for (const Cells& table : all("SELECT name FROM sqlite_schema WHERE type = 'table' AND"
                                " name LIKE 'real%' OR name = 'calibration'"))
    EXPECT_EQ(all("SELECT count(*) FROM " + table[0])[0], Cells{"0"}) << table[0];
}

TEST_F(RealRunsTest, AreScoredAgainFromTheSameSightings) {
  const RealRunRows rows = synthetic_real_run(1, kWinner);
  const RealRunId id = added(rows);
  RealRunRows again = rows;
  again.calibrations[1].sha256 = again.videos[0].place_calibration = "mended";
  again.calibrations[1].made = "2026-11-20T10:00:00Z";
  again.cycles.pop_back();
  again.cycles.pop_back();
  again.robots[0].outliers = 9;
  again.samples[0].x += 0.01;
  again.samples[2].time_s += 0.004;
  again.samples[1].robot = -1;
  again.samples[1].x = again.samples[1].y = again.samples[1].theta = 0;
  again.issues.clear();
  again.logs[1].latency_s = 0.2;
  again.logs[1].latency_error_s = 0.001;
  again.logs[1].latency_reason = "";
  again.log_cycles.pop_back();
  again.patches.pop_back();
  again.checks.pop_back();
  again.checks[0].outcome = "failed";
  again.score.score = 4;
  again.score.verdict = "DEGRADED";
  const auto done = opened()->rescore_real_run(id, again);
  ASSERT_TRUE(done) << to_string(done.error());
  EXPECT_EQ(stored(id), in_order(again));
  EXPECT_THAT(open_reader(path)->integrity(), IsEmpty());
  EXPECT_THAT(all("SELECT scoring, score, verdict FROM v_real_scores"),
              ElementsAre(Cells{"1", "1.25", "VALID"}, Cells{"2", "4", "DEGRADED"}));
  EXPECT_THAT(all("SELECT score, verdict, scorings FROM v_real_runs"),
              ElementsAre(Cells{"4", "DEGRADED", "2"}));
  // The old calibration stays, and ends where the new one begins.
  EXPECT_THAT(all("SELECT valid_from, valid_until, uses FROM v_calibrations"
                  " WHERE kind = 'place' AND subject = 'ceiling' ORDER BY valid_from"),
              ElementsAre(Cells{"2026-11-01T11:00:00Z", "2026-11-20T10:00:00Z", "0"},
                          Cells{"2026-11-20T10:00:00Z", "NULL", "1"}));
  again.samples[2].corners[3] += 1;
  EXPECT_EQ(why_not(opened()->rescore_real_run(id, again)).kind, ErrorKind::BadInput);
  EXPECT_EQ(opened()->rescore_real_run({7}, rows).error().kind, ErrorKind::NotFound);
}

/// The key follows from the videos and the start.
TEST_F(RealRunsTest, AreScoredAgainWithAnotherStartAndKeepTheirHistory) {
  const RealRunRows rows = synthetic_real_run(1, kWinner);
  const RealRunId id = added(rows);
  ASSERT_TRUE(opened()->add_override({id, "INVALID", "A. Person", "pushed"}));
  RealRunRows again = rows;
  again.key = "of the right start";
  const auto done = opened()->rescore_real_run(id, again);
  ASSERT_TRUE(done) << to_string(done.error());
  EXPECT_EQ(stored(id), in_order(again));
  EXPECT_THAT(open_reader(path)->integrity(), IsEmpty());
  EXPECT_THAT(all("SELECT count(*) FROM v_real_scores"), ElementsAre(Cells{"2"}));
  // The person saw another start.
  EXPECT_THAT(all("SELECT verdict FROM v_real_runs"), ElementsAre(Cells{rows.score.verdict}));
  EXPECT_FALSE(opened()->add_real_run(again)->is_new);
  const RealRunRows other = synthetic_real_run(2, kWinner);
  added(other);
  again.key = other.key;
  const Error refused = why_not(opened()->rescore_real_run(id, again));
  EXPECT_EQ(refused.kind, ErrorKind::Conflict);
  EXPECT_THAT(refused.message, HasSubstr("r2 is that run"));
}

TEST_F(RealRunsTest, CountAmongTheScoresOfTheirDesignWhenTheyCanBeTrusted) {
  const CandidateId best{std::stoll(all("SELECT best_candidate FROM v_designs")[0][0])};
  RealRunRows invalid = synthetic_real_run(2, best);
  invalid.score.verdict = "INVALID";
  RealRunRows biased = synthetic_real_run(3, best);
  biased.score.biased = true;
  RealRunRows degraded = synthetic_real_run(4, best);
  degraded.score.verdict = "DEGRADED";
  added(synthetic_real_run(1, best));
  added(invalid);
  added(biased);
  added(degraded);
  added(synthetic_real_run(5, {}));
  const std::string scores =
      "SELECT design, candidate, source, purpose, pair, instance, seed, score FROM v_design_scores"
      " WHERE source = 'real' ORDER BY score";
  const std::string winner = std::to_string(best.value);
  EXPECT_THAT(all(scores),
              ElementsAre(Cells{"1", winner, "real", "score", "NULL", "NULL", "NULL", "1.25"},
                          Cells{"1", winner, "real", "score", "NULL", "NULL", "NULL", "4.25"}));
  EXPECT_THAT(all("SELECT id, design, status, used, pair, attempt FROM v_evaluations"
                  " WHERE source = 'real' ORDER BY score"),
              ElementsAre(Cells{"r1", "1", "ok", "1", "NULL", "NULL"},
                          Cells{"r4", "1", "ok", "1", "NULL", "NULL"}));
  const auto store = opened();
  ASSERT_TRUE(store->add_override({{2}, "VALID", "ada", "the gap was nowhere near a border"}));
  ASSERT_TRUE(store->add_override({{3}, "VALID", "ada", "offset is 1 mm"}));
  ASSERT_TRUE(store->add_override({{1}, "INVALID", "bob", "a robot was pushed"}));
  EXPECT_EQ(all(scores).size(), 3U);
  EXPECT_THAT(all("SELECT id, verdict, measured_verdict, overridden_by, counts FROM v_real_runs"),
              ElementsAre(Cells{"r1", "INVALID", "VALID", "bob", "0"},
                          Cells{"r2", "VALID", "INVALID", "ada", "1"},
                          Cells{"r3", "VALID", "VALID", "ada", "1"},
                          Cells{"r4", "DEGRADED", "DEGRADED", "NULL", "1"},
                          Cells{"r5", "VALID", "VALID", "NULL", "1"}));
  // The last word counts.
  ASSERT_TRUE(store->add_override({{2}, "INVALID", "bob", "it was"}));
  EXPECT_EQ(all(scores).size(), 2U);
  EXPECT_EQ(digest_of(path), digest);
}

TEST_F(RealRunsTest, AnOverrideHoldsForTheScoringThatThePersonSaw) {
  RealRunRows rows = synthetic_real_run(1, kWinner);
  rows.score.verdict = "INVALID";
  const RealRunId id = added(rows);
  ASSERT_TRUE(opened()->add_override({id, "VALID", "ada", "the gap was nowhere near a border"}));
  const auto now = [&] {
    return all(
        "SELECT verdict, measured_verdict, overridden_by, reason, counts, scorings"
        " FROM v_real_runs")[0];
  };
  const Cells by_ada{"VALID", "INVALID", "ada", "the gap was nowhere near a border", "1"};
  const auto of_scoring = [](Cells cells, const char* scoring) {
    cells.emplace_back(scoring);
    return cells;
  };
  EXPECT_EQ(now(), of_scoring(by_ada, "1"));
  // The same again: what ada saw.
  ASSERT_TRUE(opened()->rescore_real_run(id, rows));
  EXPECT_EQ(now(), of_scoring(by_ada, "2"));
  EXPECT_THAT(all("SELECT number, scoring FROM v_real_overrides"), ElementsAre(Cells{"1", "2"}));
  EXPECT_THAT(open_reader(path)->integrity(), IsEmpty());
  // Other inputs, with the same score and verdict.
  rows.log += "# another start\n";
  ASSERT_TRUE(opened()->rescore_real_run(id, rows));
  EXPECT_EQ(now(), (Cells{"INVALID", "INVALID", "NULL", "NULL", "0", "3"}));
  EXPECT_THAT(all("SELECT number, scoring, who FROM v_real_overrides"),
              ElementsAre(Cells{"1", "2", "ada"}));
  const auto heads = open_reader(path)->real_runs();
  ASSERT_EQ(heads.size(), 1U);
  EXPECT_EQ(heads[0].verdict, "INVALID");
  EXPECT_FALSE(heads[0].counts);
  // The same inputs, with another verdict.
  ASSERT_TRUE(opened()->add_override({id, "VALID", "bob", "seen"}));
  EXPECT_EQ(now()[0], "VALID");
  rows.score.verdict = "DEGRADED";
  ASSERT_TRUE(opened()->rescore_real_run(id, rows));
  EXPECT_EQ(now(), (Cells{"DEGRADED", "DEGRADED", "NULL", "NULL", "1", "4"}));
}

TEST_F(RealRunsTest, OverridesWantAVerdictANameAndAReason) {
  added(synthetic_real_run(1, kWinner));
  const auto store = opened();
  EXPECT_THAT(store->add_override({{1}, "FINE", "ada", "x"}).error().message,
              HasSubstr("use one of VALID, DEGRADED, INVALID"));
  EXPECT_EQ(store->add_override({{1}, "VALID", "", "x"}).error().kind, ErrorKind::BadInput);
  EXPECT_EQ(store->add_override({{1}, "VALID", "ada", ""}).error().kind, ErrorKind::BadInput);
  EXPECT_EQ(store->add_override({{2}, "VALID", "ada", "x"}).error().kind, ErrorKind::NotFound);
}

TEST_F(RealRunsTest, MayBeTheFirstThingInAStore) {
  path = folder / "new.db";
  EXPECT_FALSE(opened()->add_real_run(synthetic_real_run(1, kWinner)));
  EXPECT_FALSE(fs::exists(path)) << "nothing was added";
  added(synthetic_real_run(1, {}));
  added(synthetic_real_run(2, {}));
  EXPECT_THAT(all("SELECT name, state, designs FROM v_campaign_status"),
              ElementsAre(Cells{"real runs", "imported", "0"}));
  EXPECT_THAT(
      all("SELECT id, candidate, design, score FROM v_real_runs"),
      ElementsAre(Cells{"r1", "NULL", "NULL", "1.25"}, Cells{"r2", "NULL", "NULL", "2.25"}));
  EXPECT_THAT(all("SELECT * FROM v_evaluations"), IsEmpty());
}

/// What a store holds of a run that was written, or of none.
void expect_all_or_nothing(const fs::path& path, const RealRunRows& rows, const std::string& when) {
  const auto reader = open_reader(path);
  EXPECT_THAT(reader->integrity(), IsEmpty()) << when;
  const auto heads = reader->real_runs();
  if (!heads.empty()) {
    EXPECT_EQ(*reader->real_run(heads[0].id), in_order(rows)) << when;
    return;
  }
  EXPECT_EQ(cells_of(*reader,
                     "SELECT (SELECT count(*) FROM real_sample) +"
                     " (SELECT count(*) FROM real_cycle) +"
                     " (SELECT count(*) FROM calibration)")[0],
            Cells{"0"})
      << when;
}

TEST_F(RealRunsTest, AFullDiskAtAnyChangeLeavesAllOrNothing) {
  const RealRunRows rows = synthetic_real_run(1, kWinner);
  std::int64_t refusals = 0;
  for (const int code : {SQLITE_FULL, SQLITE_IOERR_WRITE, SQLITE_IOERR_FSYNC}) {
    bool failed = true;
    for (std::int64_t n = 1; failed && n < 500; ++n) {
      const fs::path copy = folder / "copy.db";
      fs::copy_file(path, copy, fs::copy_options::overwrite_existing);
      FaultyDisk disk;
      {
        auto store = value_of(StoreAtRest::open(copy, IfMissing::Refuse));
        const std::int64_t before = disk.changes();
        disk.fail_at(n, code, 1'000'000);
        const auto written = store->add_real_run(rows);
        failed = !written || disk.changes() >= before + n;
        if (!written) {
          ++refusals;
          EXPECT_EQ(written.error().kind, ErrorKind::Unavailable);
          EXPECT_THAT(written.error().message, HasSubstr("nothing was added"));
        }
        disk.fail_at(1, SQLITE_OK);
      }
      expect_all_or_nothing(copy, rows, "change " + std::to_string(n));
      // And there is room again.
      auto store = value_of(StoreAtRest::open(copy, IfMissing::Refuse));
      EXPECT_TRUE(store->add_real_run(rows));
    }
  }
  EXPECT_GT(refusals, 10);
}

TEST_F(RealRunsTest, APowerCutAtAnyChangeLeavesAllOrNothing) {
  const RealRunRows rows = synthetic_real_run(1, kWinner);
  bool was_cut = true;
  for (std::int64_t n = 1; was_cut && n < 500; ++n) {
    const fs::path copy = folder / "copy.db";
    fs::copy_file(path, copy, fs::copy_options::overwrite_existing);
    FaultyDisk disk;
    disk.cut_power_at(n);
    bool written = false;
    if (auto store = StoreAtRest::open(copy, IfMissing::Refuse); store)
      written = (*store)->add_real_run(rows).has_value();
    was_cut = disk.power_is_off();
    Rng rng(static_cast<std::uint64_t>(n));
    disk.restart(rng);
    auto store = StoreAtRest::open(copy, IfMissing::Refuse);
    ASSERT_TRUE(store) << "cut at change " << n << ": " << to_string(store.error());
    expect_all_or_nothing(copy, rows, "cut at change " + std::to_string(n));
    EXPECT_GE(open_reader(copy)->real_runs().size(), written ? 1U : 0U) << "acknowledged";
  }
}

/// Writes runs until it is killed, and tells the number of each that was acknowledged.
[[noreturn]] void write_until_killed(const fs::path& path, std::int64_t first, int to) {
  auto store = StoreAtRest::open(path, IfMissing::Refuse);
  if (!store) ::_exit(1);
  for (std::int64_t number = first;; ++number) {
    const auto written =
        (*store)->add_real_run(synthetic_real_run(static_cast<std::uint64_t>(number), kWinner));
    if (!written) ::_exit(2);
    (void)!::write(to, &number, sizeof number);
  }
}

TEST_F(RealRunsTest, AKilledWriterLeavesWholeRunsAndAllThatItAcknowledged) {
  Rng rng(11);
  std::int64_t known = 0;
  for (int round = 1; round <= 20; ++round) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) write_until_killed(path, known + 1, ends[1]);
    ::close(ends[1]);
    std::int64_t acknowledged = known;
    const std::uint64_t last_words = 1 + rng.below(3);
    for (std::uint64_t i = 0; i < last_words; ++i)
      ASSERT_EQ(::read(ends[0], &acknowledged, sizeof acknowledged), 8);
    // At some point of the next run, which takes some milliseconds.
    ::usleep(static_cast<useconds_t>(rng.below(8000)));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    while (::read(ends[0], &acknowledged, sizeof acknowledged) == 8)
      continue;
    ::close(ends[0]);
    const auto reader = open_reader(path);
    EXPECT_THAT(reader->integrity(), IsEmpty());
    const auto heads = reader->real_runs();
    known = static_cast<std::int64_t>(heads.size());
    EXPECT_GE(known, acknowledged);
    const auto last = static_cast<std::uint64_t>(known);
    EXPECT_EQ(*reader->real_run(heads.back().id), in_order(synthetic_real_run(last, kWinner)));
  }
}

}  // namespace
}  // namespace swarmsmith
