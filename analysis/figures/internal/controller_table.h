#pragma once

#include <string>
#include <vector>

#include "analysis/figures/machine_figure.h"

namespace swarmsmith {

/// A table of texts whose columns have names.
struct ControllerTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< as many fields as columns

  /// Adds the rows of a table behind `begin`, the first fields of each. Columns of the same name
  /// are one; new ones come last, and are empty in the rows before.
  void add(const ControllerTable& other, const std::vector<std::string>& begin);
  /// As a file.
  std::string text() const;
};

/// A row for each state and transition of a machine, each subtree of a tree, each input of a
/// network.
ControllerTable controller_table(const StoredController& stored);

}  // namespace swarmsmith
