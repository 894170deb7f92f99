#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coordinator/campaign/campaign_rows.h"
#include "irace_core/search/stage.h"
#include "storage/rows.h"

namespace swarmsmith {

/// Logs rows as they are written: events of workers, designs and races.
class RowLog {
 public:
  /// `searches`: those of each campaign; the log uses other words for them than for races.
  explicit RowLog(std::vector<Searches> searches = {}) : searches_(std::move(searches)) {}

  /// `campaign` is its index in the coordinator; none: the row belongs to the pool.
  void add(std::optional<std::size_t> campaign, const std::string& name, const Row& row);

 private:
  const SearchWords& words_of_design(std::optional<std::size_t> campaign, DesignId design) const;

  std::vector<Searches> searches_;
  /// The last state of each design: a race repeats it after each step, and only a change is logged.
  std::map<std::pair<std::size_t, DesignId>, DesignState> states_;
};

}  // namespace swarmsmith
