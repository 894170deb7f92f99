#include "coordinator/cli/campaign_result.h"

#include "coordinator/cli/query_output.h"

namespace swarmsmith::cli {
namespace {

constexpr const char* kResult =
    "SELECT d.design, d.mission, d.method, d.repetition, d.state, d.used, "
    "d.best_candidate AS candidate, d.best_mean AS race_mean, l.test_mean, l.test_runs, "
    "c.fsm_config FROM v_designs AS d LEFT JOIN v_leaderboard AS l ON l.design = d.design "
    "LEFT JOIN v_candidates AS c ON c.candidate = d.best_candidate ORDER BY d.design";

}  // namespace

ExitCode write_result(Output& output, StoreReader& store) {
  auto rows = select(store, kResult);
  if (!rows) return fail(output, ExitCode::Store, rows.error());
  letter_ids(*rows);
  if (output.json) {
    output.out << "{\"v\":1,\"event\":\"done\",\"designs\":" << rows_as_json(*rows) << "}\n";
    return ExitCode::Done;
  }
  // The machines are longer than a line of the table.
  std::string machines;
  for (auto& cells : rows->cells) {
    if (!cells.back().text.empty()) machines += cells[6].text + "  " + cells.back().text + "\n";
    cells.pop_back();
  }
  rows->columns.pop_back();
  output.out << rows_as_text(*rows) << "\n" << machines;
  return ExitCode::Done;
}

}  // namespace swarmsmith::cli
