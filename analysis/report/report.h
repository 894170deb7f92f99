#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "analysis/records/records.h"
#include "base/expected.h"
#include "base/id.h"
#include "storage/store.h"

namespace swarmsmith {

struct ReportOptions {
  /// Designs with a chapter of their own; empty: all of up to three, else none. The results are
  /// those of all designs.
  std::vector<DesignId> designs;
  bool all_designs = false;  ///< chapters of all
  std::string program;       ///< what made the report: "swarmsmith 0.1.0"
  /// A picture, as SVG, of runs of the design's winner from above. Without it, and where it is an
  /// error, the report has none.
  std::function<Expected<std::string>(DesignId)> runs_from_above;
  /// Receives now and then the number of parts written.
  std::function<void(std::size_t)> progress;
  /// Where the page of a design lies beside the report; without it the report links to none.
  std::function<std::string(const DesignRecord&)> page_of_design;
};

/// Everything that a reader of a campaign asks first, as one HTML file (docs/report.md): the result
/// as a figure and as sentences for a paper, the best machines, then scores, tests, modules,
/// machines, races, and, folded away, what was asked and where it all comes from. The same store
/// gives the same bytes. Errors: NotFound (no such design), BadInput (a view is missing: a store of
/// an older schema).
Expected<std::string> html_report(StoreReader& store, const ReportOptions& options);

/// The chapter of one design as a page of its own.
Expected<std::string> design_page(StoreReader& store, const DesignRecord& design,
                                  const ReportOptions& options);

}  // namespace swarmsmith
