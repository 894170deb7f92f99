#pragma once

#include <string>

#include "base/expected.h"
#include "base/text/json.h"
#include "cli/arguments/thing_id.h"
#include "cli/output/query_output.h"
#include "cli/output/stored_stages.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// Everything that the store knows of one evaluation, the outcome last.
struct EvaluationHistory {
  Rows candidate;
  Rows evaluation;  ///< none while it has no outcome
  Rows steps;       ///< of the race, in which it counted
  Rows attempts;    ///< leases that did not simply end with the result
  Rows failures;
  Rows conflicts;
  Rows worker;  ///< who gave the outcome
  StoredStages stages{};
  std::string design{};

  /// Whether the store has anything of it.
  bool is_known() const {
    return !evaluation.cells.empty() || !attempts.cells.empty() || !failures.cells.empty();
  }
  /// Races have other words than searches without tests.
  bool is_race() const;
};

/// Empty parts where the store has nothing; `id` is of an evaluation. Errors: as a query's.
Expected<EvaluationHistory> read_history(StoreReader& store, const ThingId& id);

/// What asked for it, and for what: "the race of iteration 3, first in step 40".
std::string why(const EvaluationHistory& history);

/// As `explain --json` writes it.
JsonObject history_as_json(const std::string& id, const EvaluationHistory& history);

/// The text of a column of the first row; empty when it is null or there is no row.
std::string cell_text(const Rows& rows, const std::string& column);

}  // namespace swarmsmith::cli
