#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "base/id.h"
#include "storage/store.h"

namespace swarmsmith {

/// A design in a store, from any of its campaigns.
struct KnownDesign {
  DesignId id;
  std::string mission;
  std::string method;
  std::int64_t repetition = 0;
  std::string name;     ///< its name in the imported file; empty for others
  std::string flavour;  ///< empty for parameters of a program, and in stores with schemas 1 to 3
  std::int64_t campaign = 1;
  bool finished = false;
  CandidateId best;  ///< the winner if the design is finished
};

/// Sorted by id. Stores with older schemas have no names and flavours.
Expected<std::vector<KnownDesign>> known_designs(StoreReader& store);

/// Digests of the campaigns that were imported into the store.
Expected<std::vector<std::string>> imported_digests(StoreReader& store);

/// Whether the store has the candidate.
Expected<bool> has_candidate(StoreReader& store, CandidateId candidate);

}  // namespace swarmsmith
