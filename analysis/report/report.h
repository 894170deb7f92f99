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
  /// Designs that get their own chapter; empty: all if there are at most three, else none. The
  /// results always cover all designs.
  std::vector<DesignId> designs;
  bool all_designs = false;  ///< chapters for all designs
  std::string program;       ///< the program that made the report: "swarmsmith 0.1.0"
  /// A picture, as SVG, of runs of the design's winner from above. If the function is empty or
  /// returns an error, the report has no such picture.
  std::function<Expected<std::string>(DesignId)> runs_from_above;
  /// Called from time to time with the number of finished parts.
  std::function<void(std::size_t)> progress;
  /// The path of a design's page, relative to the report; if empty, the report has no links to such
  /// pages.
  std::function<std::string(const DesignRecord&)> page_of_design;
};

/// The report on a store as one HTML file (docs/report.md): the result as a figure and as sentences
/// for a paper, the best machines, then scores, tests, modules, machines, races, and, in a folded
/// part, the question and the origin of all data. The same store gives the same bytes. Errors:
/// NotFound (no such design), BadInput (a view is missing: a store with an older schema).
Expected<std::string> html_report(StoreReader& store, const ReportOptions& options);

/// The chapter on one design as a separate page.
Expected<std::string> design_page(StoreReader& store, const DesignRecord& design,
                                  const ReportOptions& options);

}  // namespace swarmsmith
