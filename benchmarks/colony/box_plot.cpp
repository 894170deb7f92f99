#include "benchmarks/colony/box_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/drawing/svg.h"
#include "analysis/statistics/summary.h"

namespace swarmsmith {
namespace {

constexpr double kLeft = 17;  // mm, for the axis
constexpr double kTop = 9;
constexpr double kHeight = 60;
constexpr double kStep = 14;  // from box to box
constexpr double kBox = 7;    // width of a box
const char* const kInk = "#222222";

/// A step of the axis that gives four to eight ticks: 1, 2 or 5 times a power of ten.
double tick_of(double range) {
  const double power = std::pow(10, std::floor(std::log10(range / 4)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (range / (step * power) <= 8) return step * power;
  }
  return 10 * power;
}

/// From values to the page.
struct Axis {
  double low;
  double high;
  double y(double value) const { return kTop + kHeight * (high - value) / (high - low); }
};

Axis axis_of(const std::vector<BoxedSample>& samples) {
  double low = samples.front().values.front();
  double high = low;
  for (const BoxedSample& sample : samples) {
    low = std::min(low, std::ranges::min(sample.values));
    high = std::max(high, std::ranges::max(sample.values));
  }
  const double tick = tick_of(high - low);
  return {std::floor(low / tick) * tick, std::ceil(high / tick) * tick};
}

void draw_axis(Svg& svg, const Axis& axis, const std::string& name) {
  const double tick = tick_of(axis.high - axis.low);
  const int count = static_cast<int>(std::round((axis.high - axis.low) / tick));
  for (int i = 0; i <= count; ++i) {
    const double value = axis.low + i * tick;
    const PagePoint ends[] = {{kLeft, axis.y(value)}, {svg.width() - 2, axis.y(value)}};
    svg.line(ends, stroked("#dddddd", 0.15));
    svg.text({kLeft - 1.5, axis.y(value) + 1}, fmt::format("{:.6g}", value),
             {.anchor = TextStyle::Anchor::End, .fill = kInk});
  }
  svg.text({2, kTop - 3}, name, {.fill = kInk});
}

void draw_box(Svg& svg, const BoxedSample& sample, const Axis& axis, double x) {
  const std::string color = distinct_color(sample.color);
  const auto y = [&](double p) { return axis.y(quantile_of(sample.values, p)); };
  const double half = kBox / 2;
  const PagePoint box[] = {
      {x - half, y(0.25)}, {x + half, y(0.25)}, {x + half, y(0.75)}, {x - half, y(0.75)}};
  svg.polygon(box, {.fill = lightened(color, 0.75), .stroke = color, .width = 0.3, .dashes = ""});
  for (const auto& [from, to] : {std::pair{0.0, 0.25}, std::pair{0.75, 1.0}}) {
    const PagePoint whisker[] = {{x, y(from)}, {x, y(to)}};
    svg.line(whisker, stroked(color, 0.3));
  }
  const PagePoint median[] = {{x - half, y(0.5)}, {x + half, y(0.5)}};
  svg.line(median, stroked(kInk, 0.5));
  for (std::size_t i = 0; i < sample.values.size(); ++i) {
    // Side by side, in an order that has nothing to do with the values.
    const double aside = (static_cast<double>(i * 7 % 11) / 10 - 0.5) * 0.7 * kBox;
    svg.circle({x + aside, axis.y(sample.values[i])}, 0.35, filled(color));
  }
}

}  // namespace

std::string box_plot(const std::vector<BoxedSample>& samples, const std::string& title,
                     const std::string& axis_name) {
  const double width = kLeft + kStep * static_cast<double>(samples.size()) + 2;
  Svg svg(width, kTop + kHeight + 12, title, axis_name);
  const Axis axis = axis_of(samples);
  draw_axis(svg, axis, axis_name);
  double first_of_group = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double x = kLeft + kStep * (static_cast<double>(i) + 0.5);
    draw_box(svg, samples[i], axis, x);
    const TextStyle middle{.anchor = TextStyle::Anchor::Middle, .fill = kInk};
    svg.text({x, kTop + kHeight + 4.5}, samples[i].label, middle);
    if (i == 0 || samples[i].group != samples[i - 1].group) first_of_group = x;
    if (i + 1 == samples.size() || samples[i].group != samples[i + 1].group) {
      svg.text({(first_of_group + x) / 2, kTop + kHeight + 9}, samples[i].group, middle);
    }
  }
  return svg.finish();
}

}  // namespace swarmsmith
