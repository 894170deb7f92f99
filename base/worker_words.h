#pragma once

namespace swarmsmith {

/// Lines that a worker writes to a pipe, for the launcher at its other end.
inline constexpr const char* kWorkerBegins =
    "swarmsmith-worker: begins";  ///< the login has succeeded
inline constexpr const char* kWorkerConnected = "swarmsmith-worker: connected";
inline constexpr const char* kWorkerAlone = "swarmsmith-worker: alone";  ///< no longer connected

}  // namespace swarmsmith
