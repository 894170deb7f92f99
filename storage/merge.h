#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "storage/store.h"

namespace swarmsmith {

struct Merged {
  std::vector<StoredCampaign> campaigns;  ///< of the new store
  std::vector<std::string> warnings;      ///< a sentence each: campaigns that were not over
  std::string digest;                     ///< StoreReader::digest of the new store
};

/// What is being copied, of how many stores.
using OnStore = std::function<void(std::int64_t store, std::int64_t of)>;

/// Puts the campaigns of several stores into a new one, in the order given, for reading. Designs
/// count on from store to store, and candidates, evaluations, workers and commands with them; a
/// campaign's own digest stays as it was. Each store is taken as it is at one moment, of any
/// schema, and is itself not touched. Errors: those of back_up, with the store that they are of;
/// Conflict (one campaign twice).
Expected<Merged> merge_stores(const std::vector<std::filesystem::path>& stores,
                              const std::filesystem::path& into, const OnStore& on_store);

}  // namespace swarmsmith
