#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "base/id.h"
#include "storage/store.h"

namespace swarmsmith {

/// A file of a supplement: its path within the folder, and what is in it.
struct SupplementFile {
  std::string path;
  std::string text;
};

struct SupplementOptions {
  /// A candidate as a file that `evaluate` reads.
  std::function<Expected<std::string>(CandidateId)> machine_file;
  std::string program;     ///< what made it: "swarmsmith 0.1.0"
  bool with_pdfs = false;  ///< a PDF will be put beside every SVG, as README.md then says
  /// Files below `instances/`; may be empty.
  std::function<Expected<std::vector<SupplementFile>>()> instance_tables;
  /// As in ReportOptions.
  std::function<Expected<std::string>(DesignId)> runs_from_above;
  /// The text of `dashboard.html`; may be empty.
  std::function<Expected<std::string>()> dashboard;
  /// Receives now and then the number of files made.
  std::function<void(std::size_t)> progress;
};

/// What goes beside a paper: scores, controllers, figures with their numbers, p values, report,
/// campaign files, and a README.md that explains them (docs/report.md), by path. PDFs and the list
/// of checksums are the caller's to add. The same store gives the same bytes. Errors: NotFound (no
/// design has a best machine yet), and those of reading.
Expected<std::vector<SupplementFile>> supplement(StoreReader& store,
                                                 const SupplementOptions& options);

}  // namespace swarmsmith
