#pragma once

#include <functional>
#include <string>

#include "base/expected.h"
#include "proto/result.h"
#include "proto/task.h"

namespace swarmsmith {

/// Evaluates tasks of one scenario (of each campaign in it): a score and its state digest, a
/// rejection, or a failure, and the time that a target says; the rest of the result is the
/// caller's. An exception is a failure with its text. Called from one thread at a time, so that it
/// may keep what it parsed.
using Evaluator = std::function<Result(const LeasedTask&)>;

/// Makes an evaluator for a slot from the scenario's bytes. Errors: a scenario that this program
/// cannot run.
using EvaluatorFactory = std::function<Expected<Evaluator>(const std::string& scenario)>;

}  // namespace swarmsmith
