#include "tracking/report/timeline.h"

#include <algorithm>
#include <array>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/drawing/legend.h"
#include "sim/control/reference_model.h"

namespace swarmsmith {
namespace {

constexpr double kRow = 7;
constexpr double kIssueRow = 4.4;

/// The kinds differ in colour, in brightness and in height.
struct KindStyle {
  std::string_view name;
  std::string_view color;
  double height;
};
constexpr std::array<KindStyle, 4> kKinds = {{{"measured", "#9ecae1", 2.2},
                                              {"interpolated (up to 0.5 s)", "#e69f00", 3.2},
                                              {"degraded (up to 1 s)", "#d55e00", 4.2},
                                              {"missing", "#000000", 4.2}}};
constexpr std::string_view kDropped = "#7b3294";

/// Draws a bar for each run of cycles of the same kind.
void draw_strip(Svg& svg, const TrackedRobot& robot, const Axis& axis, double middle) {
  std::array<std::vector<PageBar>, kKinds.size()> bars;
  for (std::size_t at = 0; at < robot.cycles.size();) {
    std::size_t end = at;
    while (end < robot.cycles.size() && robot.cycles[end] == robot.cycles[at])
      ++end;
    const double from = axis.at(static_cast<double>(at) * kControlPeriod_s);
    const double to = axis.at(static_cast<double>(end) * kControlPeriod_s);
    bars.at(static_cast<std::size_t>(robot.cycles[at])).push_back({{from, middle}, to - from});
    at = end;
  }
  for (std::size_t kind = 0; kind < bars.size(); ++kind)
    svg.bars(bars.at(kind), kKinds.at(kind).height, kKinds.at(kind).color);
}

/// Draws short marks below the strip.
void draw_dropped(Svg& svg, const TrackedRobot& robot, const Axis& axis, double middle) {
  constexpr double kLength = 1.2;
  std::vector<PageBar> marks;
  for (const Sample& sample : robot.samples) {
    if (sample.use == Sample::Use::Used) continue;
    if (sample.time_s < axis.range().low || sample.time_s > axis.range().high) continue;
    marks.push_back({{axis.at(sample.time_s), middle + 2.3}, kLength});
  }
  svg.bars(marks, 0.3, kDropped, BarDirection::Down);
}

/// The issues with a time, the earliest ones first and at most twelve.
std::vector<const Issue*> timed(const std::vector<Issue>& issues) {
  std::vector<const Issue*> found;
  for (const Issue& issue : issues)
    if (issue.from) found.push_back(&issue);
  std::stable_sort(found.begin(), found.end(),
                   [](const Issue* a, const Issue* b) { return *a->from < *b->from; });
  constexpr std::size_t kMostIssues = 12;
  if (found.size() > kMostIssues) found.resize(kMostIssues);
  return found;
}

void draw_issue(Svg& svg, const Issue& issue, const Axis& axis, double y) {
  const ValueRange range = axis.range();
  const double from = axis.at(std::clamp(*issue.from, range.low, range.high));
  const double to = axis.at(std::clamp(issue.to.value_or(*issue.from), range.low, range.high));
  const std::array<PageBar, 1> bar = {{{{from, y}, std::max(to - from, 0.4)}}};
  svg.bars(bar, 1.6, is_error(issue.code) ? "#d55e00" : "#e69f00");
  const std::string text =
      std::string(name_of(issue.code)) + (issue.robot.empty() ? "" : " " + issue.robot);
  const double width = text_width(text, kTextSize);
  const bool is_left = to + 1 + width > axis.to();
  svg.text({is_left ? from - 1 : to + 1, y + 1}, text,
           {.size = kTextSize,
            .anchor = is_left ? TextStyle::Anchor::End : TextStyle::Anchor::Start,
            .fill = std::string(kInk)});
}

}  // namespace

std::string timeline(const TrackedRun& run, const std::vector<Issue>& issues, double width_mm) {
  double names = 10;
  for (const TrackedRobot& robot : run.robots)
    names = std::max(names, text_width(robot.name, kTextSize));
  names = std::min(names, width_mm / 4);
  const std::vector<const Issue*> marked = timed(issues);
  const double rows = kRow * static_cast<double>(run.robots.size());
  const double issue_rows = kIssueRow * static_cast<double>(marked.size());
  const PlotArea area{kMargin + names + 2, kMargin, width_mm - 2 * kMargin - names - 6,
                      rows + issue_rows + 1};
  std::vector<LegendEntry> entries;
  entries.reserve(std::size(kKinds) + 1);
  for (const KindStyle& kind : kKinds)
    entries.push_back({std::string(kind.color), std::string(kind.name)});
  entries.push_back({std::string(kDropped), "sample dropped"});
  const FlowingLegend legend(entries, width_mm - 2 * kMargin);
  const double legend_top = area.bottom() + kHorizontalAxisRoom + 3;
  Svg svg(width_mm, legend_top + legend.height() + kMargin, "Timeline",
          "How each robot's pose was obtained, over the time of the run");
  const double duration = std::max(run.trajectory.instants(), 1) * kControlPeriod_s;
  const Axis axis({0, duration}, area.left, area.right());
  for (std::size_t i = 0; i < run.robots.size(); ++i) {
    const double middle = area.top + kRow * (static_cast<double>(i) + 0.4);
    svg.text({area.left - 2, middle + 1}, fitted_text(run.robots[i].name, kTextSize, names),
             {.size = kTextSize, .anchor = TextStyle::Anchor::End, .fill = std::string(kInk)});
    draw_strip(svg, run.robots[i], axis, middle);
    draw_dropped(svg, run.robots[i], axis, middle);
  }
  for (std::size_t i = 0; i < marked.size(); ++i) {
    draw_issue(svg, *marked[i], axis, area.top + rows + kIssueRow * (static_cast<double>(i) + 0.5));
  }
  draw_horizontal_axis(svg, area, axis, "time of the run (s)");
  legend.draw(svg, legend_top);
  return svg.finish();
}

}  // namespace swarmsmith
