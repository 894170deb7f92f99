#pragma once

#include "base/expected.h"
#include "proto/scenario.pb.h"
#include "sim/engine/profile.h"

namespace swarmsmith {

/// Profile to message and back: `from_message(to_message(p)) == p`, bit for bit.
void to_message(const Profile& profile, pb::Profile& message);

/// Errors: a field that is missing, unknown or out of its range; `where` is its key.
Expected<Profile> from_message(const pb::Profile& message);

}  // namespace swarmsmith
