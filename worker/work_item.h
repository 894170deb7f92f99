#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "base/expected.h"
#include "proto/key.h"

namespace swarmsmith {

/// One evaluation that a worker holds a lease of; indices into the scenario.
struct WorkItem {
  PackedKey key = 0;
  std::int64_t attempt = 0;
  std::uint32_t mission = 0;
  std::uint32_t method = 0;
  std::int64_t instance = 0;
  std::int64_t seed = 0;
  std::string machine;  ///< text of the grammar
};

/// What came of it: a score, or the reason why there is none.
struct Evaluated {
  PackedKey key = 0;
  std::int64_t attempt = 0;
  double score = 0;
  std::uint64_t state_digest = 0;
  std::int64_t wall_us = 0;
  std::string failure{};  ///< empty when there is a score
};

/// Score and state digest of an item; an error or an exception is a failure with that text.
struct Measured {
  double score = 0;
  std::uint64_t state_digest = 0;
};

/// Evaluates items of one scenario; called from one thread at a time, so that it may keep what it
/// parsed.
using Evaluator = std::function<Expected<Measured>(const WorkItem&)>;

/// Makes an evaluator for a slot. Errors: a scenario that this program cannot run.
using EvaluatorFactory = std::function<Expected<Evaluator>(const std::string& scenario)>;

}  // namespace swarmsmith
