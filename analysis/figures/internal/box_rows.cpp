#include "analysis/figures/internal/box_rows.h"

#include <algorithm>

#include <fmt/format.h>

#include "analysis/drawing/figure_style.h"
#include "analysis/figures/internal/box_marks.h"

namespace swarmsmith {
namespace {

constexpr double kRow = 5.4;      ///< height for one box
constexpr double kPairRow = 7.4;  ///< height for two boxes
constexpr double kLeastSqueeze = 0.55;
constexpr double kMostNamePart = 0.42;  ///< relative to a panel's width
constexpr double kLeastArea = 34;       ///< minimum width of the boxes beside their names
constexpr double kNameLine = 3.2;
constexpr double kBeforeName = 1.5;
constexpr double kCounts = 6;  ///< width of the column with n
constexpr double kCountSize = 2.2;
constexpr double kAxisRoom = 7;
constexpr std::string_view kGuide = "#dddddd";

double widest_name(const std::vector<ScorePanel>& panels) {
  double widest = 0;
  for (const ScorePanel& panel : panels) {
    for (const std::string& name : names_of(panel))
      widest = std::max(widest, text_width(name, kTextSize));
  }
  return widest;
}

}  // namespace

bool has_pairs(const ScorePanel& panel) {
  return !panel.groups.empty() && panel.groups.front().narrow;
}

std::vector<std::string> names_of(const ScorePanel& panel) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < panel.groups.size(); i += has_pairs(panel) ? 2U : 1U)
    names.push_back(panel.groups[i].name);
  return names;
}

ValueRange range_of(const ScorePanel& panel) {
  std::vector<double> all;
  for (const ScoreGroup& group : panel.groups)
    all.insert(all.end(), group.values.begin(), group.values.end());
  return rounded(range_over(all), kUsualTicks);
}

BoxRows::BoxRows(const std::vector<ScorePanel>& panels, double page_width, double most_height)
    : panels_(panels),
      grid_(panels.size(), std::min(widest_name(panels), kMostNamePart * page_width) + kLeastArea,
            page_width),
      names_(std::min(widest_name(panels), kMostNamePart * grid_.width())) {
  while (height() > most_height && squeeze_ > kLeastSqueeze)
    squeeze_ -= 0.05;
}

double BoxRows::least_height(const std::string& name) const {
  return kNameLine * static_cast<double>(whole_lines(name, kTextSize, names_).size()) + 0.2;
}

double BoxRows::row_height(const ScorePanel& panel, std::size_t name) const {
  const double usual = has_pairs(panel) ? kPairRow : kRow;
  return std::max(usual * squeeze_, least_height(names_of(panel)[name]));
}

double BoxRows::height_of(const ScorePanel& panel) const {
  double height = kPanelTitleRoom + kAxisRoom;
  for (std::size_t i = 0; i < names_of(panel).size(); ++i)
    height += row_height(panel, i);
  return height;
}

double BoxRows::height_of_row(std::size_t row) const {
  double height = 0;
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    if (grid_.row_of(i) == row) height = std::max(height, height_of(panels_[i]));
  }
  return height;
}

double BoxRows::height() const {
  double height = 0;
  for (std::size_t row = 0; row < grid_.rows(); ++row)
    height += height_of_row(row);
  return height;
}

void BoxRows::draw(Svg& svg, double top) const {
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    double above = top;
    for (std::size_t row = 0; row < grid_.row_of(i); ++row)
      above += height_of_row(row);
    draw_panel(svg, panels_[i], grid_.left_of(i), above);
  }
}

void BoxRows::draw_panel(Svg& svg, const ScorePanel& panel, double left, double top) const {
  PlotArea area{.left = left + names_ + kBeforeName,
                .top = top + kPanelTitleRoom,
                .height = height_of(panel) - kPanelTitleRoom - kAxisRoom};
  area.width = left + grid_.width() - kCounts - area.left;
  draw_panel_title(svg, panel.title, left, area.top, grid_.width() - kCounts);
  svg.text({area.right() + kCounts, area.top - 1}, "n", ink(TextStyle::Anchor::End, kCountSize));
  // Keeps the outermost values away from the ends.
  const Axis x(range_of(panel), area.left + 1.5, area.right() - 1.5);
  const double step = tick_step(x.range(), ticks_across(x));
  for (const double tick : ticks_in(x.range(), step)) {
    const std::vector<PagePoint> line = {{x.at(tick), area.top}, {x.at(tick), area.bottom()}};
    svg.line(line, stroked(kGuide, 0.15));
  }
  draw_horizontal_axis(svg, area, x, "");
  const std::vector<std::string> names = names_of(panel);
  const std::size_t in_row = has_pairs(panel) ? 2 : 1;
  std::vector<BoxPlace> places;
  double y = area.top;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double height = row_height(panel, i);
    const auto lines = whole_lines(names[i], kTextSize, names_);
    double base =
        y + height / 2 + 0.36 * kTextSize - kNameLine * static_cast<double>(lines.size() - 1) / 2;
    for (const std::string& line : lines) {
      svg.text({area.left - kBeforeName, base}, line, ink(TextStyle::Anchor::End));
      base += kNameLine;
    }
    std::vector<std::string> counts;
    for (std::size_t k = 0; k < in_row; ++k) {
      const double part = height * 0.94 / static_cast<double>(in_row);
      places.push_back({.middle = y + height * 0.03 + part * (static_cast<double>(k) + 0.5),
                        .half = part * (panel.groups[in_row * i + k].narrow ? 0.22 : 0.4),
                        .end = y + height,
                        .lies = true});
      counts.push_back(fmt::format("{}", panel.groups[in_row * i + k].values.size()));
    }
    if (in_row == 2 && counts[0] != counts[1]) counts[0] += "/" + counts[1];
    svg.text({area.right() + kCounts, y + height / 2 + 0.36 * kCountSize}, counts[0],
             ink(TextStyle::Anchor::End, kCountSize));
    y += height;
  }
  draw_marks(svg, panel, places, x);
}

}  // namespace swarmsmith
