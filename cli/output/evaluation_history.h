#pragma once

#include <string>

#include "base/expected.h"
#include "base/text/json.h"
#include "cli/arguments/thing_id.h"
#include "cli/output/query_output.h"
#include "cli/output/stored_stages.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// Everything that the store knows about one evaluation; the result comes last.
struct EvaluationHistory {
  Rows candidate;
  Rows evaluation;  ///< empty until there is a result
  Rows steps;       ///< steps of the race that used it
  Rows attempts;    ///< leases that did not simply end with the result, or were not the only one
  Rows failures;
  Rows conflicts;
  Rows worker;  ///< the worker that returned the result
  StoredStages stages{};
  std::string design{};

  /// Whether the store has any facts about it.
  bool is_known() const {
    return !evaluation.cells.empty() || !attempts.cells.empty() || !failures.cells.empty();
  }
  /// Races are described in other words than searches without tests.
  bool is_race() const;
};

/// Parts are empty if the store has nothing about them. `id` must be the id of an evaluation.
/// Errors: as for a query.
Expected<EvaluationHistory> read_history(StoreReader& store, const ThingId& id);

/// The part of the campaign that asked for it: "the race of iteration 3, first in step 40".
std::string why(const EvaluationHistory& history);

/// The JSON of `explain --json`.
JsonObject history_as_json(const std::string& id, const EvaluationHistory& history);

/// The text of a column in the first row; empty if it is null or there are no rows.
std::string cell_text(const Rows& rows, const std::string& column);

}  // namespace swarmsmith::cli
