#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/records/chosen_scores.h"
#include "analysis/records/records.h"
#include "base/expected.h"
#include "storage/store.h"

namespace swarmsmith {

/// A figure for a paper: the picture, and the numbers in it.
struct Figure {
  std::string svg;
  std::string
      csv;  ///< RFC 4180, header, one row per point, full precision: everything in the picture
  std::string tex;  ///< TikZ, only for machines; else empty
  std::string dot;  ///< GraphViz, only for a single controller; else empty
  /// The same picture divided into pages, if it is higher than one page; else empty.
  std::vector<std::string> pages{};
};

/// Maximum height of a figure, so that it fits on a page of a journal, mm.
inline constexpr double kFigurePage_mm = 240;

/// The minimum and maximum width of figures, mm.
inline constexpr double kLeastFigureWidth_mm = 60;
inline constexpr double kMostFigureWidth_mm = 1000;

/// Options of figures. An option that has no meaning for a kind is refused: `refused_option`.
struct FigureOptions {
  RecordFilter filter;
  double width_mm = 84;  ///< the column width of a paper; the height follows from it
  bool paper =
      false;       ///< without title, details and explanations, which belong in a paper's caption
  std::string by;  ///< groups of a comparison: source, method or mission
  std::string source;  ///< only scores of this source; empty: all sources
  ScoreChoice choice;  ///< which scores to use, and the meaning of one value
  std::optional<CandidateId> candidate;
  std::optional<std::int64_t> iteration;
  std::string parameter;  ///< names separated by commas; empty: the most informative ones
  std::vector<std::int64_t> seeds{};  ///< of runs to simulate again
};

/// Draws a figure from a store. Errors: BadInput (an option makes no sense here), NotFound (the
/// store has no data for this figure yet; the message says what to do).
using FigureMaker = Expected<Figure> (*)(StoreReader& store, const FigureOptions& options);

struct FigureKind {
  std::string_view name;     ///< as typed: `swarmsmith figure NAME STORE`
  std::string_view summary;  ///< one line for the help
  FigureMaker make = nullptr;
  /// The options for this kind besides the width, separated by blanks.
  std::string_view options = "mission method design by source candidate iteration parameter";
};

/// All kinds, in the order of the help.
std::span<const FigureKind> figure_kinds();

/// Null if there is no kind with this name.
const FigureKind* find_figure_kind(std::string_view name);

/// BadInput for the first given option that has no meaning for this kind, if there is one; its
/// place is the option as typed.
std::optional<Error> refused_option(const FigureKind& kind, const FigureOptions& options);

/// An error if the store lacks something that the options name: a mission, a method (BadInput), an
/// id (NotFound); Corrupt if the views belong to an older schema.
std::optional<Error> missing_in(StoreReader& store, const FigureOptions& options);

}  // namespace swarmsmith
