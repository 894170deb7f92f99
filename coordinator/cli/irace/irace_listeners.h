#pragma once

#include <optional>

#include "coordinator/cli/progress.h"
#include "coordinator/cli/run_listener.h"

namespace swarmsmith::cli {

/// Keeps the last attempt that gave no cost; tells all to another one.
class FailureWatch final : public RunListener {
 public:
  explicit FailureWatch(RunListener& next) : next_(next) {}

  void restore(const DesignStateRow& row) override { next_.restore(row); }
  void add(const Row& row, TimePoint now) override;
  void update(const LiveStatus& live, TimePoint now) override { next_.update(live, now); }
  void finish(const LiveStatus& live) override { next_.finish(live); }

  const std::optional<FailureRow>& last() const { return last_; }

 private:
  RunListener& next_;
  std::optional<FailureRow> last_;
};

/// The events of `run --json` with costs in place of scores.
class CostEvents final : public RunListener {
 public:
  explicit CostEvents(Progress& progress) : progress_(progress) {}

  void restore(const DesignStateRow& row) override { progress_.restore(row); }
  void add(const Row& row, TimePoint now) override;
  void update(const LiveStatus& live, TimePoint now) override { progress_.update(live, now); }
  void finish(const LiveStatus& live) override { progress_.finish(live); }

 private:
  Progress& progress_;
};

}  // namespace swarmsmith::cli
