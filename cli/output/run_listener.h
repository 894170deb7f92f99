#pragma once

#include <cstddef>
#include <optional>

#include "base/clock.h"
#include "coordinator/service/live_status.h"
#include "storage/rows.h"

namespace swarmsmith::cli {

/// Who is told how campaigns go: an abstract class because people, programs and irace's users
/// want to be told differently. A campaign is named by its place among those that run; without one,
/// a row is of the pool that they share. All calls come from one thread.
class RunListener {
 public:
  virtual ~RunListener() = default;

  /// What a campaign that goes on finds in its store: how far its designs were, and what people
  /// asked of them.
  virtual void restore(std::size_t campaign, const Row& row) = 0;
  /// A row that became due, in order.
  virtual void add(std::optional<std::size_t> campaign, const Row& row, TimePoint now) = 0;
  /// Several times a second.
  virtual void update(const LiveStatus& live, TimePoint now) = 0;
  /// Nothing more will come.
  virtual void finish(const LiveStatus& live) = 0;
};

}  // namespace swarmsmith::cli
