#include "analysis/machines/internal/network_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/machines/internal/dot_text.h"
#include "analysis/machines/internal/label_lines.h"
#include "sim/control/network.h"

namespace swarmsmith {
namespace {

constexpr std::array<std::string_view, kWheels> kWheelNames = {"left wheel", "right wheel"};
constexpr std::string_view kForwards = "#0072b2";
constexpr std::string_view kBackwards = "#d55e00";

constexpr double kRow = 4.6;        ///< height of a cell
constexpr double kGroupGap = 1;     ///< between inputs of different sensors
constexpr double kWidestCell = 24;  ///< of a cell
constexpr double kBar = 3;          ///< width of the scale
constexpr double kBarGap = 5;
constexpr std::size_t kMostTicks = 11;
constexpr int kBarSteps = 50;

/// White at 0, the full colour of its sign at `most`.
std::string color_of(double weight, double most) {
  const double part = std::min(1.0, std::fabs(weight) / most);
  return lightened(std::string(weight < 0 ? kBackwards : kForwards), 1 - part);
}

/// The text colour with a contrast of at least 4.5:1: black on all orange cells, and on blue ones
/// that are light enough.
std::string_view ink_on(double weight, double most) {
  return weight > 0.93 * most ? "#ffffff" : "#000000";
}

/// The end of the scale; the same for all networks within the bounds of the search.
double end_of_scale(const Network& network) {
  double most = kMostWeight;
  for (const double weight : network.weights)
    most = std::max(most, std::fabs(weight));
  return rounded({-most, most}, kMostTicks).high;
}

/// "obstacle 45" as "obstacle 45°".
std::string shown_name(const std::string& name) {
  const bool is_angle = name.back() >= '0' && name.back() <= '9';
  return is_angle ? name + "°" : name;
}

/// The sensor of an input: the first word of the input's name.
std::string_view sensor_of(std::string_view name) {
  return name.substr(0, name.find(' '));
}

/// Positions of the table's rows and columns.
struct Table {
  std::vector<std::string> names;
  std::vector<double> tops;  ///< of the rows
  double bottom = 0;
  double left = 0;  ///< of the first column
  double cell = 0;  ///< width
  double size = 0;  ///< of letters
  double most = 0;  ///< end of the scale
};

double scale_width(const Table& table) {
  return kBarGap + kBar + 1 + text_width(tick_text(-table.most, 1), table.size);
}

Table table_of(const Network& network, double width_mm) {
  Table table{.names = input_names(network.inputs),
              .tops = {},
              .size = label_sizes(width_mm).condition,
              .most = end_of_scale(network)};
  double names = 0;
  for (std::string& name : table.names) {
    const bool is_new =
        table.tops.empty() || sensor_of(name) != sensor_of(table.names[table.tops.size() - 1]);
    if (table.tops.empty()) table.bottom = kMargin + 2 * kLinePitch * table.size;
    if (is_new && !table.tops.empty()) table.bottom += kGroupGap;
    table.tops.push_back(table.bottom);
    table.bottom += kRow;
    names = std::max(names, text_width(shown_name(name), table.size));
  }
  const double rest = width_mm - 2 * kMargin - names - 1 - scale_width(table);
  table.cell = std::min(rest / kWheels, kWidestCell);
  table.left = kMargin + names + 1 + (rest - kWheels * table.cell) / 2;
  return table;
}

void write(Sketch& sketch, PagePoint at, std::string text, double size, TextStyle::Anchor anchor,
           std::string_view color) {
  sketch.shapes.emplace_back(SketchText{
      at, std::move(text), {.size = size, .anchor = anchor, .fill = std::string(color)}});
}

/// Writes the names of columns on two lines, "left" above "wheel", so that they fit narrow cells.
void draw_columns(Sketch& sketch, const Table& table) {
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
    const double x = table.left + (static_cast<double>(wheel) + 0.5) * table.cell;
    const std::string_view name = kWheelNames[wheel];
    const std::size_t blank = name.find(' ');
    const double base = table.tops.front() - 1;
    write(sketch, {x, base - kLinePitch * table.size}, std::string(name.substr(0, blank)),
          table.size, TextStyle::Anchor::Middle, kInk);
    write(sketch, {x, base}, std::string(name.substr(blank + 1)), table.size,
          TextStyle::Anchor::Middle, kInk);
  }
}

void draw_rows(Sketch& sketch, const Table& table, const Network& network) {
  const std::size_t inputs = table.names.size();
  for (std::size_t i = 0; i < inputs; ++i) {
    const double top = table.tops[i];
    const double base = top + kRow / 2 + kMiddle * table.size;
    write(sketch, {table.left - 1, base}, shown_name(table.names[i]), table.size,
          TextStyle::Anchor::End, kInk);
    for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
      const double weight = network.weights[wheel * inputs + i];
      const double left = table.left + static_cast<double>(wheel) * table.cell;
      Paint paint = stroked("#b4b4b4", 0.1);
      paint.fill = color_of(weight, table.most);
      sketch.box({left, top}, table.cell, kRow, paint);
      write(sketch, {left + table.cell / 2, base}, tick_text(weight, 0.01), table.size,
            TextStyle::Anchor::Middle, ink_on(weight, table.most));
    }
  }
}

