#pragma once

#include <string>
#include <vector>

#include "base/expected.h"
#include "base/id.h"
#include "storage/store.h"

namespace swarmsmith {

struct ReportOptions {
  /// Designs with a chapter of their own; empty: all. The results are those of all designs.
  std::vector<DesignId> designs;
  std::string program;  ///< what made the report: "swarmsmith 0.1.0"
};

/// Everything that a reader of a campaign asks first, as one HTML file (docs/report.md): what was
/// asked, results, a chapter a design, where it all comes from. The same store gives the same
/// bytes. Errors: NotFound (no such design), BadInput (a view is missing: a store of an older
/// schema).
Expected<std::string> html_report(StoreReader& store, const ReportOptions& options);

}  // namespace swarmsmith
