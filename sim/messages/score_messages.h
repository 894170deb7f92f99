#pragma once

#include "base/expected.h"
#include "proto/score.pb.h"
#include "sim/mission/score.h"

namespace swarmsmith {

/// A mission's score to message and back: `from_message(to_message(r)) == r`, bit for bit.
void to_message(const ScoreRule& rule, pb::ScoreRule& message);

/// Errors: no kind or an unknown one, a parameter that the kind lacks or that is missing, of
/// another type or out of its limits; `where` is `rule`, `rule.kind` or `rule.<parameter>`.
Expected<ScoreRule> from_message(const pb::ScoreRule& message);

}  // namespace swarmsmith
