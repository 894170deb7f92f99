#pragma once

#include <apriltag/apriltag.h>

#include <memory>
#include <string_view>

namespace swarmsmith {

using FamilyPointer = std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)>;

/// A family of the apriltag library for one detector only, because detectors write into it. Null
/// for a name that is not in known_tag_families().
FamilyPointer tag_family_of(std::string_view name);

}  // namespace swarmsmith
