#pragma once

#include "base/clock.h"
#include "coordinator/live_status.h"
#include "storage/rows.h"

namespace swarmsmith::cli {

/// Who is told how a campaign goes: an abstract class because people, programs and irace's users
/// want to be told differently. All calls come from one thread.
class RunListener {
 public:
  virtual ~RunListener() = default;

  /// How far a design was when the campaign goes on from its store.
  virtual void restore(const DesignStateRow& row) = 0;
  /// A row that became due, in order.
  virtual void add(const Row& row, TimePoint now) = 0;
  /// Several times a second.
  virtual void update(const LiveStatus& live, TimePoint now) = 0;
  /// Nothing more will come.
  virtual void finish(const LiveStatus& live) = 0;
};

}  // namespace swarmsmith::cli
