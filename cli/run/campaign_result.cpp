#include "cli/run/campaign_result.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <vector>

#include "analysis/statistics/summary.h"
#include "base/plain_text.h"
#include "base/shown_text.h"
#include "base/text/json.h"
#include "cli/output/progress_text.h"
#include "cli/output/query_output.h"
#include "cli/output/stored_stages.h"
#include "programs/cost.h"

namespace swarmsmith::cli {
namespace {

using Cell = StoreReader::Cell;

constexpr const char* kResult =
    "SELECT d.design, d.mission, d.method, d.repetition, d.state, d.used, "
    "d.best_candidate AS candidate, d.best_mean AS race_mean, (SELECT c.fsm_config "
    "FROM v_candidates AS c WHERE c.candidate = d.best_candidate) AS fsm_config, d.reason "
    "FROM v_designs AS d ORDER BY d.design";
constexpr const char* kTests = "SELECT design, score FROM v_design_scores WHERE purpose = 'test'";

Expected<std::map<std::string, std::vector<double>>> tests_by_design(StoreReader& store) {
  const auto rows = select(store, kTests);
  if (!rows) return Unexpected(rows.error());
  std::map<std::string, std::vector<double>> scores;
  for (const auto& cells : rows->cells) {
    scores[cells[0].text].push_back(cells[1].real());
  }
  return scores;
}

Cell number_cell(double value) {
  return {Cell::Type::Real, json_number(value)};
}

/// Adds the columns test_mean, test_95 (half-width of the interval) and test_runs before the last
/// two columns.
void add_tests(Rows& rows, const std::map<std::string, std::vector<double>>& tests) {
  for (const char* name : {"test_mean", "test_95", "test_runs"}) {
    rows.columns.insert(rows.columns.end() - 2, name);
  }
  for (auto& cells : rows.cells) {
    std::vector<Cell> added(3);
    if (const auto found = tests.find(cells[0].text); found != tests.end()) {
      const MeanInterval interval = mean_interval(found->second);
      // A single value has no interval.
      const bool several = found->second.size() > 1;
      added = {number_cell(interval.mean),
               several ? number_cell(interval.half_width) : Cell{},
               {Cell::Type::Integer, std::to_string(found->second.size())}};
    }
    cells.insert(cells.end() - 2, added.begin(), added.end());
  }
}

/// Programs return costs, and scores are negative costs; their users want to see costs again.
Expected<bool> shows_costs(StoreReader& store) {
  const auto rows = select(store, "SELECT 1 FROM v_evaluations WHERE source = 'command' LIMIT 1");
  if (!rows) return Unexpected(rows.error());
  return !rows->cells.empty();
}

/// A mean, formatted for people.
std::string shown(const std::string& text, bool as_cost = false) {
  const double score = std::strtod(text.c_str(), nullptr);
  return score_text(as_cost ? to_cost(score) : score);
}

/// The name of the part of the search that gave the winner's mean.
std::string place_of_mean(const StoredStages& stages, const std::string& design) {
  const SearchOptions* search = stages.search(design);
  if (search == nullptr || words_of(*search).has_tests) return "the race";
  const std::string stage = stages.round(design);
  return stage == "final stage" ? "the final stage" : stage;
}

/// One paragraph per design: its description, the quality of its machine, and the machine.
void write_text(Output& output, const Rows& rows, const StoredStages& stages, bool costs) {
  for (const auto& cells : rows.cells) {
    const auto text = [&](std::size_t column) {
      return as_shown(cells[column].text, Layout::Escaped);
    };
    const bool has_race = text(5) != "0";
    output.out << text(0) << "  " << text(1) << ", " << text(2) << ", repetition " << text(3)
               << ": " << text(4)
               << (has_race ? " after " + counted(cells[5].integer(), "experiment")
                            : ", without a race");
    if (text(4) == "stopped" && !text(12).empty()) output.out << ": " << text(12);
    output.out << "\n";
    if (cells[6].type == Cell::Type::Null) continue;
    const std::string mean = costs ? "mean cost " : "mean score ";
    output.out << (has_race ? "  best " : "  ") << text(6);
    if (has_race) {
      output.out << ", " << mean << shown(cells[7].text, costs) << " in "
                 << place_of_mean(stages, text(0));
    }
    if (cells[8].type != Cell::Type::Null) {
      output.out << ", " << (has_race ? "" : mean) << shown(cells[8].text, costs);
      if (cells[9].type != Cell::Type::Null) {
        output.out << " +- " << shown(cells[9].text) << " (95 %)";
      }
      // A program is tested on test instances, or on fresh seeds of the training instances.
      output.out << " on " << text(10) << (costs ? " tests" : " fresh seeds");
    }
    output.out << "\n  " << text(11) << "\n";
  }
}

}  // namespace

ExitCode write_result(Output& output, StoreReader& store, const std::string& name) {
  auto rows = select(store, kResult);
  if (!rows) return fail(output, ExitCode::Store, rows.error());
  const auto tests = tests_by_design(store);
  if (!tests) return fail(output, ExitCode::Store, tests.error());
  const auto costs = shows_costs(store);
  if (!costs) return fail(output, ExitCode::Store, costs.error());
  add_tests(*rows, *tests);
  letter_ids(*rows);
  const auto stages = StoredStages::read(store);
  if (!stages) return fail(output, ExitCode::Store, stages.error());
  if (output.json) {
    JsonObject event;
    event.add("v", 1).add("event", "done").add("designs", rows_as_json(*rows));
    if (!name.empty()) event.add("campaign", name);
    output.out << event.text() << "\n";
  } else {
    if (!name.empty()) output.out << "campaign " << as_shown(name, Layout::Escaped) << "\n";
    write_text(output, *rows, *stages, *costs);
  }
  // A cancelled design has not failed.
  const bool failed = std::ranges::any_of(rows->cells, [](const auto& cells) {
    return cells[4].text == "stopped" && cells[12].text != "cancelled";
  });
  return failed ? ExitCode::Failed : ExitCode::Done;
}

void print_next_steps(Output& output, const std::string& store, bool has_winner, bool is_demo) {
  if (output.quiet) return;
  output.err << "\nEverything is in " << store << ". How to continue:\n"
             << "  swarmsmith dashboard " << store << "\n"
             << "  swarmsmith report " << store << " -o report.html\n";
  if (has_winner) {
    output.err << "  swarmsmith ls elites " << store << "\n"
               << "  swarmsmith export " << store << " --design d1 -o best.fsm\n";
  }
  output.err << "  swarmsmith query " << store << "\n";
  if (is_demo) output.err << "  swarmsmith init mine, to design for a mission of your own\n";
}

}  // namespace swarmsmith::cli
