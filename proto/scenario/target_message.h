#pragma once

#include "base/expected.h"
#include "programs/target.h"

namespace swarmsmith::pb {
class InstanceTexts;
class Target;
}  // namespace swarmsmith::pb

namespace swarmsmith {

void to_message(const Target& target, pb::Target& out);
void to_message(const InstanceTexts& instances, pb::InstanceTexts& out);

/// Errors, with the field in `where`: paths that are not absolute, numbers outside their limits, a
/// batch system that this program does not know, texts with NUL bytes or longer than a command line
/// may be.
Expected<Target> from_message(const pb::Target& message);
Expected<InstanceTexts> from_message(const pb::InstanceTexts& message);

}  // namespace swarmsmith
