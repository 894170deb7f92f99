#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "base/id.h"
#include "storage/store.h"

namespace swarmsmith {

/// A file of a supplement: its path within the folder, and its contents.
struct SupplementFile {
  std::string path;
  std::string text;
};

struct SupplementOptions {
  /// Returns a candidate as a file that `evaluate` can read.
  std::function<Expected<std::string>(CandidateId)> machine_file;
  std::string program;     ///< the program that made it: "swarmsmith 0.1.0"
  bool with_pdfs = false;  ///< README.md mentions a PDF beside every SVG, which the caller adds
  /// Returns the files below `instances/`; may be empty.
  std::function<Expected<std::vector<SupplementFile>>()> instance_tables;
  /// As in ReportOptions.
  std::function<Expected<std::string>(DesignId)> runs_from_above;
  /// Returns the text of `dashboard.html`; may be empty.
  std::function<Expected<std::string>()> dashboard;
  /// Called from time to time with the number of finished files.
  std::function<void(std::size_t)> progress;
};

/// The supplementary files of a paper, ordered by path: scores, controllers, figures with their
/// numbers, p values, report, campaign files, and a README.md that explains them (docs/report.md).
/// The caller must add PDFs and the list of checksums. The same store gives the same bytes. Errors:
/// NotFound (no design has a best machine yet), and errors of reading.
Expected<std::vector<SupplementFile>> supplement(StoreReader& store,
                                                 const SupplementOptions& options);

}  // namespace swarmsmith
