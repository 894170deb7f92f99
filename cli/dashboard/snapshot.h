#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "base/id.h"

namespace swarmsmith::cli {

struct SnapshotOptions {
  std::vector<DesignId> designs{};  ///< empty: all
  std::string version{};            ///< of this program
  /// Called with how many answers are made, and how many there will be.
  std::function<void(std::int64_t made, std::int64_t of)> progress{};
};

/// The pages with everything that they ask about these designs, as one HTML file that needs no
/// server: races, candidates' parameters, winners and elites with their machines, some runs of the
/// winners, results. docs/http-api.md has the format. Errors: NotFound (no such design), Conflict
/// when this program was built without its pages; as the store's.
Expected<std::string> snapshot_page(const std::filesystem::path& store,
                                    const SnapshotOptions& options);

}  // namespace swarmsmith::cli
