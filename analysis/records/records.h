#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "base/id.h"
#include "storage/store.h"

namespace swarmsmith {

/// The data for a paper's figures, tables and tests: rows of the store's views (docs/storage.md) as
/// plain values, in the order of the view's keys. Only the views are read, so that everyone can get
/// the same numbers by SQL.

/// A figure with more rows could not be drawn.
inline constexpr StoreReader::QueryLimits kRecordLimits{
    .rows = 50'000'000,
    .seconds = 600,
    .bytes = std::numeric_limits<std::int64_t>::max(),
    .memory = std::int64_t{1} << 30U};

/// A score of a finished design's winner from outside its race.
struct DesignScore {
  DesignId design;
  std::string mission;
  std::string method;
  std::int64_t repetition = 0;
  CandidateId candidate;
  std::string source;   ///< a simulator profile, `real`, or a name from an import
  std::string purpose;  ///< `test` (on the campaign's own seeds), `score` (evaluated later)
  /// A `score` that the campaign itself made: a test under a further profile of [tests].
  bool is_transfer = false;
  std::int64_t pair = 0;
  std::int64_t instance = 0;
  std::int64_t seed = 0;
  double score = 0;
};

/// A campaign in the store.
struct CampaignRecord {
  std::int64_t campaign = 0;  ///< its number in the store, from 1
  std::string name;
  std::int64_t seed = 0;
  std::string digest;  ///< of the settings that decide its answer
  std::string file;    ///< the normalised file
};

/// A design and its best machine; that is the winner if the design is finished.
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
  std::string machine;  ///< text of the best machine in the grammar; empty if there is none
  /// Flavour of the machine's text. Empty for the parameters of a program, and in stores with a
  /// schema before 4 that no program has written to since.
  std::string flavour;
};

/// A machine that a design tried.
struct MachineRecord {
  CandidateId candidate;
  DesignId design;
  std::string mission;
  std::string method;
  std::int64_t repetition = 0;
  std::string machine;  ///< text in the grammar, or a program's configuration
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

/// The evaluation of a candidate on the pair of one step of a race.
struct RaceCell {
  std::int64_t step = 0;
  std::int64_t pair = 0;
  CandidateId candidate;
  std::optional<double> score;  ///< empty if rejected
  std::optional<double> rank;   ///< 1 is best; ties share their mean rank
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

/// An iteration, which is one race of a design.
struct IterationRecord {
  std::int64_t iteration = 0;
  std::int64_t planned = 0;  ///< iterations planned when it began
  std::int64_t budget = 0;   ///< maximum number of experiments
  std::int64_t configurations = 0;
  bool postselection = false;  ///< an additional race at the end, with the remaining budget
};

/// A candidate and its results in the races.
struct SampledRecord {
  CandidateId candidate;
  std::int64_t iteration = 0;  ///< in which it was sampled
  std::int64_t runs = 0;
  std::optional<double> mean;
};

/// How often machines have a module, counted in all states and in the states reachable from the
/// first one; other states have no effect.
struct ModuleCounts {
  double average_occurrences = 0;  ///< per machine
  double occurrence_rate = 0;      ///< share of machines that have it
  double average_reachable = 0;
  double reachable_rate = 0;
};

/// How often the winners of a mission and method have a module.
struct ModuleFrequency {
  std::string mission;
  std::string method;
  std::string module;
  std::optional<ModuleCounts> counts;  ///< empty: the method's flavour does not have this module
};

/// A parameter of a candidate.
struct ParameterRecord {
  CandidateId candidate;
  std::int64_t iteration = 0;
  std::string parameter;
  std::string value;
  bool is_number = false;
};

/// The selection; an empty field selects everything.
struct RecordFilter {
  std::string mission;
  std::string method;
  std::optional<DesignId> design;
};

/// Errors: BadInput with SQLite's message if a view is missing (a store with an older schema) or
/// the time limit of a query was too short.
Expected<std::vector<CampaignRecord>> campaigns(StoreReader& store);
/// Whether the normalised file of a campaign gives this key a text.
Expected<bool> has_key(StoreReader& store, std::string_view key);
Expected<std::vector<DesignScore>> design_scores(StoreReader& store, const RecordFilter& filter);
Expected<std::vector<DesignRecord>> designs(StoreReader& store, const RecordFilter& filter);
/// NotFound if the store has no such candidate.
Expected<MachineRecord> candidate(StoreReader& store, CandidateId id);
Expected<std::vector<EliteRecord>> elites(StoreReader& store, const RecordFilter& filter);
Expected<std::vector<ModuleFrequency>> module_frequencies(StoreReader& store,
                                                          const RecordFilter& filter);
/// Cells of one iteration of a design.
Expected<std::vector<RaceCell>> race_cells(StoreReader& store, DesignId design,
                                           std::int64_t iteration);
/// The name of the design's search (docs/methods.md); empty for iterated racing.
std::string search_of(StoreReader& store, DesignId design);
Expected<std::vector<IterationRecord>> iterations(StoreReader& store, DesignId design);
/// All candidates that a design tried, in the order in which they were sampled.
Expected<std::vector<SampledRecord>> candidates(StoreReader& store, DesignId design);
Expected<std::vector<StepRecord>> race_steps(StoreReader& store, DesignId design,
                                             std::int64_t iteration);
Expected<std::vector<EliminationRecord>> eliminations(StoreReader& store, DesignId design,
                                                      std::int64_t iteration);
/// The design's last iteration that has a step; 0 if there is none yet.
Expected<std::int64_t> last_raced_iteration(StoreReader& store, DesignId design);
/// For all candidates of a design, or only for the given ones.
Expected<std::vector<ParameterRecord>> parameters(StoreReader& store, DesignId design,
                                                  const std::vector<CandidateId>& candidates = {});

/// The rows of a statement over the store's views as CSV (base/text/csv.h): a header, full
/// precision, null is empty. Errors: as above.
Expected<std::string> csv_of_rows(StoreReader& store, const std::string& sql);

}  // namespace swarmsmith
