#pragma once

#include <optional>

#include "proto/result.h"
#include "proto/task.h"
#include "proto/wire.pb.h"

namespace swarmsmith {

/// Conversion of keys, tasks and results to and from messages. Only code that sends or receives
/// should include this file: the generated code takes as long to compile as everything else in such
/// a file.

/// Empty for an invalid key.
std::optional<PackedKey> pack(const pb::Key& key);
void unpack(PackedKey packed, pb::Key& key);

/// The caller must have checked the key, as `decode_to_worker` does.
LeasedTask task_of(const pb::Task& message);
void write(const LeasedTask& task, pb::Task& message);

/// The caller must have checked the key, as `decode_to_coordinator` does. A score of -0 becomes 0,
/// since stores have only one zero.
Result result_of(const pb::Result& message);
/// Texts are cut to the longest that a message may have.
void write(const Result& result, pb::Result& message);

}  // namespace swarmsmith
