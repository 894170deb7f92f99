#include "analysis/report/internal/draft.h"

#include <fmt/format.h>

namespace swarmsmith {
namespace {

/// A report has at most a dozen figures per design and should fit into an e-mail.
constexpr std::size_t kMostFigureBytes = 300'000;

/// The command that draws the same figure.
std::string command_of(std::string_view kind, const FigureOptions& options) {
  std::string command = fmt::format("swarmsmith figure {} STORE", kind);
  if (options.filter.design) command += " --design " + to_string(*options.filter.design);
  if (!options.filter.mission.empty()) command += " --mission " + options.filter.mission;
  if (options.candidate) command += " --candidate " + to_string(*options.candidate);
  return command;
}

}  // namespace

void ReportDraft::table(const std::string& caption, const std::vector<ViewColumn>& columns,
                        const std::string& sql, std::size_t most) {
  if (trouble_) return;
  count();
  page_.table(take(view_table(*store_, caption, columns, sql, most)));
}

void ReportDraft::facts(std::string_view caption, const std::string& sql) {
  if (trouble_) return;
  count();
  page_.facts(caption, take(view_facts(*store_, sql)));
}

void ReportDraft::figure(std::string_view kind, const FigureOptions& options,
                         std::string_view caption) {
  if (trouble_) return;
  count();
  const FigureKind* known = find_figure_kind(kind);
  if (known == nullptr) return;
  const auto figure = known->make(*store_, options);
  if (!figure) {
    const ErrorKind error = figure.error().kind;
    if (error != ErrorKind::NotFound && error != ErrorKind::BadInput) trouble_ = figure.error();
    return;
  }
  if (figure->svg.size() > kMostFigureBytes) {
    page_.paragraph(fmt::format("{} This figure has {} kB, too many for this page: `{}` draws it.",
                                caption, figure->svg.size() / 1000, command_of(kind, options)));
    return;
  }
  page_.picture(figure->svg, caption);
}

}  // namespace swarmsmith
