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

/// Compares finished designs by their winners' scores from outside the race. Only meaningful
/// comparisons are made: scores must belong to the same mission (others have other units), and a
/// pair is either the same designs in two sources, or two methods in the same source.

enum class CompareBy { Source, Method, Mission };

/// The selection to compare; an empty field selects everything.
struct ComparisonOptions {
  CompareBy by = CompareBy::Source;
  std::vector<std::string> missions;
  std::string method;
  std::string source;
  ScoreChoice choice;
};

/// The designs of a mission and method in one source.
struct ComparedGroup {
  std::string mission;
  std::string method;
  std::string source;
  std::size_t designs = 0;
  std::size_t runs = 0;
  Summary summary;  ///< of `values`
  std::vector<double>
      values;  ///< means of designs, or scores of runs; ordered by design, then pair
};

/// The same designs in two sources, or two methods.
struct ComparedPair {
  std::string mission;
  std::string method;  ///< of both; empty when methods are compared
  std::string source;  ///< of both; empty when sources are compared
  std::string first;
  std::string second;
  std::size_t n_first = 0;
  std::size_t n_second = 0;
  bool paired = false;  ///< signed-rank test, else rank-sum test
  WilcoxonTest test;
  std::optional<double> p_holm;  ///< corrected for all pairs of the comparison that have a p
  double a12 = 0.5;
  MeanDifference difference;       ///< of first - second
  std::vector<std::string> notes;  ///< caveats about this result
};

/// Friedman's test. When methods are compared, the blocks are missions (at least two), and the
/// values are the means of a method's designs; within a mission, the designs of two methods have
/// nothing in common, so the rank-sum tests compare them. When sources are compared, the blocks are
/// designs.
struct ComparedRanks {
  std::string source;              ///< of all; empty when sources are compared
  std::vector<std::string> names;  ///< of the methods or sources, in the order of `test.mean_ranks`
  std::vector<std::string> missions;
  std::size_t incomplete = 0;  ///< number of blocks left out because they lack a value
  FriedmanTest test;
};

struct Comparison {
  ComparisonOptions options;
  ScoreUnit unit = ScoreUnit::Design;  ///< the meaning of one value
  std::string said;                    ///< the meaning of one value as a sentence
  std::string tested;                  ///< the source of the campaign's own tests; empty: unknown
  std::vector<ComparedGroup> groups;   ///< ordered by mission, method, source
  std::vector<ComparedPair> pairs;
  std::vector<ComparedRanks> ranks;
  std::vector<std::string> notes;     ///< which data were left out, and why
  std::vector<std::string> unranked;  ///< those notes that explain why there are no ranks
  std::vector<std::string> seeds;     ///< texts about sources whose designs ran on different seeds
};

/// The number of tests that Holm's correction counts: those that have a p.
std::size_t corrected_tests(const std::vector<ComparedPair>& pairs);

/// A note for tests that are corrected together (Holm), if the values are so few that no data could
/// give a significant p; else nothing. `least_p`: the smallest exact p that any of the tests could
/// give.
std::optional<std::string> hopeless(std::size_t tests, double least_p);

/// Compares scores that were read already; applies the options' filters to them.
Comparison compare(const std::vector<DesignScore>& scores, const ComparisonOptions& options);

/// The same, with notes on the budgets of methods from the store's designs.
Expected<Comparison> compare(StoreReader& store, const std::vector<DesignScore>& scores,
                             const ComparisonOptions& options);

/// Reads the scores and compares them. Errors: NotFound (no such score; the message lists the
/// existing ones), and the errors of records.h.
Expected<Comparison> compare(StoreReader& store, const ComparisonOptions& options);

}  // namespace swarmsmith
