#pragma once

#include <cstddef>
#include <optional>
#include <variant>

#include "base/clock.h"
#include "coordinator/service/live_status.h"
#include "storage/rows.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// The progress of a design, a user's command, or the tests of a design's winner so far.
using StoredProgress = std::variant<DesignStateRow, CommandRow, TestedDesign>;

/// Receives the progress of campaigns. It is an abstract class because people, programs and irace's
/// users need different output. A campaign is named by its index among the running campaigns; a row
/// without an index belongs to their shared pool. All calls come from one thread.
class RunListener {
 public:
  virtual ~RunListener() = default;

  /// A part of the stored state of a continued campaign.
  virtual void restore(std::size_t campaign, const StoredProgress& stored) = 0;
  /// A new row; rows come in order.
  virtual void add(std::optional<std::size_t> campaign, const Row& row, TimePoint now) = 0;
  /// Called several times a second.
  virtual void update(const LiveStatus& live, TimePoint now) = 0;
  /// Called at the end, after all other calls.
  virtual void finish(const LiveStatus& live) = 0;
};

}  // namespace swarmsmith::cli
