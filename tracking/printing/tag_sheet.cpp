#include "tracking/printing/tag_sheet.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "analysis/drawing/figure_style.h"
#include "base/plain_text.h"
#include "tracking/detection/tag_pattern.h"
#include "tracking/printing/internal/page.h"

namespace swarmsmith {
namespace {

constexpr double kStrip = 6;      ///< strip below a tag, with its name
constexpr double kGap = 5;        ///< between tags, and half of it at the edges: room for the marks
constexpr double kMark = 1.7;     ///< length of a cutting mark
constexpr double kMarkOff = 0.4;  ///< distance of a mark from the part to cut out
constexpr double kMarkWidth = 0.1;

/// The number of tags that fit on a sheet; the side of a tag in mm includes the quiet zone.
struct Grid {
  int columns = 0;
  int rows = 0;
  int count() const { return columns * rows; }
};

Grid grid_on(const Paper& paper, double side) {
  const PrintedArea area = printed_area(paper);
  return {std::max(0, static_cast<int>(std::floor(area.width / (side + kGap) + 1e-9))),
          std::max(0, static_cast<int>(std::floor(area.height / (side + kStrip + kGap) + 1e-9)))};
}

/// The sheet in portrait or landscape, whichever holds more tags.
Paper better_way_round(const Paper& paper, double side) {
  const Paper lying = turned(paper);
  return grid_on(lying, side).count() > grid_on(paper, side).count() ? lying : paper;
}

/// Draws each row of neighbouring black cells as one bar.
void draw_cells(Svg& svg, const TagPattern& pattern, PagePoint top_left, double cell) {
  std::vector<PageBar> bars;
  for (int row = 0; row < pattern.cells; ++row) {
    for (int column = 0; column < pattern.cells; ++column) {
      if (!pattern.is_black(row, column)) continue;
      int end = column;
      while (end < pattern.cells && pattern.is_black(row, end))
        ++end;
      bars.push_back(
          {{top_left.x + column * cell, top_left.y + (row + 0.5) * cell}, (end - column) * cell});
      column = end;
    }
  }
  svg.bars(bars, cell, "#000000");
}

/// Draws marks at the corners of the part to cut out, and where its strip begins.
void draw_marks(Svg& svg, PagePoint top_left, double side) {
  const Paint paint = stroked("#000000", kMarkWidth);
  const auto mark = [&](double x0, double y0, double x1, double y1) {
    const std::array<PagePoint, 2> ends = {{{x0, y0}, {x1, y1}}};
    svg.line(ends, paint);
  };
  const double right = top_left.x + side;
  const double bottom = top_left.y + side + kStrip;
  for (const double y : {top_left.y, top_left.y + side, bottom}) {
    mark(top_left.x - kMarkOff - kMark, y, top_left.x - kMarkOff, y);
    mark(right + kMarkOff, y, right + kMarkOff + kMark, y);
  }
  for (const double x : {top_left.x, right}) {
    mark(x, top_left.y - kMarkOff - kMark, x, top_left.y - kMarkOff);
    mark(x, bottom + kMarkOff, x, bottom + kMarkOff + kMark);
  }
}

/// Draws the tag's x axis and upper side in a box of 12 x 5 mm, given its right edge.
constexpr double kAxesWidth = 13;
void draw_axes(Svg& svg, double right, double top) {
  const PagePoint origin = {right - 7.5, top + kStrip - 1.2};
  draw_arrow(svg, origin, {origin.x + 5, origin.y}, 0.25);
  draw_arrow(svg, origin, {origin.x, top + 0.6}, 0.25);
  const std::string ink(kInk);
  svg.text({origin.x + 5.4, origin.y + 0.5}, "x", {.size = 2.2, .fill = ink});
  svg.text({origin.x - 0.9, top + 2.4}, "up",
           {.size = 2.2, .anchor = TextStyle::Anchor::End, .fill = ink});
}

/// Draws the name on one line, or on two smaller ones. It contains the colour of the border,
/// because some families have a white one.
void draw_name(Svg& svg, const TagSheetOptions& options, int id, const TagPattern& pattern,
               PagePoint at, double width) {
  const int border = (pattern.cells - pattern.border_cells) / 2;
  const std::string_view color = pattern.is_black(border, border) ? ", black " : ", white ";
  const std::string first = fmt::format("{} id {}", options.family, id);
  const std::string second = fmt::format("edge {} mm", printed_mm(options.edge_m));
  const std::string all = first + std::string(color) + second;
  const std::string ink(kInk);
  constexpr double kSize = 2.8;
  if (text_width(all, kSize) <= width) {
    svg.text({at.x, at.y + 4}, all, {.size = kSize, .fill = ink});
    return;
  }
  const double widest = std::max(text_width(first, 1), text_width(second, 1));
  const double size = std::min(2.2, width / widest);
  svg.text({at.x, at.y + 2.5}, first, {.size = size, .fill = ink});
  svg.text({at.x, at.y + 5.1}, second, {.size = size, .fill = ink});
}

void draw_tag(Svg& svg, const TagSheetOptions& options, int id, const TagPattern& pattern,
              PagePoint top_left) {
  const double cell = 1000 * options.edge_m / pattern.border_cells;
  const double side = cell * pattern.cells;
  draw_cells(svg, pattern, top_left, cell);
  draw_marks(svg, top_left, side);
  const bool has_room = side >= 2 * kAxesWidth;
  draw_name(svg, options, id, pattern, {top_left.x + 1, top_left.y + side},
            side - 2 - (has_room ? kAxesWidth : 0));
  if (has_room) draw_axes(svg, top_left.x + side, top_left.y + side);
}

Expected<int> number_from(std::string_view text, std::string_view part) {
  int value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && stop == text.data() + text.size() && value >= 0) return value;
  return bad_input(
      fmt::format("\"{}\" is not an id or a range of ids; write them as 1-3,100", part), "--ids");
}

/// The largest edge in whole millimetres that fits in portrait or landscape.
double largest_edge_mm(const Paper& paper, const TagPattern& pattern) {
  double edge = std::floor(paper.height_mm);
  while (edge > 0) {
    const double side = edge / pattern.border_cells * pattern.cells;
    if (grid_on(better_way_round(paper, side), side).count() > 0) break;
    edge -= 1;
  }
  return edge;
}

}  // namespace

