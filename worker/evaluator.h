#pragma once

#include <functional>
#include <string>

#include "base/expected.h"
#include "proto/result.h"
#include "proto/task.h"

namespace swarmsmith {

/// Evaluates tasks of one scenario (with all its campaigns). The result contains a score and its
/// state digest, a rejection, or a failure, and the time that a target reports; the caller fills in
/// the rest. An exception is a failure with the exception's text. Called by one thread at a time,
/// so that it may cache parsed texts.
using Evaluator = std::function<Result(const LeasedTask&)>;

/// Makes an evaluator for one slot from the scenario's bytes. Errors: a scenario that this program
/// cannot run.
using EvaluatorFactory = std::function<Expected<Evaluator>(const std::string& scenario)>;

}  // namespace swarmsmith
