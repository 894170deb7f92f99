#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/records/chosen_scores.h"
#include "analysis/records/records.h"
#include "analysis/statistics/bootstrap.h"
#include "analysis/statistics/friedman.h"
#include "analysis/statistics/summary.h"
#include "analysis/statistics/wilcoxon.h"
#include "base/expected.h"
#include "storage/store.h"

namespace swarmsmith {

/// Comparisons of finished designs by the scores that their winners got outside of the race. Only
/// what makes sense is compared: scores of one mission (others have other units), and either the
/// same designs in two sources, or two methods in the same source.

enum class CompareBy { Source, Method, Mission };

/// The selection to compare; an empty field takes all.
struct ComparisonOptions {
  CompareBy by = CompareBy::Source;
  std::vector<std::string> missions;
  std::string method;
  std::string source;
  ScoreChoice choice;
};

/// Designs of a mission and method in a source.
struct ComparedGroup {
  std::string mission;
  std::string method;
  std::string source;
  std::size_t designs = 0;
  std::size_t runs = 0;
  Summary summary;             ///< of `values`
  std::vector<double> values;  ///< a design's mean, or a run's score; by design, then pair
};

/// Two sources by the same designs, or two methods.
struct ComparedPair {
  std::string mission;
  std::string method;  ///< of both; empty by method
  std::string source;  ///< of both; empty by source
  std::string first;
  std::string second;
  std::size_t n_first = 0;
  std::size_t n_second = 0;
  bool paired = false;  ///< signed-rank, else rank-sum
  WilcoxonTest test;
  std::optional<double> p_holm;  ///< over all pairs of the comparison
  double a12 = 0.5;
  MeanDifference difference;       ///< of first - second
  std::vector<std::string> notes;  ///< what one should know before believing it
};

/// Friedman's test. By method its blocks are missions, at least two, and its values the means of a
/// method's designs: within a mission the methods' designs have nothing in common, and the rank-sum
/// tests compare them. By source its blocks are designs.
struct ComparedRanks {
  std::string source;              ///< of all; empty by source
  std::vector<std::string> names;  ///< of the methods or sources, as in `test.mean_ranks`
  std::vector<std::string> missions;
  std::size_t incomplete = 0;  ///< blocks that lack one of them, left out
  FriedmanTest test;
};

struct Comparison {
  ComparisonOptions options;
  ScoreUnit unit = ScoreUnit::Design;  ///< what one value is
  std::string said;                    ///< the same as a sentence
  std::string tested;                  ///< the source of the campaign's own tests; empty: unknown
  std::vector<ComparedGroup> groups;   ///< by mission, method, source
  std::vector<ComparedPair> pairs;
  std::vector<ComparedRanks> ranks;
  std::vector<std::string> notes;     ///< what was left out, and why
  std::vector<std::string> unranked;  ///< those of the notes that say why there are no ranks
  std::vector<std::string> seeds;     ///< sources whose designs ran on different seeds, in words
};

/// The level of all tests.
inline constexpr double kTestLevel = 0.05;

/// What must be said of tests that are corrected together (Holm), when the values are so few that
/// no data could give a p at the level; nothing when some could. `least_p`: the least exact p of
/// any of them.
std::optional<std::string> hopeless(std::size_t tests, double least_p);

/// Of scores that were read already; the options' filters are applied to them.
Comparison compare(const std::vector<DesignScore>& scores, const ComparisonOptions& options);

/// The same with what the store's designs say of methods' budgets.
Expected<Comparison> compare(StoreReader& store, const std::vector<DesignScore>& scores,
                             const ComparisonOptions& options);

/// Reads and compares. Errors: NotFound (no such score; says what there is), those of records.h.
Expected<Comparison> compare(StoreReader& store, const ComparisonOptions& options);

}  // namespace swarmsmith
