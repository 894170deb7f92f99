#pragma once

#include <cstdint>

#include "base/measured.h"
#include "proto/task.h"
#include "storage/rows.h"

namespace swarmsmith {

/// One evaluation that the campaign wants, identified as in the store.
struct Task : EvaluationInput {
  EvaluationKey key;
  /// Index of the campaign in the coordinator, which sets it.
  std::uint32_t campaign = 0;
  /// No design waits for it yet: it is for a slot that would otherwise idle
  /// (WorkSource::take_more).
  bool ahead = false;
};

/// How a task ended, as reported by a worker.
struct Outcome {
  EvaluationKey key;
  std::uint32_t campaign = 0;
  EvaluationStatus status = EvaluationStatus::Ok;
  Measured measured{};
  std::int64_t worker = 0;  ///< WorkerRow::id
  std::int64_t attempt = 1;
};

}  // namespace swarmsmith
