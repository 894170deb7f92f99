#include "analysis/drawing/svg.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "base/base64.h"
#include "base/shown_text.h"

namespace swarmsmith {
namespace {

/// The shortest text of the number in hundredths of a millimetre, which are finer than any printer.
std::string number(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::fixed, 2)
                       .ptr;
  std::string text(buffer.data(), end);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

/// A number of hundredths, without the 0 before the decimal point: 45 as ".45", -120 as "-1.2".
std::string hundredths_text(long hundredths) {
  std::string text = number(static_cast<double>(hundredths) / 100);
  const std::size_t at = text.starts_with('-') ? 1 : 0;
  if (text.substr(at).starts_with("0.")) text.erase(at, 1);
  return text;
}

/// Two numbers, with a blank only if it is needed to separate them.
std::string number_pair(long first, long second) {
  const std::string tail = hundredths_text(second);
  return hundredths_text(first) + (tail.starts_with('-') ? "" : " ") + tail;
}

std::string attribute(std::string_view name, std::string_view value) {
  return " " + std::string(name) + "=\"" + std::string(value) + "\"";
}

/// Characters with a meaning in XML are written as entities. Control characters, which XML cannot
/// contain, are written as escapes.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char letter : as_shown(text, Layout::Escaped)) {
    if (letter == '&') {
      result += "&amp;";
    } else if (letter == '<') {
      result += "&lt;";
    } else if (letter == '>') {
      result += "&gt;";
    } else if (letter == '"') {
      result += "&quot;";
    } else {
      result += letter;
    }
  }
  return result;
}

std::string attributes_of(const Paint& paint) {
  std::string text = attribute("fill", paint.fill);
  if (paint.stroke == "none") return text;
  text += attribute("stroke", paint.stroke) + attribute("stroke-width", number(paint.width));
  if (!paint.dashes.empty()) text += attribute("stroke-dasharray", paint.dashes);
  return text;
}

/// "M0 0L1 2 3 4": the letter L is needed only once.
std::string path_through(std::span<const PagePoint> points) {
  std::string data;
  for (std::size_t i = 0; i < points.size(); ++i) {
    data += i == 0 ? "M" : i == 1 ? "L" : " ";
    data += number(points[i].x) + " " + number(points[i].y);
  }
  return data;
}

/// The distance of a point from the segment between `a` and `b`.
double distance_from(PagePoint point, PagePoint a, PagePoint b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double length2 = dx * dx + dy * dy;
  double along = 0;
  if (length2 > 0) along = ((point.x - a.x) * dx + (point.y - a.y) * dy) / length2;
  along = std::clamp(along, 0.0, 1.0);
  const double ex = point.x - (a.x + along * dx);
  const double ey = point.y - (a.y + along * dy);
  return std::sqrt(ex * ex + ey * ey);
}

}  // namespace

Paint filled(std::string_view color) {
  return {.fill = std::string(color), .stroke = "none", .width = 0, .dashes = {}};
}

Paint stroked(std::string_view color, double width) {
  return {.fill = "none", .stroke = std::string(color), .width = width, .dashes = {}};
}

std::string distinct_color(std::size_t number) {
  // Blue, vermillion, green, purple, orange, sky blue, black; yellow is too pale for thin lines.
  constexpr std::array<std::string_view, kDistinctColors> kColors = {
      "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};
  return std::string(kColors[number % kDistinctColors]);
}

std::string lightened(const std::string& color, double towards_white) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string result = "#";
  for (std::size_t at = 1; at + 1 < color.size(); at += 2) {
    int channel = 0;
    std::from_chars(color.data() + at, color.data() + at + 2, channel, 16);
    const auto mixed =
        static_cast<std::size_t>(std::lround(channel + (255 - channel) * towards_white));
    result += kDigits[mixed / 16];
    result += kDigits[mixed % 16];
  }
  return result;
}

Expected<std::string> with_font(std::string svg, std::string_view font) {
  const bool is_name = !font.empty() && std::ranges::all_of(font, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == ' ' ||
           c == '-' || c == '_';
  });
  if (!is_name) {
    return bad_input(
        "a font's name consists of letters, digits, blanks and -, as in \"Linux Libertine\"",
        "--font");
  }
  const std::string fonts(kFigureFonts);
  const std::size_t at = svg.find(fonts);
  if (at != std::string::npos) svg.insert(at, "'" + std::string(font) + "', ");
  return svg;
}

Svg::Svg(double width_mm, double height_mm, std::string_view title, std::string_view description)
    : width_(width_mm), height_(height_mm) {
  const std::string w = number(width_mm);
  const std::string h = number(height_mm);
  head_ = "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", w + "mm") +
          attribute("height", h + "mm") + attribute("viewBox", "0 0 " + w + " " + h) +
          " role=\"img\" font-family=\"" + std::string(kFigureFonts) + "\">\n<title>" +
          escaped(title) + "</title>\n<desc>" + escaped(description) + "</desc>\n";
}

void Svg::circle(PagePoint centre, double radius, const Paint& paint) {
  shapes_ += "<circle" + attribute("cx", number(centre.x)) + attribute("cy", number(centre.y)) +
             attribute("r", number(radius)) + attributes_of(paint) + "/>\n";
}

