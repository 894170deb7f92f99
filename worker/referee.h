#pragma once

#include "worker/evaluator.h"
#include "worker/protocol.h"

namespace swarmsmith {

/// Evaluates tasks for the coordinator that started this process, one at a time, until `input`
/// ends; returns the exit code. It uses no network and trusts only the pipes.
///
/// Messages on the pipes have the same frames as on the network, each preceded by its length (four
/// bytes, little-endian). Out: Hello, after the self test. In: ScenarioReply, then Tasks. Out, for
/// each task: Began before the evaluation, then Results. If the process dies after Began, the
/// evaluation is the cause.
int serve_as_referee(const WorkerIdentity& identity, const EvaluatorFactory& make_evaluator,
                     int input, int output);

}  // namespace swarmsmith
