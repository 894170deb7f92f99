#include "analysis/machines/machine_layout.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "analysis/drawing/figure_style.h"
#include "analysis/machines/internal/condition_placing.h"
#include "analysis/machines/internal/label_lines.h"
#include "analysis/machines/internal/machine_labels.h"
#include "analysis/machines/internal/state_places.h"
#include "sim/control/flavour.h"
#include "sim/control/machine.h"

namespace swarmsmith {
namespace {

void refuse_wrong(const Machine& machine, double width_mm) {
  if (width_mm < kNarrowestMachine_mm) throw std::invalid_argument("the page is too narrow");
  if (machine.states.empty()) throw std::invalid_argument("a machine has a state");
  const int states = static_cast<int>(machine.states.size());
  for (int i = 0; i < states; ++i) {
    for (const Transition& transition : machine.states[static_cast<std::size_t>(i)].transitions) {
      if (transition.target < 0 || transition.target >= states || transition.target == i) {
        throw std::invalid_argument("a transition leads to another state");
      }
    }
  }
}

/// Shapes with their labels and sizes, but without positions.
MachineLayout without_places(const Machine& machine, const Flavour& flavour,
                             const LabelSizes& sizes) {
  MachineLayout layout;
  const std::vector<bool> reachable = reachable_states(machine);
  double radius = 0;
  for (const State& state : machine.states) {
    StateShape shape{.initial = layout.states.empty(),
                     .reachable = reachable[layout.states.size()],
                     .lines = lines_of(label_of(state.behaviour, flavour), sizes.state)};
    radius = std::max(radius, radius_round(shape.lines) + kInitialRing + 0.5);
    for (const Transition& transition : state.transitions) {
      ConditionShape condition{
          .source = layout.states.size(),
          .target = static_cast<std::size_t>(transition.target),
          .lines = lines_of(label_of(transition.condition, flavour), sizes.condition),
          .curve = {},
          .head = {}};
      condition.width = box_width(condition.lines);
      condition.height = box_height(condition.lines);
      layout.conditions.push_back(std::move(condition));
    }
    layout.states.push_back(std::move(shape));
  }
  for (StateShape& state : layout.states)
    state.radius = radius;
  return layout;
}

std::array<PagePoint, 3> arrow_head(const EdgeCurve& curve) {
  const PagePoint back = curve[1] - curve[2];
  const PagePoint along = (1 / std::max(1e-9, length_of(back))) * back;
  const PagePoint side{-along.y, along.x};
  const PagePoint tip = curve[2] - (kArrowLength - 0.15) * along;
  return {tip, curve[2] + 0.95 * side, curve[2] - 0.95 * side};
}

void put(MachineLayout& layout, const PlacingTask& task, const Placing& placing) {
  for (std::size_t i = 0; i < layout.states.size(); ++i) {
    layout.states[i].centre = task.states[i];
    move_lines(layout.states[i].lines, task.states[i]);
  }
  for (std::size_t i = 0; i < layout.conditions.size(); ++i) {
    ConditionShape& condition = layout.conditions[i];
    condition.centre = placing.boxes[i];
    move_lines(condition.lines, placing.boxes[i]);
    condition.curve = edge_curve(task, task.edges[i], placing.boxes[i]);
    condition.head = arrow_head(condition.curve);
  }
}

/// Centres everything on the page, below its upper margin, and sets the height of the page.
void fit_page(MachineLayout& layout, double width_mm) {
  PagePoint low{1e9, 1e9};
  PagePoint high{-1e9, -1e9};
  const auto cover = [&](PagePoint point, double x, double y) {
    low = {std::min(low.x, point.x - x), std::min(low.y, point.y - y)};
    high = {std::max(high.x, point.x + x), std::max(high.y, point.y + y)};
  };
  for (const StateShape& state : layout.states)
    cover(state.centre, state.radius, state.radius);
  for (const ConditionShape& condition : layout.conditions) {
    cover(condition.centre, condition.width / 2, condition.height / 2);
    for (int i = 0; i <= 20; ++i)
      cover(point_on(condition.curve, i / 20.0), 0.2, 0.2);
  }
  const PagePoint by{(width_mm - low.x - high.x) / 2, kMargin - low.y};
  for (StateShape& state : layout.states) {
    state.centre = state.centre + by;
    move_lines(state.lines, by);
  }
  for (ConditionShape& condition : layout.conditions) {
    condition.centre = condition.centre + by;
    move_lines(condition.lines, by);
    for (PagePoint& point : condition.curve)
      point = point + by;
    for (PagePoint& point : condition.head)
      point = point + by;
  }
  layout.width = width_mm;
  layout.height = high.y + by.y + kMargin;
  if (std::ranges::all_of(layout.states, &StateShape::reachable)) return;
  constexpr double kNoteSize = 2.5;
  layout.notes.push_back({.at = {width_mm / 2, layout.height + kNoteSize},
                          .text = "grey: no transition leads there",
                          .size = kNoteSize});
  layout.height += kNoteSize + kMargin;
}

}  // namespace

std::array<PagePoint, 6> corners_of(const ConditionShape& shape) {
  return pointed_box(shape.centre, shape.width, shape.height);
}

MachineLayout lay_out(const Machine& machine, const Flavour& flavour, double width_mm) {
  refuse_wrong(machine, width_mm);
  MachineLayout layout = without_places(machine, flavour, label_sizes(width_mm));
  PlacingTask task{.states = {},
                   .radius = layout.states.front().radius,
                   .edges = {},
                   .left = kMargin,
                   .right = width_mm - kMargin};
  for (const ConditionShape& condition : layout.conditions)
    task.edges.push_back({condition.source, condition.target, condition.width, condition.height});
  const Placing placing = place_all(task, layout.states.size());
  put(layout, task, placing);
  fit_page(layout, width_mm);
  return layout;
}

}  // namespace swarmsmith
