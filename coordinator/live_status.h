#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "coordinator/launchers/launcher.h"

namespace swarmsmith {

/// How a coordinator's campaigns are right now; from the coordinator's memory, for people.
struct LiveStatus {
  std::int64_t workers = 0;
  std::int64_t slots = 0;
  std::int64_t ready = 0;  ///< tasks that wait for a slot
  std::int64_t leased = 0;
  std::int64_t done = 0;  ///< outcomes since the start of this process
  std::int64_t rejected = 0;
  std::int64_t failed = 0;  ///< attempts without a score
  std::int64_t requeued = 0;
  std::int64_t expired = 0;  ///< of those, leases whose time was over
  std::int64_t lost_workers = 0;
  std::int64_t duplicates = 0;
  std::int64_t conflicts = 0;
  std::int64_t malformed = 0;
  std::int64_t uncommitted = 0;  ///< outcomes that are not on disk yet
  double evaluations_per_s = 0;  ///< over the last seconds
  std::string trouble;           ///< why nothing can be written; empty when well
  LauncherStatus launcher;       ///< of workers that this process starts; without name: none
  /// Other hosts can connect without keys, because somebody insisted.
  bool insecure_plaintext = false;
  std::map<std::string, std::uint64_t> refused;  ///< connections, by reason
};

/// One JSON object with the fields by name.
std::string to_json(const LiveStatus& status);

}  // namespace swarmsmith
