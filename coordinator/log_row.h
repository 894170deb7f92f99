#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "storage/rows.h"

namespace swarmsmith {

/// Writes lines of the log about rows as they come: what happened to workers, designs and races.
/// Those of the pool, which every campaign's store gets, are written once.
class RowLog {
 public:
  /// `campaign` is its place among those of the coordinator.
  void add(std::size_t campaign, const std::string& name, const Row& row);

 private:
  /// Of a design: a race tells it after each step, and only another one is news.
  std::map<std::pair<std::size_t, DesignId>, DesignState> states_;
};

}  // namespace swarmsmith
