#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/records/records.h"
#include "base/expected.h"

namespace swarmsmith {

/// One parameter for all candidates of a design.
struct ParameterColumn {
  std::string name;
  std::string words{};  ///< the name for people
  /// For a parameter that is drawn value by value: words in alphabetical order, or at most seven
  /// whole numbers in numerical order. Empty for a parameter that is drawn along an axis.
  std::vector<std::string> categories;
  double low = 0;  ///< smallest number
  double high = 0;
  bool is_whole = false;  ///< the numbers are whole
  std::vector<double>
      values;              ///< one per candidate: index in `categories`, or number; NaN: inactive
  std::size_t active = 0;  ///< number of candidates that have it

  bool is_category() const { return !categories.empty(); }
};

struct ParameterTable {
  std::vector<SampledRecord> candidates;  ///< in the order in which they were sampled
  std::vector<ParameterColumn> columns;   ///< sorted by name

  /// The index of a candidate; the number of candidates if it is not in the table.
  std::size_t row_of(CandidateId candidate) const;
};

ParameterTable parameter_table(std::vector<SampledRecord> candidates,
                               const std::vector<ParameterRecord>& records);

/// Reads the table. Errors: NotFound if the design has no candidates or they have no parameters.
Expected<ParameterTable> read_parameter_table(StoreReader& store, DesignId design);

/// How much the distribution of a parameter changed during the race: the total variation distance,
/// 0 to 1, between the first and the last third of the candidates. Numbers are divided into tenths
/// of their range; being inactive counts as a value.
double movement(const ParameterColumn& column);

/// The columns in a list such as "s0,tau0", in its order; none for an empty list. Errors: BadInput
/// for an unknown name (the message lists the known ones), or for more than `most`.
Expected<std::vector<std::size_t>> named_columns(const ParameterTable& table,
                                                 std::string_view names, std::size_t most);

}  // namespace swarmsmith
