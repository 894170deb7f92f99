#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace swarmsmith::cli {

/// A column of texts below its name.
struct TableColumn {
  std::string name;
  std::vector<std::string> cells;
};

/// Formats a column of numbers as R prints it: all with as many decimals as the number that needs
/// most of them at seven significant digits, or in scientific form if that is shorter; "NA" for a
/// missing value.
std::vector<std::string> real_cells(std::span<const std::optional<double>> values);

/// A table as R prints a data frame, without breaking lines (irace facts, 24): row names on the
/// left, columns aligned on the right with a blank between two of them. Each line ends with a line
/// feed.
std::string aligned_table(const std::vector<std::string>& row_names,
                          const std::vector<TableColumn>& columns);

}  // namespace swarmsmith::cli
