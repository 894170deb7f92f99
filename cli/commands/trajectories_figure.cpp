#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "analysis/arena/arena_panels.h"
#include "analysis/records/names.h"
#include "cli/commands/runs_from_above.h"
#include "cli/commands/simulated_figures.h"
#include "cli/output/progress_text.h"
#include "cli/output/query_output.h"
#include "cli/replay/stored_runs.h"
#include "sim/control/module.h"
#include "sim/mission/trajectory_csv.h"

namespace swarmsmith::cli {
namespace {

constexpr std::int64_t kTests = 4;
constexpr std::int64_t kTestsOfReport = 2;

/// The candidate to draw: the named one, or the best one of the design.
Expected<CandidateId> candidate_of(StoreReader& store, const FigureOptions& options) {
  if (options.candidate) return *options.candidate;
  const auto found = designs(store, options.filter);
  if (!found) return Unexpected(found.error());
  if (found->size() != 1) {
    return bad_input("no machine given; add --candidate c812, or --design d3 for its winner",
                     "figure trajectories");
  }
  if (found->front().best) return *found->front().best;
  return unexpected(ErrorKind::NotFound, "this design has no best machine yet", "--design");
}

/// Seeds of the first stored tests by simulation.
Expected<std::vector<std::int64_t>> seeds_of_tests(StoreReader& store, CandidateId candidate,
                                                   std::int64_t most) {
  const auto rows = select(store,
                           "SELECT seed FROM v_evaluations WHERE purpose = 'test' AND "
                           "seed IS NOT NULL AND score IS NOT NULL AND candidate = " +
                               std::to_string(candidate.value) + " ORDER BY pair",
                           {.rows = most});
  if (!rows) return Unexpected(rows.error());
  std::vector<std::int64_t> seeds;
  for (const auto& cells : rows->cells)
    seeds.push_back(cells.front().integer());
  if (!seeds.empty()) return seeds;
  return unexpected(
      ErrorKind::NotFound,
      "the store has no tests of " + to_string(candidate) + "; name the seeds: --seed 7 --seed 8",
      "--candidate");
}

/// Adds the run's picture to the panels, and its rows to the table.
Expected<void> film(const StoredRun& run, ArenaPanels& panels, std::string& csv) {
  ArenaPicture picture{.title = "seed " + std::to_string(run.seed),
                       .details = {},
                       .arena = arena_of(run.mission, run.instance),
                       .body = run.mission.robot.body.outline,
                       .robots = {},
                       .objects = {}};
  std::string rows;
  const auto observe = [&](const Snapshot& snapshot) {
    picture.robots.resize(snapshot.robots.size());
    picture.objects.resize(snapshot.objects.size());
    for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
      picture.robots[i].poses.push_back(snapshot.robots[i].pose);
      picture.robots[i].label = acting_in(run.controller, snapshot.robots[i].state);
      rows += run.candidate + "," + std::to_string(run.seed) + ",";
      append_pose_cells(rows, snapshot.cycle, static_cast<int>(i), snapshot.robots[i].pose);
      rows += kCsvLineEnd;
    }
    for (std::size_t i = 0; i < snapshot.objects.size(); ++i)
      picture.objects[i].push_back(snapshot.objects[i]);
  };
  const Measured result = simulate(run.setup(), Recorder(observe));
  if (run.outcome && !same_bits(*run.outcome, result)) {
    return unexpected(ErrorKind::Conflict,
                      "this run differs from the stored one; `swarmsmith replay " +
                          (run.id.empty() ? run.candidate : run.id) + "` tells more",
                      "seed " + std::to_string(run.seed));
  }
  picture.details = {"score " + score_text(result.score)};
  panels.pictures.push_back(std::move(picture));
  csv += rows;
  return {};
}

/// Runs of one machine from above, side by side, and a table with one row per robot and instant.
/// The runs are simulated again: of the named candidate, else of the design's winner; on the given
/// seeds, else on the seeds of the first stored tests.
///
/// Errors: BadInput (no machine is named, a run cannot be simulated), NotFound (no such tests),
/// Conflict if a stored run does not give the same bits again.
Expected<Figure> film_all(StoreReader& store, const FigureOptions& options,
                          std::int64_t most_tests) {
  const auto candidate = candidate_of(store, options);
  if (!candidate) return Unexpected(candidate.error());
  auto wanted = options.seeds;
  if (wanted.empty()) {
    auto stored = seeds_of_tests(store, *candidate, most_tests);
    if (!stored) return Unexpected(stored.error());
    wanted = std::move(*stored);
  }
  auto runs = StoredRuns::open(store);
  if (!runs) return Unexpected(runs.error());
  const ThingId id{.letter = 'c', .digits = std::to_string(candidate->value), .purpose = {}};
  ArenaPanels panels{
      .title = {},
      .details = {to_string(*candidate) + "; hollow: start, solid: end; the floor is drawn paler"},
      .pictures = {},
      .width_mm = options.width_mm};
  Figure figure;
  figure.csv = "candidate,seed,";
  figure.csv += kTrajectoryColumns;
  figure.csv += kCsvLineEnd;
  for (const std::int64_t seed : wanted) {
    const auto run = runs->candidate(id, seed);
    if (!run) return Unexpected(run.error());
    panels.title = as_words(run->mission.name);
    if (const auto filmed = film(*run, panels, figure.csv); !filmed)
      return Unexpected(filmed.error());
  }
  if (options.paper) panels.details.clear();
  figure.svg = draw(panels);
  return figure;
}

}  // namespace

FigureKind trajectories_figure() {
  return {.name = "trajectories",
          .summary = "Runs of a machine from above, simulated again, side by side",
          .make = [](StoreReader& store,
                     const FigureOptions& options) { return film_all(store, options, kTests); },
          .options = "design candidate seed"};
}

Expected<std::string> runs_from_above(const StoreArgument& argument, DesignId design) {
  auto store = argument.open();
  if (!store) return Unexpected(store.error());
  auto figure = film_all(**store, {.filter = {.design = design}}, kTestsOfReport);
  if (!figure) return Unexpected(figure.error());
  return std::move(figure->svg);
}

}  // namespace swarmsmith::cli
