#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "base/text/csv.h"
#include "coordinator/results/import_words.h"
#include "coordinator/results/known_designs.h"
#include "coordinator/results/score_ledger.h"
#include "storage/store_at_rest.h"

namespace swarmsmith {

/// Imports scores that were obtained elsewhere, with robots or another simulator, from a CSV table.
/// Columns, in any order:
///
/// - the candidate: `candidate` (c812 or 812), `design` (d3 or 3: its winner), `fsm_id` or `name`
///   (of an imported machine), or as many of `mission`, `method` and `repetition` as are needed to
///   select one design. If several are given, they must agree;
/// - `score` (larger is better) or `cost` (smaller is better: the score is -cost);
/// - `source`, `seed`, `instance`, `time` (of the run, >= 0) and `note`, all optional and possibly
///   empty. Rows without a seed count as runs 1, 2, ... of their candidate and source.

/// The data that the import needs besides the table.
struct ScoreImport {
  MissionWords missions;
  std::string source;                 ///< for rows that name none; may be empty
  std::vector<std::string> costs_of;  ///< missions (by their names here) whose `score` is a cost
  bool replace = false;               ///< accept a different score for a known place
  std::vector<KnownDesign> designs;
  std::function<bool(CandidateId)> has_candidate;  ///< called for candidates that did not win
};

/// The result of importing a table.
struct ImportedScores {
  Addition addition;
  std::int64_t added = 0;
  std::int64_t replaced = 0;
  std::int64_t known = 0;             ///< already in the store, with the same score
  std::vector<std::string> not_read;  ///< columns that an import ignores
};

/// Whether a table's columns contain scores.
bool has_scores(const CsvTable& table);

/// Errors: all problems, each with its line.
OrErrors<ImportedScores> import_scores(const CsvTable& table, const ScoreImport& known,
                                       ScoreLedger ledger);

}  // namespace swarmsmith
