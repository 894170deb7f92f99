#include "analysis/figures/internal/box_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "analysis/drawing/figure_style.h"
#include "analysis/figures/box_plot.h"

namespace swarmsmith {
namespace {

constexpr std::string_view kLink = "#888888";
constexpr double kCountSize = 2.2;
constexpr double kBeforeCount = 0.5;
constexpr std::size_t kMostCounted = 7;

/// How often each value occurs. Empty unless some values repeat and there are only a few different
/// ones.
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

std::array<PagePoint, 4> corners_of(const BoxNumbers& box, const BoxPlace& place,
                                    const Axis& axis) {
  const double upper = axis.at(box.upper_quartile);
  const double lower = axis.at(box.lower_quartile);
  return {{place.at(-place.half, upper), place.at(place.half, upper), place.at(place.half, lower),
           place.at(-place.half, lower)}};
}

/// Draws the lines that no point may hide.
void draw_lines(Svg& svg, const BoxNumbers& box, const BoxPlace& place, const Axis& axis,
                const std::string& color) {
  const double half = place.half;
  for (const auto& [from, to] : {std::pair(box.lower_quartile, box.lower_whisker),
                                 std::pair(box.upper_quartile, box.upper_whisker)}) {
    draw_segment(svg, place.at(0, axis.at(from)), place.at(0, axis.at(to)), color, 0.3);
    if (from != to)
      draw_segment(svg, place.at(-half / 2, axis.at(to)), place.at(half / 2, axis.at(to)), color,
                   0.3);
  }
  svg.polygon(corners_of(box, place, axis), stroked(color, 0.3));
  draw_segment(svg, place.at(-half, axis.at(box.median)), place.at(half, axis.at(box.median)), kInk,
               0.6);
}

void draw_mean(Svg& svg, double mean, const BoxPlace& place, const Axis& axis) {
  constexpr double kHalf = 1;
  const double at = axis.at(mean);
  const std::array<PagePoint, 4> diamond = {{place.at(0, at - kHalf), place.at(kHalf, at),
                                             place.at(0, at + kHalf), place.at(-kHalf, at)}};
  svg.polygon(diamond,
              {.fill = "#ffffff", .stroke = std::string(kInk), .width = 0.25, .dashes = {}});
}

/// Draws the points; the values must be sorted.
void draw_points(Svg& svg, const std::vector<double>& sorted, const BoxPlace& place,
                 const Axis& axis, const std::string& color) {
  constexpr std::size_t kMany = 60;
  const double radius = sorted.size() > kMany ? 0.3 : 0.45;
  svg.dots(point_places(sorted, place, axis), radius,
           sorted.size() > kMany ? lightened(color, 0.35) : color);
}

/// Writes "x12" to the right of each value, unless the values are too close to each other.
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
    const double x = place.middle + place.half + kBeforeCount;
    if (x + text_width(text, kCountSize) > place.end) continue;
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

/// Spreads points over the box in steps of the golden ratio, in the order of the values, so that
/// neighbouring values, and especially equal ones, are far apart.
std::vector<PagePoint> point_places(const std::vector<double>& values, const BoxPlace& place,
                                    const Axis& axis) {
  constexpr double kGolden = 0.6180339887498949;
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return values[i]; });
  std::vector<PagePoint> points(values.size());
  double part = 0.5;
  for (const std::size_t i : order) {
    points[i] = place.at((part - 0.5) * 1.6 * place.half, axis.at(values[i]));
    part += kGolden;
    part -= std::floor(part);
  }
  return points;
}

void draw_marks(Svg& svg, const ScorePanel& panel, const std::vector<BoxPlace>& places,
                const Axis& axis) {
  std::vector<BoxNumbers> boxes;
  std::vector<std::vector<PagePoint>> points;
  for (std::size_t i = 0; i < panel.groups.size(); ++i) {
    const ScoreGroup& group = panel.groups[i];
    boxes.push_back(box_numbers(group.values));
    points.push_back(point_places(group.values, places[i], axis));
    svg.polygon(corners_of(boxes[i], places[i], axis),
                filled(lightened(distinct_color(group.color), 0.75)));
  }
  for (const ScoreLink& link : panel.links)
    draw_segment(svg, points[link.from][link.from_value], points[link.to][link.to_value], kLink,
                 0.15);
  for (std::size_t i = 0; i < panel.groups.size(); ++i) {
    const std::string color = distinct_color(panel.groups[i].color);
    std::vector<double> sorted = panel.groups[i].values;
    std::ranges::sort(sorted);
    draw_points(svg, sorted, places[i], axis, color);
    draw_lines(svg, boxes[i], places[i], axis, color);
    draw_mean(svg, boxes[i].mean, places[i], axis);
    if (!places[i].lies) draw_counts(svg, sorted, places[i], axis);
  }
}

}  // namespace swarmsmith
