#pragma once

namespace swarmsmith {

/// Environment variable with the secret by which a coordinator recognises the workers that it has
/// started itself.
inline constexpr const char* kLocalSecret = "SWARMSMITH_LOCAL_SECRET";

}  // namespace swarmsmith
