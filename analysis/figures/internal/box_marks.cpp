#include "analysis/figures/internal/box_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "analysis/drawing/figure_style.h"
#include "analysis/figures/box_plot.h"

namespace swarmsmith {
namespace {

constexpr double kCountSize = 2.2;
constexpr double kBeforeCount = 0.5;
constexpr std::size_t kMostCounted = 7;

/// How often each value occurs, where that is worth writing: some do, and few differ.
std::map<double, std::size_t> repeated(const std::vector<double>& values) {
  std::map<double, std::size_t> counts;
  for (const double value : values)
    ++counts[value];
  if (counts.size() == values.size() || counts.size() > kMostCounted) counts.clear();
  return counts;
}

std::string count_text(std::size_t count) {
  return fmt::format("\u00d7{}", count);
}

void draw_segment(Svg& svg, PagePoint a, PagePoint b, std::string_view color, double width) {
  const std::array<PagePoint, 2> ends = {a, b};
  svg.line(ends, stroked(color, width));
}

std::array<PagePoint, 4> corners_of(const BoxNumbers& box, const BoxPlace& place, const Axis& y) {
  const double top = y.at(box.upper_quartile);
  const double bottom = y.at(box.lower_quartile);
  return {{{place.x - place.half, top},
           {place.x + place.half, top},
           {place.x + place.half, bottom},
           {place.x - place.half, bottom}}};
}

/// What points may lie over.
void draw_ground(Svg& svg, const BoxNumbers& box, const BoxPlace& place, const Axis& y,
                 const std::string& color) {
  svg.polygon(corners_of(box, place, y), filled(lightened(color, 0.75)));
}

/// What no point may hide.
void draw_lines(Svg& svg, const BoxNumbers& box, const BoxPlace& place, const Axis& y,
                const std::string& color) {
  const auto [x, half, right] = place;
  for (const auto& [from, to] : {std::pair(box.lower_quartile, box.lower_whisker),
                                 std::pair(box.upper_quartile, box.upper_whisker)}) {
    draw_segment(svg, {x, y.at(from)}, {x, y.at(to)}, color, 0.3);
    if (from != to)
      draw_segment(svg, {x - half / 2, y.at(to)}, {x + half / 2, y.at(to)}, color, 0.3);
  }
  svg.polygon(corners_of(box, place, y), stroked(color, 0.3));
  draw_segment(svg, {x - half, y.at(box.median)}, {x + half, y.at(box.median)}, kInk, 0.6);
}

void draw_mean(Svg& svg, double mean, const BoxPlace& place, const Axis& y) {
  constexpr double kHalf = 1;
  const double at = y.at(mean);
  const std::array<PagePoint, 4> diamond = {
      {{place.x, at - kHalf}, {place.x + kHalf, at}, {place.x, at + kHalf}, {place.x - kHalf, at}}};
  svg.polygon(diamond,
              {.fill = "#ffffff", .stroke = std::string(kInk), .width = 0.25, .dashes = {}});
}

/// Points of sorted values, spread over the box by steps of the golden ratio: neighbours in value,
/// tied ones above all, come to lie far apart.
void draw_points(Svg& svg, const std::vector<double>& sorted, const BoxPlace& place, const Axis& y,
                 const std::string& color) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr std::size_t kMany = 60;
  const double radius = sorted.size() > kMany ? 0.3 : 0.45;
  std::vector<PagePoint> points;
  double part = 0.5;
  for (const double value : sorted) {
    points.push_back({place.x + (part - 0.5) * 1.6 * place.half, y.at(value)});
    part += kGolden;
    part -= std::floor(part);
  }
  svg.dots(points, radius, sorted.size() > kMany ? lightened(color, 0.35) : color);
}

/// "x12" at the right of each value, unless they are too near to each other to be read.
void draw_counts(Svg& svg, const std::vector<double>& values, const BoxPlace& place,
                 const Axis& y) {
  const auto counts = repeated(values);
  double last = 1e9;
  for (const auto& [value, count] : counts) {
    if (last - y.at(value) < kCountSize * 1.05) return;
    last = y.at(value);
  }
  for (const auto& [value, count] : counts) {
    if (count == 1) continue;
    const std::string text = count_text(count);
    const double x = place.x + place.half + kBeforeCount;
    if (x + text_width(text, kCountSize) > place.right) continue;
    svg.text({x, y.at(value) + 0.36 * kCountSize}, text,
             {.size = kCountSize, .fill = std::string(kInk)});
  }
}

}  // namespace

double count_room(const std::vector<double>& values) {
  double room = 0;
  for (const auto& [value, count] : repeated(values))
    room = std::max(room, kBeforeCount + text_width(count_text(count), kCountSize));
  return room;
}

void draw_marks(Svg& svg, const ScoreGroup& group, const BoxPlace& place, const Axis& y) {
  const std::string color = distinct_color(group.color);
  std::vector<double> sorted = group.values;
  std::ranges::sort(sorted);
  const BoxNumbers box = box_numbers(sorted);
  draw_ground(svg, box, place, y, color);
  draw_points(svg, sorted, place, y, color);
  draw_lines(svg, box, place, y, color);
  draw_mean(svg, box.mean, place, y);
  draw_counts(svg, sorted, place, y);
}

}  // namespace swarmsmith
