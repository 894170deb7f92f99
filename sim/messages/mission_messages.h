#pragma once

#include "base/expected.h"
#include "proto/mission.pb.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

/// Mission to message and back: `from_message(to_message(m)) == m`, bit for bit.
void to_message(const Mission& mission, pb::Mission& message);

/// Errors: a colour above 255, a patch without a shape, no score rule, a number that is not finite,
/// no robots or more than 1,000, no cycles or more than a million; `where` is the field's path.
Expected<Mission> from_message(const pb::Mission& message);

}  // namespace swarmsmith
