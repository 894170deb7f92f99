#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/expected.h"
#include "programs/failure_details.h"
#include "proto/key.h"

namespace swarmsmith {

/// One evaluation that a worker holds a lease of; indices into its campaign's scenario.
struct WorkItem {
  PackedKey key = 0;  ///< says the campaign too
  std::int64_t attempt = 0;
  std::uint64_t signature = 0;  ///< of its lease
  std::uint32_t mission = 0;
  std::uint32_t method = 0;
  /// From 1; of a call of a targetEvaluator in testing the negative of it.
  std::int64_t instance = 0;
  std::int64_t seed = 0;
  /// Text of the grammar; for a target the switches and values of its configuration.
  std::string machine;
  double bound = 0;  ///< most time that a target's run may take, in its unit; 0 for none
  /// Numbers (irace's ids) of the configurations that a targetEvaluator is told; else empty.
  std::vector<std::int64_t> alive{};
};

/// What came of it: a score, or the reason why there is none.
struct Evaluated {
  PackedKey key = 0;
  std::int64_t attempt = 0;
  double score = 0;
  std::uint64_t state_digest = 0;
  std::int64_t wall_us = 0;
  bool rejected = false;     ///< a target's word for it: neither score nor failure
  double time = 0;           ///< as a target says it, in its unit; 0 where it does not
  std::string failure{};     ///< empty when there is a score
  FailureDetails details{};  ///< of a failed target
};

/// Score and state digest of an item, or a rejection, which only targets know; and the time that a
/// target says, 0 where it does not.
struct Measured {
  double score = 0;
  std::uint64_t state_digest = 0;
  double time = 0;
  bool rejected = false;
};

/// Why there is no score.
struct Failure {
  std::string reason;
  FailureDetails details{};
};

/// Evaluates items of one scenario (of each campaign in it); an exception is a failure with its
/// text. Called from one thread at a time, so that it may keep what it parsed.
using Evaluator = std::function<tl::expected<Measured, Failure>(const WorkItem&)>;

/// Makes an evaluator for a slot from the scenario's bytes. Errors: a scenario that this program
/// cannot run.
using EvaluatorFactory = std::function<Expected<Evaluator>(const std::string& scenario)>;

}  // namespace swarmsmith
