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
  std::string digest;         ///< of original and copy alike
  std::int64_t schema = 0;    ///< of the copy
  std::int64_t migrated = 0;  ///< the schema of an original of an earlier one, else 0
  std::int64_t bytes = 0;
};

/// Makes a complete copy of a store as it is at one moment, also while a campaign writes it;
/// neither stops for the other. The copy has the newest schema, which is how an old store is
/// migrated without touching it. It is checked at the end (SQLite's integrity check, foreign keys,
/// the digest of the original at that moment), and only then gets its name. Calls `on_copied` with
/// pages now and then. Errors: those of StoreReader::open; BadInput (the name exists); Corrupt (the
/// original is damaged: what was found); Unavailable (the disk refuses).
Expected<Backup> back_up(const std::filesystem::path& store, const std::filesystem::path& copy,
                         const OnCopied& on_copied);

}  // namespace swarmsmith
