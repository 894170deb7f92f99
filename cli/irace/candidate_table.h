#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "cli/irace/parameter_values.h"
#include "irace_core/parameter_space.h"
#include "storage/rows.h"

namespace swarmsmith::cli {

/// The candidates of a design, shown as irace shows configurations (irace facts, 24). Numbers are
/// irace's ids.
class CandidateTable {
 public:
  explicit CandidateTable(ParameterSpace space) : space_(std::move(space)) {}

  /// Corrupt if the row's parameters cannot be read.
  Expected<void> add(const CandidateRow& row);

  /// One line per configuration below the parameters' names: "NA" where a parameter is inactive.
  /// With `metadata` also the columns .ID. and .PARENT. around them.
  std::string configurations(std::span<const std::int64_t> numbers, bool metadata = false) const;
  /// One line per configuration: the number, padded to the longest one and two blanks, then
  /// switches and values. Users' scripts search for this format.
  std::string command_lines(std::span<const std::int64_t> numbers) const;
  /// The JSON object and the command line of a configuration; empty for an unknown number.
  std::string parameters(std::int64_t number) const;
  std::string command_line(std::int64_t number) const;

 private:
  struct Candidate {
    std::int64_t parent = 0;
    std::string parameters;
    ParameterValues values;
    std::string command_line;
  };

  std::vector<std::string> cells(std::size_t parameter,
                                 std::span<const std::int64_t> numbers) const;
  const Candidate* find(std::int64_t number) const;

  ParameterSpace space_;
  std::map<std::int64_t, Candidate> candidates_;
};

}  // namespace swarmsmith::cli
