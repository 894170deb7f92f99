#pragma once

#include "cli/output/progress.h"
#include "cli/output/run_listener.h"

namespace swarmsmith::cli {

/// The events of `run --json` with costs in place of scores.
class CostEvents final : public RunListener {
 public:
  explicit CostEvents(Progress& progress) : progress_(progress) {}

  void restore(std::size_t campaign, const Row& row) override { progress_.restore(campaign, row); }
  void add(std::optional<std::size_t> campaign, const Row& row, TimePoint now) override;
  void update(const LiveStatus& live, TimePoint now) override { progress_.update(live, now); }
  void finish(const LiveStatus& live) override { progress_.finish(live); }

 private:
  Progress& progress_;
};

}  // namespace swarmsmith::cli
