#include "cli/replay/real_replay.h"

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "analysis/arena/arena_panels.h"
#include "base/text/csv.h"
#include "cli/output/progress_text.h"
#include "sim/control/module.h"
#include "sim/mission/footprint.h"
#include "sim/mission/trajectory_csv.h"

namespace swarmsmith::cli {
namespace {

/// Names in the order of CycleKind in tracking, and a name for simulated poses.
std::string_view kind_text(std::int64_t kind) {
  constexpr std::array<std::string_view, 4> kKinds{"measured", "interpolated", "degraded",
                                                   "missing"};
  return kind < 0 || kind > 3 ? "" : kKinds.at(static_cast<std::size_t>(kind));
}
constexpr std::string_view kSimulated = "simulated";

ShownRun shown(const RealRunRows& rows, const FilmedRun& filmed, double score) {
  ShownRun run{.source = rows.source, .score = score, .instance = filmed.instance};
  for (std::size_t robot = 0; robot < rows.robots.size(); ++robot) {
    run.labels.push_back(rows.robots[robot].name);
    std::vector<Pose>& poses = run.robots.emplace_back();
    poses.push_back(filmed.instance.starts[robot]);
    for (int instant = 0; instant < filmed.trajectory.instants(); ++instant)
      poses.push_back(filmed.trajectory.at(instant)[robot]);
  }
  return run;
}

/// Whether a simulated swarm can start there: as many robots as in the mission, within the walls,
/// without overlaps.
bool can_start(const Mission& mission, const std::vector<Pose>& starts) {
  const double near_m = inradius_of(mission.robot.body.outline);
  if (starts.size() != static_cast<std::size_t>(mission.robots)) return false;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const Point here{starts[i].x, starts[i].y};
    if (!is_inside(mission.arena, here)) return false;
    for (std::size_t k = 0; k < i; ++k) {
      // Robots that are so near certainly overlap, whatever the errors of the film.
      if (std::hypot(starts[k].x - here.x, starts[k].y - here.y) < near_m) return false;
    }
  }
  return true;
}

/// The run's machine on a seed, in the filmed instance: from the real starts if a simulated swarm
/// can start there, else from drawn starts.
Expected<StoredRun> as_filmed(StoredRuns& runs, const RealRunRows& rows, const FilmedRun& filmed,
                              std::int64_t seed) {
  const ThingId machine{
      .letter = 'c', .digits = std::to_string(rows.candidate.value), .purpose = {}};
  auto run = runs.candidate(machine, seed);
  if (!run) return run;
  run->mission = filmed.mission;
  run->instance = filmed.instance;
  // The stored result for that seed belongs to other starts.
  run->id.clear();
  run->outcome.reset();
  if (can_start(filmed.mission, filmed.instance.starts)) return run;
  auto drawn = instance_of(filmed.mission, seed);
  if (!drawn) return Unexpected(drawn.error());
  run->instance.starts = std::move(drawn->starts);
  return run;
}

Unexpected no_machine(RealRunId id) {
  return bad_input("the run names no candidate: there is nothing to simulate beside it",
                   to_string(id));
}

ShownRun simulated(const StoredRun& stored) {
  ShownRun run{.source = stored.profile.name, .seed = stored.seed, .instance = stored.instance};
  const auto observe = [&](const Snapshot& snapshot) {
    run.robots.resize(snapshot.robots.size());
    run.labels.resize(snapshot.robots.size());
    run.objects.resize(snapshot.objects.size());
    for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
      run.robots[i].push_back(snapshot.robots[i].pose);
      run.labels[i] = acting_in(stored.controller, snapshot.robots[i].state);
    }
    for (std::size_t i = 0; i < snapshot.objects.size(); ++i)
      run.objects[i].push_back(snapshot.objects[i]);
  };
  run.score = simulate(stored.setup(), Recorder(observe)).score;
  return run;
}

}  // namespace

