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
  /// Called with the number of finished answers, and the total number.
  std::function<void(std::int64_t made, std::int64_t of)> progress{};
};

/// The dashboard as one HTML file that needs no server: the pages and all answers that they need
/// about these designs: races, candidates' parameters, winners and elites with their machines, some
/// runs of the winners, results. docs/http-api.md describes the format. Errors: NotFound (no such
/// design); Conflict if this program was built without its pages; errors of the store.
Expected<std::string> snapshot_page(const std::filesystem::path& store,
                                    const SnapshotOptions& options);

}  // namespace swarmsmith::cli
