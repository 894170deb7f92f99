#pragma once

#include <cstddef>
#include <optional>

#include "base/clock.h"
#include "coordinator/service/live_status.h"
#include "storage/rows.h"

namespace swarmsmith::cli {

/// Receives the progress of campaigns: an abstract class because people, programs and irace's users
/// need different output. A campaign is named by its index among those that run; a row without one
/// belongs to their pool. All calls come from one thread.
class RunListener {
 public:
  virtual ~RunListener() = default;

  /// The stored state of a continued campaign: progress of its designs, and people's commands.
  virtual void restore(std::size_t campaign, const Row& row) = 0;
  /// A row that became due, in order.
  virtual void add(std::optional<std::size_t> campaign, const Row& row, TimePoint now) = 0;
  /// Several times a second.
  virtual void update(const LiveStatus& live, TimePoint now) = 0;
  /// The end: no more calls follow.
  virtual void finish(const LiveStatus& live) = 0;
};

}  // namespace swarmsmith::cli
