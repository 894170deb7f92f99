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

/// Scores of a CSV table, made elsewhere: of robots, or of another simulator. Columns, in any
/// order:
///
/// - who: `candidate` (c812 or 812), `design` (d3 or 3: its winner), `fsm_id` or `name` (of an
///   imported machine), or `mission`, `method`, `repetition`, as many as it takes to name one
///   design. Where several are given, they must agree;
/// - `score` (larger is better) or `cost` (smaller is better: the score is -cost);
/// - `source`, `seed`, `instance`, `time` (of the run, >= 0) and `note`, which may be missing or
///   empty. Without a seed, a candidate's rows of one source are its runs 1, 2, ...

/// What the rows are read against.
struct ScoreImport {
  MissionWords missions;
  std::string source;                 ///< of rows without one; may be empty
  std::vector<std::string> costs_of;  ///< missions (as called here) whose `score` is a cost
  bool replace = false;               ///< another score for a known place is taken
  std::vector<KnownDesign> designs;
  std::function<bool(CandidateId)> has_candidate;  ///< asked for candidates that won nothing
};

/// What the table comes to.
struct ImportedScores {
  Addition addition;
  std::int64_t added = 0;
  std::int64_t replaced = 0;
  std::int64_t known = 0;             ///< were there before, with the same score
  std::vector<std::string> not_read;  ///< columns that say nothing to an import
};

/// Whether a table's columns are those of scores.
bool has_scores(const CsvTable& table);

/// All that is wrong, with the line of each.
OrErrors<ImportedScores> import_scores(const CsvTable& table, const ScoreImport& known,
                                       ScoreLedger ledger);

}  // namespace swarmsmith