void Svg::dots(std::span<const PagePoint> centres, double radius, std::string_view color) {
  if (centres.empty()) return;
  // A line of zero length with round ends is a circle.
  std::string data;
  for (const PagePoint centre : centres)
    data += "M" + number(centre.x) + " " + number(centre.y) + "h0";
  path(data, stroked(color, 2 * radius), R"( stroke-linecap="round")");
}

void Svg::image(PagePoint top_left, double width, double height, std::string_view png,
                double opacity) {
  shapes_ += "<image" + attribute("x", number(top_left.x)) + attribute("y", number(top_left.y)) +
             attribute("width", number(width)) + attribute("height", number(height)) +
             attribute("preserveAspectRatio", "none") + attribute("opacity", number(opacity)) +
             attribute("image-rendering", "pixelated") +
             attribute("href", "data:image/png;base64," + base64_text(png)) + "/>\n";
}

void Svg::path(const std::string& data, const Paint& paint, std::string_view more) {
  shapes_ += "<path" + attribute("d", data) + attributes_of(paint) + std::string(more) + "/>\n";
}

void Svg::polygon(std::span<const PagePoint> corners, const Paint& paint) {
  path(path_through(corners) + "Z", paint, "");
}

void Svg::bars(std::span<const PageBar> bars, double thickness, std::string_view color,
               BarDirection direction) {
  if (bars.empty()) return;
  // Uses whole hundredths, so that rounding errors of relative moves do not add up.
  const auto hundredths = [](double value) { return std::lround(100 * value); };
  const bool is_right = direction == BarDirection::Right;
  std::string data;
  long x = 0;
  long y = 0;
  for (const PageBar& bar : bars) {
    const long left = hundredths(bar.start.x);
    const long top = hundredths(bar.start.y);
    const double end = (is_right ? bar.start.x : bar.start.y) + bar.length;
    const long length = hundredths(end) - (is_right ? left : top);
    data += (data.empty() ? "M" : "m") + number_pair(left - x, top - y);
    data += (is_right ? "h" : "v") + hundredths_text(length);
    x = is_right ? left + length : left;
    y = is_right ? top : top + length;
  }
  path(data, stroked(color, thickness), R"( shape-rendering="crispEdges")");
}

void Svg::outside(std::span<const PagePoint> corners, const Paint& paint) {
  const std::array<PagePoint, 4> page = {{{0, 0}, {width_, 0}, {width_, height_}, {0, height_}}};
  path(path_through(page) + "Z" + path_through(corners) + "Z", paint, R"( fill-rule="evenodd")");
}

void Svg::line(std::span<const PagePoint> points, const Paint& paint) {
  path(path_through(points), paint, R"( stroke-linejoin="round" stroke-linecap="round")");
}

void Svg::curve(PagePoint from, PagePoint control, PagePoint to, const Paint& paint) {
  path("M" + number(from.x) + " " + number(from.y) + "Q" + number(control.x) + " " +
           number(control.y) + " " + number(to.x) + " " + number(to.y),
       paint, "");
}

void Svg::text(PagePoint at, std::string_view text, const TextStyle& style) {
  shapes_ += "<text" + attribute("x", number(at.x)) + attribute("y", number(at.y)) +
             attribute("font-size", number(style.size));
  if (style.anchor == TextStyle::Anchor::Middle) shapes_ += attribute("text-anchor", "middle");
  if (style.anchor == TextStyle::Anchor::End) shapes_ += attribute("text-anchor", "end");
  if (style.bold) shapes_ += attribute("font-weight", "bold");
  shapes_ += attribute("fill", style.fill) + ">" + escaped(text) + "</text>\n";
}

void Svg::begin_part(std::string_view name, std::size_t number) {
  shapes_ += "<g" + attribute("data-" + std::string(name), std::to_string(number)) + ">\n";
}

void Svg::end_part() {
  shapes_ += "</g>\n";
}

void Svg::add(const Svg& other, PagePoint at) {
  shapes_ += "<g" + attribute("transform", "translate(" + number(at.x) + " " + number(at.y) + ")") +
             ">\n" + other.shapes_ + "</g>\n";
}

std::string Svg::finish() const {
  return head_ + shapes_ + "</svg>\n";
}

std::vector<PagePoint> simplified(std::span<const PagePoint> points, double tolerance) {
  if (points.size() < 3) return {points.begin(), points.end()};
  std::vector<bool> kept(points.size(), false);
  kept.front() = kept.back() = true;
  // Sections between two kept points that are not processed yet.
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    std::size_t farthest = first;
    double distance = tolerance;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double here = distance_from(points[i], points[first], points[last]);
      if (here <= distance) continue;
      distance = here;
      farthest = i;
    }
    if (farthest == first) continue;
    kept[farthest] = true;
    open.emplace_back(first, farthest);
    open.emplace_back(farthest, last);
  }
  std::vector<PagePoint> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (kept[i]) result.push_back(points[i]);
  }
  return result;
}

double millimetres_from_text(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, double>, 4> kUnits = {
      {{"mm", 1}, {"cm", 10}, {"in", 25.4}, {"", 1}}};
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return -1;
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  while (text.starts_with(' '))
    text.remove_prefix(1);
  for (const auto& [unit, length_mm] : kUnits) {
    if (text == unit) return value * length_mm;
  }
  return -1;
}

}  // namespace swarmsmith
