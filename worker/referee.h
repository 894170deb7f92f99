#pragma once

#include "worker/evaluator.h"
#include "worker/protocol.h"

namespace swarmsmith {

/// Evaluates for the coordinator that started this process, one task after the other, until `input`
/// ends; returns the exit code. No network: it believes the pipes alone.
///
/// What goes through them is framed as on the wire, each frame behind its length (four bytes,
/// little-endian). Out: Hello, once the self test is done. In: ScenarioReply, then Tasks. Out, for
/// each task: Began before it is evaluated, then Results. What the process dies of after Began is
/// the evaluation's doing.
int serve_as_referee(const WorkerIdentity& identity, const EvaluatorFactory& make_evaluator,
                     int input, int output);

}  // namespace swarmsmith
