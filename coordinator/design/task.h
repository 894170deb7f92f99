#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "storage/rows.h"

namespace swarmsmith {

/// One evaluation that the campaign wants: everything a worker must know besides the scenario.
struct Task {
  EvaluationKey key;
  /// Place of the campaign among those of the coordinator, which sets it.
  std::uint32_t campaign = 0;
  std::uint32_t mission = 0;  ///< index into the scenario's missions
  std::uint32_t method = 0;   ///< index into the scenario's methods
  /// From 1; of a call of a targetEvaluator in testing the negative of it.
  std::int64_t instance = 0;
  std::int64_t seed = 0;
  /// Text of the grammar; for a target the switches and values of its configuration.
  std::string machine;
  double bound = 0;  ///< most time that a target's run may take; 0 for none
  /// Numbers of the candidates that a targetEvaluator is told (purpose Evaluator); else empty.
  std::vector<std::int64_t> alive{};
  /// Nobody waits for it yet: it keeps a slot busy that would idle (WorkSource::take_more).
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
