#include "tracking/printing/internal/page.h"

#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "analysis/drawing/figure_style.h"

namespace swarmsmith {
namespace {

constexpr double kRulerLength = 100;
constexpr double kLine = 0.2;

}  // namespace

PrintedArea printed_area(const Paper& paper) {
  return {.width = paper.width_mm - 2 * kPageMargin,
          .height = paper.height_mm - 2 * kPageMargin - kFootHeight};
}

Svg empty_page(const Paper& paper, std::string_view title, std::string_view description) {
  Svg svg(paper.width_mm, paper.height_mm, title, description);
  const std::array<PagePoint, 4> sheet = {
      {{0, 0}, {paper.width_mm, 0}, {paper.width_mm, paper.height_mm}, {0, paper.height_mm}}};
  svg.polygon(sheet, filled("#ffffff"));
  return svg;
}

void draw_foot(Svg& svg, const Paper& paper, std::string_view text) {
  constexpr double kTick = 3;
  constexpr double kSmallTick = 1.5;
  constexpr int kTicks = 10;
  const double base = paper.height_mm - kPageMargin - 1;
  const double left = kPageMargin;
  const std::array<PagePoint, 2> ruler = {{{left, base}, {left + kRulerLength, base}}};
  svg.line(ruler, stroked(kInk, kLine));
  for (int i = 0; i <= kTicks; ++i) {
    const double x = left + kRulerLength * i / kTicks;
    const bool is_end = i == 0 || i == kTicks;
    const std::array<PagePoint, 2> tick = {{{x, base}, {x, base - (is_end ? kTick : kSmallTick)}}};
    svg.line(tick, stroked(kInk, kLine));
  }
  svg.text({left + 1.5, base - 2.2}, "Measure me: 100 mm from end to end. Print at 100 %.",
           {.size = 2.4, .fill = std::string(kInk)});
  const double from = left + kRulerLength + 4;
  const double width = paper.width_mm - kPageMargin - from;
  svg.text({paper.width_mm - kPageMargin, base}, fitted_text(text, 2.4, width),
           {.size = 2.4, .anchor = TextStyle::Anchor::End, .fill = std::string(kInk)});
}

void draw_arrow(Svg& svg, PagePoint from, PagePoint to, double width) {
  const double dx = to.x - from.x;
  const double dy = to.y - from.y;
  const double length = std::sqrt(dx * dx + dy * dy);
  const double head = 6 * width;
  const PagePoint along = {dx / length, dy / length};
  const PagePoint neck = {to.x - head * along.x, to.y - head * along.y};
  const std::array<PagePoint, 2> shaft = {from, neck};
  svg.line(shaft, stroked(kInk, width));
  const std::array<PagePoint, 3> tip = {
      {to,
       {neck.x - head / 2 * along.y, neck.y + head / 2 * along.x},
       {neck.x + head / 2 * along.y, neck.y - head / 2 * along.x}}};
  svg.polygon(tip, filled(kInk));
}

std::string printed_mm(double metres) {
  return fmt::format("{:.6g}", 1000 * metres);
}

}  // namespace swarmsmith
