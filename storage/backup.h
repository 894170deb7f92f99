#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "base/expected.h"

namespace swarmsmith {

/// Progress: done of total.
using OnCopied = std::function<void(std::int64_t done, std::int64_t of)>;

struct Backup {
  std::string digest;         ///< of the original and of the copy
  std::int64_t schema = 0;    ///< of the copy
  std::int64_t migrated = 0;  ///< the original's schema if it is an older one, else 0
  std::int64_t bytes = 0;
};

/// Makes a complete copy of a store as it is at one moment. A campaign may write the store
/// meanwhile; neither waits for the other. The copy has the newest schema, so an old store can be
/// migrated without changing it. The copy is checked at the end (SQLite's integrity check, foreign
/// keys, the digest that the original had at that moment), and gets its name only then. Calls
/// `on_copied` with numbers of pages from time to time. Errors: those of StoreReader::open;
/// BadInput (the name exists); Corrupt (the original is damaged; the error says how); Unavailable
/// (the disk cannot be written).
Expected<Backup> back_up(const std::filesystem::path& store, const std::filesystem::path& copy,
                         const OnCopied& on_copied);

}  // namespace swarmsmith
