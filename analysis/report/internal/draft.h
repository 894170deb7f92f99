#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/figures/figure.h"
#include "analysis/records/records.h"
#include "analysis/report/html.h"
#include "analysis/report/internal/view_table.h"
#include "analysis/report/report.h"

namespace swarmsmith {

/// Widths of figures in papers, mm: one column, and two columns.
inline constexpr double kColumnWidth = 84;
inline constexpr double kWholeWidth = 174;

/// A report that is being written: the page, the store with its rows, and the first error, after
/// which nothing more is read.
class ReportDraft {
 public:
  ReportDraft(StoreReader& store, const ReportOptions& options)
      : store_(&store), options_(&options) {}

  HtmlPage& page() { return page_; }
  StoreReader& store() { return *store_; }
  const ReportOptions& options() const { return *options_; }
  const std::optional<Error>& trouble() const { return trouble_; }

  /// The value, or an empty one after an error.
  template <class Value>
  Value take(Expected<Value> value) {
    if (value) return std::move(*value);
    if (!trouble_) trouble_ = value.error();
    return {};
  }

  void table(const std::string& caption, const std::vector<ViewColumn>& columns,
             const std::string& sql, std::size_t most = 200);
  void facts(std::string_view caption, const std::string& sql);
  /// Adds the figure of this kind. Leaves it out if the program does not have this kind, if it does
  /// not apply, or if the store has no data for it. A figure that is too large for the report is
  /// replaced by the command that draws it.
  void figure(std::string_view kind, const FigureOptions& options, std::string_view caption);

 private:
  /// Counts the start of one more part.
  void count() {
    ++parts_;
    if (options_->progress) options_->progress(parts_);
  }

  StoreReader* store_;
  const ReportOptions* options_;
  HtmlPage page_;
  std::optional<Error> trouble_;
  std::size_t parts_ = 0;
};

}  // namespace swarmsmith