Expected<std::vector<int>> ids_from_text(std::string_view text) {
  constexpr std::size_t kMostIds = 10'000;
  std::vector<int> ids;
  for (const std::string_view part : split(text, ',')) {
    const std::size_t dash = part.find('-');
    const auto first = number_from(part.substr(0, dash), part);
    if (!first) return tl::unexpected(first.error());
    const auto last =
        dash == std::string_view::npos ? first : number_from(part.substr(dash + 1), part);
    if (!last) return tl::unexpected(last.error());
    if (*last < *first || static_cast<std::size_t>(*last - *first) >= kMostIds) {
      return bad_input(
          fmt::format("\"{}\" is not a range: write it from the smaller to the larger id, "
                      "at most {} ids",
                      part, kMostIds),
          "--ids");
    }
    for (int id = *first; id <= *last; ++id) {
      if (std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(id);
    }
  }
  return ids;
}

Expected<std::vector<std::string>> tag_sheets(const TagSheetOptions& options) {
  if (options.ids.empty()) return bad_input("no ids; write them as 1-3,100", "--ids");
  if (!(options.edge_m >= kLeastPrintedEdge_m && options.edge_m <= kMostPrintedEdge_m)) {
    return bad_input(fmt::format("{} m is not from {} to {} m", options.edge_m, kLeastPrintedEdge_m,
                                 kMostPrintedEdge_m),
                     "--edge");
  }
  std::vector<TagPattern> patterns;
  for (const int id : options.ids) {
    auto pattern = tag_pattern(options.family, id);
    if (!pattern) return tl::unexpected(pattern.error());
    patterns.push_back(std::move(*pattern));
  }
  const TagPattern& one = patterns.front();
  const double side = 1000 * options.edge_m / one.border_cells * one.cells;
  const Paper paper = better_way_round(options.paper, side);
  const Grid grid = grid_on(paper, side);
  if (grid.count() == 0) {
    return bad_input(
        fmt::format("a tag of {} mm with its quiet zone is {} mm wide, too large for {}; the "
                    "largest that fits has {} mm",
                    printed_mm(options.edge_m), printed_mm(side / 1000), paper.name,
                    largest_edge_mm(options.paper, one)),
        "--edge");
  }
  const auto count = static_cast<std::size_t>(grid.count());
  const std::size_t pages = (patterns.size() + count - 1) / count;
  std::vector<std::string> sheets;
  for (std::size_t page = 0; page < pages; ++page) {
    Svg svg = empty_page(paper, "Tags of " + options.family, "Tags to print and cut out");
    const std::size_t first = page * count;
    for (std::size_t i = first; i < std::min(first + count, patterns.size()); ++i) {
      const int place = static_cast<int>(i - first);
      const double x = kPageMargin + kGap / 2 + place % grid.columns * (side + kGap);
      const double y =
          kPageMargin + kGap / 2 + static_cast<int>(place / grid.columns) * (side + kStrip + kGap);
      draw_tag(svg, options, options.ids[i], patterns[i], {x, y});
    }
    draw_foot(svg, paper, fmt::format("{}, page {} of {}", options.family, page + 1, pages));
    sheets.push_back(svg.finish());
  }
  return sheets;
}

}  // namespace swarmsmith
