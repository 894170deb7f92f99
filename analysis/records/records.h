#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "base/id.h"
#include "storage/store.h"

namespace swarmsmith {

/// What figures, tables and tests of a paper begin with: rows of the store's views
/// (docs/storage.md) as plain values, in the order of the view's keys. They read nothing but the
/// views, so that anyone can have the same numbers by SQL.

/// A figure of more could not be drawn.
inline constexpr StoreReader::QueryLimits kRecordLimits{
    .rows = 50'000'000,
    .seconds = 600,
    .bytes = std::numeric_limits<std::int64_t>::max(),
    .memory = std::int64_t{1} << 30U};

/// A score that a finished design's winner got outside of its race.
struct DesignScore {
  DesignId design;
  std::string mission;
  std::string method;
  std::int64_t repetition = 0;
  CandidateId candidate;
  std::string source;   ///< a simulator profile, `real`, or what an import called it
  std::string purpose;  ///< `test` (on the campaign's own seeds), `score` (asked for later)
  /// A `score` that its campaign made itself: a test under a further profile of [tests].
  bool is_transfer = false;
  std::int64_t pair = 0;
  std::int64_t instance = 0;
  std::int64_t seed = 0;
  double score = 0;
};

/// A campaign that the store holds.
struct CampaignRecord {
  std::int64_t campaign = 0;  ///< its number in the store, from 1
  std::string name;
  std::int64_t seed = 0;
  std::string digest;  ///< of what decides its answer
  std::string file;    ///< normalised
};

/// A design and its best machine, the winner when it is finished.
struct DesignRecord {
  DesignId design;
  std::string mission;
  std::string method;
  std::int64_t repetition = 0;
  std::string state;
  std::int64_t budget = 0;
  std::int64_t used = 0;
  std::int64_t iteration = 0;
  std::optional<CandidateId> best;
  std::optional<double> best_mean;
  std::string machine;  ///< of the best; text of the grammar, empty without one
  /// That it is written in; empty for the parameters of a program, and in stores of a schema before
  /// 4 that no program has written to since.
  std::string flavour;
};

/// A machine that a design tried.
struct MachineRecord {
  CandidateId candidate;
  DesignId design;
  std::string mission;
  std::string method;
  std::int64_t repetition = 0;
  std::string machine;  ///< text of the grammar, or a program's configuration
  std::string flavour;  ///< as in DesignRecord
};

/// An elite at the end of an iteration.
struct EliteRecord {
  DesignId design;
  std::int64_t iteration = 0;
  std::int64_t rank = 0;
  CandidateId candidate;
  double mean = 0;
  std::int64_t runs = 0;
  std::int64_t experiments_used = 0;
};

/// A candidate on the pair of one step of a race.
struct RaceCell {
  std::int64_t step = 0;
  std::int64_t pair = 0;
  CandidateId candidate;
  std::optional<double> score;  ///< none when rejected
  std::optional<double> rank;   ///< 1 is best, ties share their mean
};

/// A step of a race, and the test after it.
struct StepRecord {
  std::int64_t step = 0;
  std::int64_t iteration = 0;
  std::int64_t pair = 0;
  std::optional<std::int64_t> instance;  ///< of the pair, as in v_race_matrix
  std::optional<std::int64_t> seed;
  std::string marker;
  std::int64_t alive_before = 0;
  std::int64_t alive_after = 0;
  std::optional<CandidateId> best;
  double mean_best = 0;
  std::int64_t used = 0;
  std::optional<double> statistic;
  std::optional<double> p_value;
};

struct EliminationRecord {
  CandidateId candidate;
  std::int64_t iteration = 0;
  std::int64_t step = 0;
  std::string reason;
};

/// An iteration, one race of a design.
struct IterationRecord {
  std::int64_t iteration = 0;
  std::int64_t planned = 0;  ///< iterations planned when it began
  std::int64_t budget = 0;   ///< experiments that it could use
  std::int64_t configurations = 0;
  bool postselection = false;  ///< the race after the last, with what was left
};

/// A candidate and how it did in the races.
struct SampledRecord {
  CandidateId candidate;
  std::int64_t iteration = 0;  ///< that it was sampled in
  std::int64_t runs = 0;
  std::optional<double> mean;
};

/// How often machines have a module, everywhere and in the states that can be reached from the
/// first one: the others do nothing.
struct ModuleCounts {
  double average_occurrences = 0;  ///< in a machine
  double occurrence_rate = 0;      ///< part of the machines that have it
  double average_reachable = 0;
  double reachable_rate = 0;
};

/// How often the winners of a mission and method have a module.
struct ModuleFrequency {
  std::string mission;
  std::string method;
  std::string module;
  std::optional<ModuleCounts> counts;  ///< none: the method's flavour has no such module
};

/// A parameter of a candidate.
struct ParameterRecord {
  CandidateId candidate;
  std::int64_t iteration = 0;
  std::string parameter;
  std::string value;
  bool is_number = false;
};

/// The selection; an empty field selects all.
struct RecordFilter {
  std::string mission;
  std::string method;
  std::optional<DesignId> design;
};

/// Errors: BadInput with SQLite's words when a view is missing (a store of an older schema) or the
/// time limit of a query was too short.
Expected<std::vector<CampaignRecord>> campaigns(StoreReader& store);
Expected<std::vector<DesignScore>> design_scores(StoreReader& store, const RecordFilter& filter);
Expected<std::vector<DesignRecord>> designs(StoreReader& store, const RecordFilter& filter);
/// NotFound when the store has no such candidate.
Expected<MachineRecord> candidate(StoreReader& store, CandidateId id);
Expected<std::vector<EliteRecord>> elites(StoreReader& store, const RecordFilter& filter);
Expected<std::vector<ModuleFrequency>> module_frequencies(StoreReader& store,
                                                          const RecordFilter& filter);
/// Of one design, and one of its iterations.
Expected<std::vector<RaceCell>> race_cells(StoreReader& store, DesignId design,
                                           std::int64_t iteration);
/// How the design was searched for, by the name of its search (docs/methods.md); empty for an
/// iterated race.
std::string search_of(StoreReader& store, DesignId design);
Expected<std::vector<IterationRecord>> iterations(StoreReader& store, DesignId design);
/// All that a design tried, in the order in which they were sampled.
Expected<std::vector<SampledRecord>> candidates(StoreReader& store, DesignId design);
Expected<std::vector<StepRecord>> race_steps(StoreReader& store, DesignId design,
                                             std::int64_t iteration);
Expected<std::vector<EliminationRecord>> eliminations(StoreReader& store, DesignId design,
                                                      std::int64_t iteration);
/// The last iteration of the design that has a step; 0 before the first.
Expected<std::int64_t> last_raced_iteration(StoreReader& store, DesignId design);
/// Of the candidates of one design, or of some of them.
Expected<std::vector<ParameterRecord>> parameters(StoreReader& store, DesignId design,
                                                  const std::vector<CandidateId>& candidates = {});

/// The rows of a statement over the store's views as CSV (base/text/csv.h): a header, full
/// precision, null empty. Errors: as above.
Expected<std::string> csv_of_rows(StoreReader& store, const std::string& sql);

}  // namespace swarmsmith
