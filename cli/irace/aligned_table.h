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

/// Numbers as R prints a column of them: as many decimals for all as the one that needs most of
/// them has at seven significant digits, or the scientific form where that is shorter; "NA" for
/// none.
std::vector<std::string> real_cells(std::span<const std::optional<double>> values);

/// A table as R prints a data frame, without breaking lines (irace facts, 24): names of the rows on
/// the left, columns aligned on the right, a blank between two. Each line ends with a line feed.
std::string aligned_table(const std::vector<std::string>& row_names,
                          const std::vector<TableColumn>& columns);

}  // namespace swarmsmith::cli
