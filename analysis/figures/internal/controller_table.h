#pragma once

#include <string>
#include <vector>

#include "analysis/figures/machine_figure.h"

namespace swarmsmith {

/// A table of texts with named columns.
struct ControllerTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< as many fields as columns

  /// Adds the rows of another table, each with the fields of `begin` in front. Columns with the
  /// same name are merged; new columns come last and are empty in earlier rows.
  void add(const ControllerTable& other, const std::vector<std::string>& begin);
  /// The table as a CSV file.
  std::string text() const;
};

/// One row for each state and transition of a machine, each subtree of a tree, or each input of a
/// network.
ControllerTable controller_table(const StoredController& stored);

}  // namespace swarmsmith
