#pragma once

#include <cstdint>

#include "base/measured.h"
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
  Measured measured{};
  std::int64_t worker = 0;  ///< WorkerRow::id
  std::int64_t attempt = 1;
};

}  // namespace swarmsmith
