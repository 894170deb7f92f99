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

/// A figure as it goes to a paper: the picture, and the numbers that it shows.
struct Figure {
  std::string svg;
  std::string csv;  ///< RFC 4180, header, a row a point, full precision: everything that was drawn
  std::string tex;  ///< TikZ, of machines alone; else empty
  std::string dot;  ///< GraphViz, of one controller alone; else empty
  /// The same picture cut into pages, where it is higher than one; else empty.
  std::vector<std::string> pages{};
};

/// What is higher fits on no page of a journal, mm.
inline constexpr double kFigurePage_mm = 240;

/// The narrowest and widest figures, mm.
inline constexpr double kLeastFigureWidth_mm = 60;
inline constexpr double kMostFigureWidth_mm = 1000;

/// What a figure is drawn of. What does not concern a kind is refused: `refused_option`.
struct FigureOptions {
  RecordFilter filter;
  double width_mm = 84;  ///< a column of a paper; the height follows
  bool paper = false;    ///< without title, details and explanations: a paper's caption has them
  std::string by;        ///< groups of a comparison: source, method or mission
  std::string source;    ///< only scores of this source; empty: of all
  ScoreChoice choice;    ///< which scores, and what a value is
  std::optional<CandidateId> candidate;
  std::optional<std::int64_t> iteration;
  std::string parameter;              ///< names, with commas between; empty: the most telling ones
  std::vector<std::int64_t> seeds{};  ///< of runs that are simulated again
};

/// Draws from a store. Errors: BadInput (an option that makes no sense here), NotFound (the store
/// has nothing of this kind yet, with what to do).
using FigureMaker = Expected<Figure> (*)(StoreReader& store, const FigureOptions& options);

struct FigureKind {
  std::string_view name;     ///< as typed: `swarmsmith figure NAME STORE`
  std::string_view summary;  ///< a line of the help
  FigureMaker make = nullptr;
  /// The options that it understands besides the width, words with blanks between them.
  std::string_view options = "mission method design by source candidate iteration parameter";
};

/// All kinds, in the order of the help.
std::span<const FigureKind> figure_kinds();

/// Null when there is none of this name.
const FigureKind* find_figure_kind(std::string_view name);

/// BadInput about the first option that is given and means nothing to this kind, if there is one;
/// its place is the option as typed.
std::optional<Error> refused_option(const FigureKind& kind, const FigureOptions& options);

/// What is asked for and not in the store: a mission, a method (BadInput), an id (NotFound);
/// Corrupt for views of an older schema.
std::optional<Error> missing_in(StoreReader& store, const FigureOptions& options);

}  // namespace swarmsmith