Expected<RealReplay> replay_real_run(std::unique_ptr<StoreReader> store, RealRunId id,
                                     const std::vector<std::int64_t>& seeds) {
  auto rows = store->real_run(id);
  if (!rows) return Unexpected(rows.error());
  auto filmed = filmed_run(*rows);
  if (!filmed) return Unexpected(filmed.error());
  RealReplay replay{.rows = std::move(*rows), .verdict = {}, .filmed = std::move(*filmed)};
  for (const RealRunHead& head : store->real_runs())
    if (head.id == id) replay.verdict = head.verdict;
  replay.score = score_again(replay.filmed);
  replay.runs.push_back(shown(replay.rows, replay.filmed, replay.score));
  if (seeds.empty()) return replay;
  if (!replay.rows.candidate) return no_machine(id);
  auto runs = StoredRuns::open(std::move(store));
  if (!runs) return Unexpected(runs.error());
  replay.starts_as_real = can_start(replay.filmed.mission, replay.filmed.instance.starts);
  for (const std::int64_t seed : seeds) {
    const auto run = as_filmed(*runs, replay.rows, replay.filmed, seed);
    if (!run) return Unexpected(run.error());
    replay.runs.push_back(simulated(*run));
  }
  return replay;
}

Expected<StoredRun> simulation_beside(std::unique_ptr<StoreReader> store, RealRunId id,
                                      std::int64_t seed) {
  const auto rows = store->real_run(id);
  if (!rows) return Unexpected(rows.error());
  const auto filmed = filmed_run(*rows);
  if (!filmed) return Unexpected(filmed.error());
  if (!rows->candidate) return no_machine(id);
  auto runs = StoredRuns::open(std::move(store));
  if (!runs) return Unexpected(runs.error());
  return as_filmed(*runs, *rows, *filmed, seed);
}

std::string picture_of(const RealReplay& replay, RealRunId id, double width_mm) {
  const RealRunRows& rows = replay.rows;
  std::string who = to_string(id) + " " + rows.name;
  if (!rows.recorded.empty()) who += ", " + rows.recorded;
  if (rows.candidate) who += ", " + to_string(rows.candidate);
  ArenaPanels panels{.title = replay.filmed.mission.name,
                     .details = {who, "hollow: start, solid: end; the floor is drawn paler"},
                     .pictures = {},
                     .width_mm = width_mm};
  if (!replay.starts_as_real) panels.details.emplace_back("simulations start elsewhere");
  for (const ShownRun& run : replay.runs) {
    const bool is_real = &run == &replay.runs.front();
    ArenaPicture picture{
        .title = is_real ? run.source : fmt::format("{}, seed {}", run.source, run.seed),
        .details = {"score " + score_text(run.score)},
        .arena = arena_of(replay.filmed.mission, run.instance),
        .body = replay.filmed.mission.robot.body.outline,
        .robots = {},
        .objects = run.objects};
    if (is_real) picture.details.front() += ", " + replay.verdict;
    for (std::size_t robot = 0; robot < run.robots.size(); ++robot)
      picture.robots.push_back({run.robots[robot], run.labels[robot]});
    panels.pictures.push_back(std::move(picture));
  }
  return draw(panels);
}

std::string table_of(const RealReplay& replay, RealRunId id) {
  std::string csv = "run,source,seed,";
  csv += kTrajectoryColumns;
  csv += ",kind";
  csv += kCsvLineEnd;
  for (const ShownRun& run : replay.runs) {
    const bool is_real = &run == &replay.runs.front();
    const std::string first = is_real ? to_string(id) + "," + csv_field(run.source) + ",,"
                                      : fmt::format(",{},{},", csv_field(run.source), run.seed);
    const std::size_t robots = run.robots.size();
    for (std::size_t cycle = 0; cycle < run.robots.front().size(); ++cycle) {
      for (std::size_t robot = 0; robot < robots; ++robot) {
        csv += first;
        append_pose_cells(csv, static_cast<int>(cycle), static_cast<int>(robot),
                          run.robots[robot][cycle]);
        csv += ',';
        csv += is_real ? kind_text(replay.rows.cycles[cycle * robots + robot].kind) : kSimulated;
        csv += kCsvLineEnd;
      }
    }
  }
  return csv;
}

}  // namespace swarmsmith::cli
