#include "analysis/drawing/axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "analysis/drawing/figure_style.h"
#include "base/shown_text.h"

namespace swarmsmith {
namespace {

constexpr std::string_view kGrid = "#dddddd";
constexpr double kTick = 1;
constexpr double kBandGap = 0.6;  ///< between the names of neighbouring bands

int decimals_of(double step) {
  int decimals = 0;
  // Steps are 1, 2 or 5 times a power of ten.
  while (decimals < 12 && step < 0.999) {
    step *= 10;
    ++decimals;
  }
  return decimals;
}

void draw_line(Svg& svg, PagePoint a, PagePoint b, std::string_view color, double width) {
  const std::array<PagePoint, 2> ends = {a, b};
  svg.line(ends, stroked(color, width));
}

double widest_word(std::string_view text, double size) {
  double widest = 0;
  while (!text.empty()) {
    const std::size_t blank = std::min(text.find(' '), text.size());
    widest = std::max(widest, text_width(text.substr(0, blank), size));
    text.remove_prefix(std::min(blank + 1, text.size()));
  }
  return widest;
}

/// The largest readable size at which every word of the names fits into its band.
double band_text_size(const Bands& bands, const std::vector<std::string>& names) {
  constexpr std::array<double, 3> kSizes = {kTextSize, 2.5, 2.2};
  for (const double size : kSizes) {
    const bool fits = std::ranges::all_of(names, [&](const std::string& name) {
      return widest_word(name, size) <= bands.width() - kBandGap;
    });
    if (fits) return size;
  }
  return kSizes.back();
}

std::vector<std::vector<std::string>> band_lines(const Bands& bands,
                                                 const std::vector<std::string>& names) {
  const double size = band_text_size(bands, names);
  std::vector<std::vector<std::string>> lines;
  lines.reserve(names.size());
  for (const std::string& name : names)
    lines.push_back(broken_text(name, size, bands.width() - kBandGap, kBandLines));
  return lines;
}

}  // namespace

ValueRange range_over(const std::vector<double>& values) {
  if (values.empty()) return {0, 1};
  const auto [least, largest] = std::ranges::minmax(values);
  if (least < largest) return {least, largest};
  const double aside = std::max(0.5, 0.1 * std::abs(least));
  return {least - aside, largest + aside};
}

double tick_step(ValueRange range, std::size_t most) {
  const double least =
      (range.high - range.low) / static_cast<double>(std::max<std::size_t>(1, most));
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double part : {1.0, 2.0, 5.0, 10.0})
    // The tolerance keeps a step that equals the least one except for rounding.
    if (part * power >= least * (1 - 1e-9)) return part * power;
  return 10 * power;
}

ValueRange rounded(ValueRange range, std::size_t most_ticks) {
  const double step = tick_step(range, most_ticks);
  return {step * std::floor(range.low / step + 1e-9), step * std::ceil(range.high / step - 1e-9)};
}

std::vector<double> ticks_in(ValueRange range, double step) {
  std::vector<double> ticks;
  const double first = std::ceil(range.low / step - 1e-9);
  const double last = std::floor(range.high / step + 1e-9);
  const auto count = static_cast<std::int64_t>(last - first) + 1;
  for (std::int64_t k = 0; k < count; ++k)
    ticks.push_back((first + static_cast<double>(k)) * step);
  return ticks;
}

std::string tick_text(double value, double step) {
  std::string text = fmt::format("{:.{}f}", value, decimals_of(step));
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  return is_zero && text.front() == '-' ? text.substr(1) : text;
}

std::size_t ticks_across(const Axis& axis) {
  const ValueRange range = axis.range();
  std::size_t most = kUsualTicks;
  for (; most > 2; --most) {
    const double step = tick_step(range, most);
    double widest = 0;
    for (const double tick : ticks_in(range, step))
      widest = std::max(widest, text_width(tick_text(tick, step), kTextSize));
    const double apart = std::abs(axis.at(range.low + step) - axis.at(range.low));
    if (widest + 1 <= apart) break;
  }
  return most;
}

double tick_room(ValueRange range, std::size_t most_ticks) {
  const double step = tick_step(range, most_ticks);
  double widest = 0;
  for (const double tick : ticks_in(range, step))
    widest = std::max(widest, text_width(tick_text(tick, step), kTextSize));
  return widest + 1.5;
}

double draw_heading(Svg& svg, std::string_view title, const std::vector<std::string>& details) {
  double y = kMargin;
  const double width = svg.width() - 2 * kMargin;
  if (!title.empty()) {
    y += kTitleSize;
    svg.text({kMargin, y}, fitted_text(title, kTitleSize * kBolder, width),
             {.size = kTitleSize, .bold = true, .fill = std::string(kInk)});
  }
  for (const std::string& line : details) {
    y += kLineHeight;
    svg.text({kMargin, y}, fitted_text(line, kTextSize, width), ink(TextStyle::Anchor::Start));
  }
  return y + 2;
}

void draw_vertical_axis(Svg& svg, const PlotArea& area, const Axis& axis, std::string_view label) {
  const double step = tick_step(axis.range(), kUsualTicks);
  for (const double tick : ticks_in(axis.range(), step)) {
    const double y = axis.at(tick);
    draw_line(svg, {area.left, y}, {area.right(), y}, kGrid, 0.15);
    svg.text({area.left - 1, y + 0.36 * kTextSize}, tick_text(tick, step),
             ink(TextStyle::Anchor::End));
  }
  draw_line(svg, {area.left, area.top}, {area.left, area.bottom()}, kInk, 0.2);
  if (label.empty()) return;
  svg.text({kMargin, area.top - 1.9}, label, ink(TextStyle::Anchor::Start));
}

