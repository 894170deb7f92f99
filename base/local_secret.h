#pragma once

namespace swarmsmith {

/// Environment variable with a secret. The coordinator recognises the workers that it started
/// itself because they know the secret.
inline constexpr const char* kLocalSecret = "SWARMSMITH_LOCAL_SECRET";

}  // namespace swarmsmith