void draw_scale(Sketch& sketch, const Table& table) {
  const double left = table.left + kWheels * table.cell + kBarGap;
  const double top = table.tops.front();
  const Axis axis({-table.most, table.most}, table.bottom, top);
  // Each part extends to the top, so that no seams are visible between them.
  for (int i = 0; i < kBarSteps; ++i) {
    const double low = table.bottom + (top - table.bottom) * i / kBarSteps;
    const double value = table.most * (2 * (i + 0.5) / kBarSteps - 1);
    sketch.box({left, top}, kBar, low - top, filled(color_of(value, table.most)));
  }
  sketch.box({left, top}, kBar, table.bottom - top, stroked(kInk, 0.2));
  const double step = tick_step(axis.range(), kMostTicks);
  for (const double tick : ticks_in(axis.range(), step)) {
    const double y = axis.at(tick);
    const double base = std::clamp(y + kMiddle * table.size, top + 0.8 * table.size, table.bottom);
    sketch.shapes.emplace_back(
        SketchLine{{{left + kBar, y}, {left + kBar + 0.6, y}}, stroked(kInk, 0.2)});
    write(sketch, {left + kBar + 1, base}, tick_text(tick, step), table.size,
          TextStyle::Anchor::Start, kInk);
  }
}

}  // namespace

Sketch sketch_of(const Network& network, double width_mm) {
  if (width_mm < kNarrowestMachine_mm) throw std::invalid_argument("the page is too narrow");
  const Table table = table_of(network, width_mm);
  Sketch sketch{.width = width_mm, .height = 0, .shapes = {}, .states = {}};
  draw_columns(sketch, table);
  draw_rows(sketch, table, network);
  draw_scale(sketch, table);
  const double note = table.bottom + 1 + kLinePitch * table.size;
  write(sketch, {width_mm / 2, note}, "weights (no unit); above 0: the wheel turns forwards",
        table.size, TextStyle::Anchor::Middle, kInk);
  sketch.height = note + kMargin;
  return sketch;
}

std::string dot_of(const Network& network, std::string_view title) {
  std::string text = "digraph " + dot_text(title) + " {\n  rankdir=LR;\n  ranksep=3;\n";
  text += "  node [fontname=\"Helvetica\", fontsize=10];\n";
  text += "  edge [fontname=\"Helvetica\", fontsize=8, arrowsize=0.5];\n";
  const std::vector<std::string> names = input_names(network.inputs);
  const double most = end_of_scale(network);
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel)
    text += fmt::format("  w{} [shape=circle, label={}];\n", wheel, dot_text(kWheelNames[wheel]));
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += fmt::format("  i{} [shape=box, label={}];\n", i, dot_text(shown_name(names[i])));
    for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
      const double weight = network.weights[wheel * names.size() + i];
      text += fmt::format("  i{} -> w{} [label=\"{}\", color=\"{}\", penwidth={:.2f}];\n", i, wheel,
                          tick_text(weight, 0.01), weight < 0 ? kBackwards : kForwards,
                          0.3 + 3 * std::fabs(weight) / most);
    }
  }
  return text + "}\n";
}

}  // namespace swarmsmith
