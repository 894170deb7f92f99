#pragma once

#include <optional>

#include "proto/result.h"
#include "proto/task.h"
#include "proto/wire.pb.h"

namespace swarmsmith {

/// Keys, tasks and results as the messages that carry them. Only who sends or receives needs this:
/// the generated code takes as long to compile as all else that such a file includes.

/// Nothing for a key that cannot be one.
std::optional<PackedKey> pack(const pb::Key& key);
void unpack(PackedKey packed, pb::Key& key);

/// The caller has checked the key, as `decode_to_worker` does.
LeasedTask task_of(const pb::Task& message);
void write(const LeasedTask& task, pb::Task& message);

/// The caller has checked the key, as `decode_to_coordinator` does. A score of -0 becomes 0, the
/// only zero that stores know.
Result result_of(const pb::Result& message);
/// Texts are cut to what a message may carry.
void write(const Result& result, pb::Result& message);

}  // namespace swarmsmith
