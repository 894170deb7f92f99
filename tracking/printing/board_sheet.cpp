#include "tracking/printing/board_sheet.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "tracking/printing/internal/page.h"

namespace swarmsmith {
namespace {

/// How many times as large the board could be; below 1, the board does not fit.
double room_for(const Board& board, const Paper& paper) {
  const PrintedArea area = printed_area(paper);
  return std::min(area.width / (1000 * board.width_m()), area.height / (1000 * board.height_m()));
}

/// Joins neighbours of one row to one bar, and bars of one thickness to one shape.
void draw_boxes(Svg& svg, const std::vector<BlackBox>& boxes, PagePoint top_left) {
  constexpr double kTouching = 1e-6;  // mm
  std::map<double, std::vector<PageBar>> bars;
  for (const BlackBox& box : boxes) {
    const double thickness = 1000 * box.height_m;
    const PagePoint start = {top_left.x + 1000 * box.left_m,
                             top_left.y + 1000 * box.top_m + thickness / 2};
    std::vector<PageBar>& row = bars[thickness];
    if (!row.empty() && std::abs(row.back().start.y - start.y) < kTouching &&
        std::abs(row.back().start.x + row.back().length - start.x) < kTouching) {
      row.back().length += 1000 * box.width_m;
    } else {
      row.push_back({start, 1000 * box.width_m});
    }
  }
  for (const auto& [thickness, row] : bars)
    svg.bars(row, thickness, "#000000");
}

/// The scaled board, with squares rounded down to a tenth of a millimetre.
Board largest_like(const Board& board, double scale) {
  Board fitting = board;
  fitting.square_m = std::floor(1e4 * board.square_m * scale) / 1e4;
  fitting.marker_m = std::floor(1e4 * board.marker_m * fitting.square_m / board.square_m) / 1e4;
  return fitting;
}

}  // namespace

Expected<std::string> board_sheet(const Board& board, const Paper& paper) {
  const Paper lying = turned(paper);
  const Paper& sheet = room_for(board, lying) > room_for(board, paper) ? lying : paper;
  const double room = room_for(board, sheet);
  constexpr double kRounding = 1e-9;
  if (room < 1 - kRounding) {
    return bad_input(fmt::format("the board is {} x {} mm, too large for {}; the largest like it "
                                 "that fits is {}",
                                 printed_mm(board.width_m()), printed_mm(board.height_m()),
                                 paper.name, board_text(largest_like(board, room))),
                     "--board");
  }
  const PrintedArea area = printed_area(sheet);
  Svg svg = empty_page(sheet, "Calibration board " + board_text(board), "A board to print");
  draw_boxes(svg, black_boxes_of(board),
             {area.left + (area.width - 1000 * board.width_m()) / 2,
              area.top + (area.height - 1000 * board.height_m()) / 2});
  draw_foot(svg, sheet,
            fmt::format("{}, squares of {} mm", board_text(board), printed_mm(board.square_m)));
  return svg.finish();
}

}  // namespace swarmsmith
