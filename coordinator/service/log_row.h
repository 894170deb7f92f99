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

/// Writes lines of the log about rows as they come: what happened to workers, designs and races.
class RowLog {
 public:
  /// The searches of each campaign: their words are not those of races.
  explicit RowLog(std::vector<Searches> searches = {}) : searches_(std::move(searches)) {}

  /// `campaign` is its place among those of the coordinator; none: the row is of the pool.
  void add(std::optional<std::size_t> campaign, const std::string& name, const Row& row);

 private:
  const SearchWords& words_of_design(std::optional<std::size_t> campaign, DesignId design) const;

  std::vector<Searches> searches_;
  /// Of a design: a race tells it after each step, and only another one is news.
  std::map<std::pair<std::size_t, DesignId>, DesignState> states_;
};

}  // namespace swarmsmith
