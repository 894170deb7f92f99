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
  std::vector<std::string> warnings;      ///< sentences, such as about unfinished campaigns
  std::string digest;                     ///< StoreReader::digest of the new store
};

/// Progress: the index of the store that is being copied, and the number of stores.
using OnStore = std::function<void(std::int64_t store, std::int64_t of)>;

/// Copies the campaigns of several stores into a new one for reading, in the given order. The
/// numbers of designs continue from store to store, and so do those of candidates, evaluations,
/// workers and commands; the digest of each campaign does not change. Each store is copied as it is
/// at one moment, whatever its schema, and does not change. Errors: those of back_up, with the name
/// of the store; Conflict (two stores have the same campaign).
Expected<Merged> merge_stores(const std::vector<std::filesystem::path>& stores,
                              const std::filesystem::path& into, const OnStore& on_store);

}  // namespace swarmsmith