void draw_horizontal_axis(Svg& svg, const PlotArea& area, const Axis& axis,
                          std::string_view label) {
  draw_line(svg, {area.left, area.bottom()}, {area.right(), area.bottom()}, kInk, 0.2);
  const double step = tick_step(axis.range(), ticks_across(axis));
  double free = -1e9;  // right end of the last text
  for (const double tick : ticks_in(axis.range(), step)) {
    const double x = axis.at(tick);
    draw_line(svg, {x, area.bottom()}, {x, area.bottom() + kTick}, kInk, 0.2);
    const std::string text = tick_text(tick, step);
    const double half = text_width(text, kTextSize) / 2;
    if (x - half < free) continue;  // a short axis has no room for this text
    free = x + half + 0.5;
    svg.text({x, area.bottom() + kTick + kTextSize}, text, ink(TextStyle::Anchor::Middle));
  }
  if (label.empty()) return;
  svg.text({area.left + area.width / 2, area.bottom() + kTick + kTextSize + kLineHeight}, label,
           ink(TextStyle::Anchor::Middle));
}

double band_axis_room(const Bands& bands, const std::vector<std::string>& names) {
  std::size_t most = 1;
  for (const auto& lines : band_lines(bands, names))
    most = std::max(most, lines.size());
  return kTick + kLineHeight * static_cast<double>(most);
}

bool band_names_fit(const Bands& bands, const std::vector<std::string>& names) {
  const double size = band_text_size(bands, names);
  return std::ranges::all_of(names, [&](const std::string& name) {
    const auto lines = broken_text(name, size, bands.width() - kBandGap, kBandLines);
    return std::ranges::none_of(lines,
                                [](const std::string& line) { return line.ends_with("\u2026"); });
  });
}

void draw_band_axis(Svg& svg, const PlotArea& area, const Bands& bands,
                    const std::vector<std::string>& names) {
  draw_line(svg, {area.left, area.bottom()}, {area.right(), area.bottom()}, kInk, 0.2);
  const auto texts = band_lines(bands, names);
  TextStyle style = ink(TextStyle::Anchor::Middle);
  style.size = band_text_size(bands, names);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    double y = area.bottom() + kTick + kTextSize;
    for (const std::string& line : texts[i]) {
      svg.text({bands.centre(i), y}, line, style);
      y += kLineHeight;
    }
  }
}

std::vector<std::string> broken_text(std::string_view text, double size, double width,
                                     std::size_t most) {
  std::vector<std::string> lines;
  std::string line;
  while (!text.empty()) {
    const std::size_t blank = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, blank);
    const std::string longer = line.empty() ? std::string(word) : line + " " + std::string(word);
    const bool is_last = lines.size() + 1 == most;
    if (line.empty() || is_last || text_width(longer, size) <= width) {
      line = longer;
    } else {
      lines.push_back(line);
      line = word;
    }
    text.remove_prefix(std::min(blank + 1, text.size()));
  }
  if (!line.empty()) lines.push_back(line);
  for (std::string& finished : lines)
    finished = fitted_text(finished, size, width);
  return lines;
}

std::vector<std::string> whole_lines(std::string_view name, double size, double width) {
  std::vector<std::string> lines;
  std::string line;
  const auto end_line = [&] {
    while (line.ends_with(' '))
      line.pop_back();
    if (!line.empty()) lines.push_back(std::exchange(line, ""));
  };
  while (!name.empty()) {
    const std::size_t part_end = std::min(name.find_first_of(" -_"), name.size() - 1) + 1;
    std::string_view part = name.substr(0, part_end);
    name.remove_prefix(part_end);
    const auto fits = [&](std::string_view longer) {
      return text_width(line + std::string(longer.substr(0, longer.find_last_not_of(' ') + 1)),
                        size) <= width;
    };
    if (!line.empty() && !fits(part)) end_line();
    while (!fits(part)) {  // removes letter by letter, but keeps at least one
      const auto after = [&](std::size_t at) {
        return at + std::max<std::size_t>(1, character_length(part.substr(at)));
      };
      std::size_t letters = after(0);
      while (letters < part.size() && fits(part.substr(0, after(letters))))
        letters = after(letters);
      if (letters >= part.size()) break;
      lines.emplace_back(part.substr(0, letters));
      part.remove_prefix(letters);
    }
    line += part;
  }
  end_line();
  return lines;
}

std::string sequential_color(double part) {
  constexpr std::array<std::array<int, 3>, 9> kColors = {{{253, 231, 37},
                                                          {170, 220, 50},
                                                          {93, 201, 99},
                                                          {39, 173, 129},
                                                          {33, 145, 140},
                                                          {44, 114, 142},
                                                          {59, 82, 139},
                                                          {71, 45, 123},
                                                          {68, 1, 84}}};
  const double place = std::clamp(part, 0.0, 1.0) * (kColors.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kColors.size() - 2);
  const double rest = place - static_cast<double>(below);
  std::array<int, 3> color{};
  for (std::size_t i = 0; i < 3; ++i) {
    color[i] = static_cast<int>(
        std::lround((1 - rest) * kColors[below][i] + rest * kColors[below + 1][i]));
  }
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

}  // namespace swarmsmith
