#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/records/records.h"
#include "base/expected.h"

namespace swarmsmith {

/// A parameter over all candidates of a design.
struct ParameterColumn {
  std::string name;
  std::string words{};  ///< the name as people read it
  /// Of a parameter that is drawn value by value: words in their order, or at most seven whole
  /// numbers in theirs. Empty for one that is drawn along an axis.
  std::vector<std::string> categories;
  double low = 0;  ///< of the numbers
  double high = 0;
  bool is_whole = false;       ///< the numbers are
  std::vector<double> values;  ///< a candidate: place in `categories`, or number; NaN: not active
  std::size_t active = 0;      ///< candidates that have it

  bool is_category() const { return !categories.empty(); }
};

struct ParameterTable {
  std::vector<SampledRecord> candidates;  ///< in the order in which they were sampled
  std::vector<ParameterColumn> columns;   ///< by name

  /// Place of a candidate; the number of candidates when it is not there.
  std::size_t row_of(CandidateId candidate) const;
};

ParameterTable parameter_table(std::vector<SampledRecord> candidates,
                               const std::vector<ParameterRecord>& records);

/// Reads it. Errors: NotFound when the design has no candidates or they no parameters.
Expected<ParameterTable> read_parameter_table(StoreReader& store, DesignId design);

/// How much the distribution of a parameter changed while the race went on: total variation
/// distance, 0 to 1, between the first and the last third of the candidates; numbers in tenths of
/// their range, and not being active counts as a value.
double movement(const ParameterColumn& column);

/// The columns that a list such as "s0,tau0" names, in its order; none of an empty list. Errors:
/// BadInput for a name that is not there (with those that are), or for more than `most`.
Expected<std::vector<std::size_t>> named_columns(const ParameterTable& table,
                                                 std::string_view names, std::size_t most);

}  // namespace swarmsmith
