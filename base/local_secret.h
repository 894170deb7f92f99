#pragma once

namespace swarmsmith {

/// Environment variable with the secret by which a coordinator knows the workers that it started
/// itself.
inline constexpr const char* kLocalSecret = "SWARMSMITH_LOCAL_SECRET";

}  // namespace swarmsmith
