#pragma once

namespace swarmsmith {

/// Lines of a worker behind a pipe, for the launcher at its other end.
inline constexpr const char* kWorkerBegins = "swarmsmith-worker: begins";  ///< the login is over
inline constexpr const char* kWorkerConnected = "swarmsmith-worker: connected";
inline constexpr const char* kWorkerAlone = "swarmsmith-worker: alone";  ///< not connected any more

}  // namespace swarmsmith
