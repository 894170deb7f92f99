#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "storage/rows.h"

namespace swarmsmith {

/// Writes lines of the log about rows as they come: what happened to workers, designs and races.
class RowLog {
 public:
  /// `campaign` is its place among those of the coordinator; none: the row is of the pool.
  void add(std::optional<std::size_t> campaign, const std::string& name, const Row& row);

 private:
  /// Of a design: a race tells it after each step, and only another one is news.
  std::map<std::pair<std::size_t, DesignId>, DesignState> states_;
};

}  // namespace swarmsmith
