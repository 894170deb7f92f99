#pragma once

#include <cstdint>

#include "proto/task.h"
#include "storage/rows.h"

namespace swarmsmith {

/// One evaluation that the campaign wants, named as the store names it.
struct Task : EvaluationInput {
  EvaluationKey key;
  /// Place of the campaign among those of the coordinator, which sets it.
  std::uint32_t campaign = 0;
  /// No design waits for it yet: it keeps a slot busy that would idle (WorkSource::take_more).
  bool ahead = false;
};

/// How a task ended, as a worker reported it.
struct Outcome {
  EvaluationKey key;
  std::uint32_t campaign = 0;
  EvaluationStatus status = EvaluationStatus::Ok;
  double score = 0;
  std::uint64_t state_digest = 0;
  std::int64_t wall_us = 0;
  std::int64_t worker = 0;  ///< WorkerRow::id
  std::int64_t attempt = 1;
  double time = 0;  ///< as a target says it; 0 where it does not
};

}  // namespace swarmsmith
