#include "analysis/machines/tree_layout.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "analysis/drawing/figure_style.h"
#include "analysis/machines/internal/edge_curve.h"
#include "analysis/machines/internal/label_lines.h"
#include "analysis/machines/internal/machine_labels.h"
#include "sim/control/flavour.h"
#include "sim/control/tree.h"

namespace swarmsmith {
namespace {

constexpr double kDrop = 5;     ///< height of the edges between two levels
constexpr double kLeafGap = 2;  ///< between shapes side by side or below each other
constexpr double kLane = 1.8;   ///< from a condition's box to the edge that passes it
constexpr double kWidestGap = 12;

/// The form in which a tree is drawn.
struct Form {
  LabelSizes sizes;
  bool narrow = false;   ///< one word per line
  bool stepped = false;  ///< actions are below their conditions
};

LeafShape condition_shape(const Condition& condition, const Flavour& flavour, const Form& form) {
  const ModuleLabel label = label_of(condition, flavour);
  LeafShape shape{.centre = {},
                  .lines = lines_of(form.narrow ? narrowed(label) : label, form.sizes.condition)};
  shape.width = box_width(shape.lines);
  shape.height = box_height(shape.lines);
  return shape;
}

LeafShape action_shape(const Behaviour& action, const Flavour& flavour, const Form& form) {
  const ModuleLabel label = label_of(action, flavour);
  return {.centre = {}, .lines = lines_of(form.narrow ? narrowed(label) : label, form.sizes.state)};
}

/// Shapes with their labels and sizes, but without positions.
TreeLayout without_places(const Tree& tree, const Flavour& flavour, const Form& form) {
  TreeLayout layout;
  layout.sign_size = 1.3 * form.sizes.state;
  layout.node_side = 2.2 * form.sizes.state;
  double radius = 0;
  for (const Subtree& subtree : tree.subtrees) {
    layout.subtrees.push_back({.selector = {},
                               .condition = condition_shape(subtree.condition, flavour, form),
                               .action = action_shape(subtree.action, flavour, form),
                               .to_selector = {},
                               .to_condition = {},
                               .to_action = {}});
    radius = std::max(radius, radius_round(layout.subtrees.back().action.lines) + 0.6);
  }
  for (SubtreeShape& shape : layout.subtrees)
    shape.action.width = shape.action.height = 2 * radius;
  return layout;
}

double width_of(const SubtreeShape& shape, const Form& form) {
  if (form.stepped) return std::max(shape.condition.width + 2 * kLane, shape.action.width);
  return shape.condition.width + kLeafGap + shape.action.width;
}

/// The width of all subtrees with the smallest gaps between them.
double least_width(const TreeLayout& layout, const Form& form) {
  double width = -kLeafGap;
  for (const SubtreeShape& shape : layout.subtrees)
    width += width_of(shape, form) + kLeafGap;
  return width;
}

void put(LeafShape& shape, PagePoint centre) {
  shape.centre = centre;
  move_lines(shape.lines, centre);
}

/// Places them side by side, with their centres at the same height.
void put_beside(SubtreeShape& shape, double left, double top, double row_height) {
  const double y = top + row_height / 2;
  put(shape.condition, {left + shape.condition.width / 2, y});
  put(shape.action, {left + shape.condition.width + kLeafGap + shape.action.width / 2, y});
  shape.selector.x = (shape.condition.centre.x + shape.action.centre.x) / 2;
}

/// Places the action below the condition; `row_height` is the height of the highest condition.
void put_below(SubtreeShape& shape, double left, double top, double row_height, double width) {
  const double x = left + width / 2;
  put(shape.condition, {x, top + shape.condition.height / 2});
  put(shape.action, {x, top + row_height + kLeafGap + shape.action.height / 2});
  shape.selector.x = x;
}

/// The point where a line from `from` to the circle's centre meets the circle.
PagePoint on_circle(const LeafShape& circle, PagePoint from) {
  const PagePoint away = from - circle.centre;
  return circle.centre + (circle.width / 2 / std::max(1e-9, length_of(away))) * away;
}

void connect(TreeLayout& layout, SubtreeShape& shape, const Form& form) {
  const double half = layout.node_side / 2;
  const PagePoint below_root{layout.root.x, layout.root.y + half};
  const PagePoint below{shape.selector.x, shape.selector.y + half};
  const LeafShape& box = shape.condition;
  shape.to_selector = {below_root, {shape.selector.x, shape.selector.y - half}};
  shape.to_condition = {below, {box.centre.x, box.centre.y - box.height / 2}};
  if (!form.stepped) {
    shape.to_action = {below, on_circle(shape.action, {shape.action.centre.x, below.y})};
    return;
  }
  // Passes the condition on its right side.
  const double lane = box.centre.x + box.width / 2 + kLane / 2;
  const PagePoint beside{lane, box.centre.y - box.height / 2};
  const PagePoint corner{lane, std::max(box.centre.y + box.height / 2,
                                        shape.action.centre.y - shape.action.height / 2 - 0.5)};
  shape.to_action = {below, beside, corner, on_circle(shape.action, corner)};
}

/// Places everything on the page, with subtrees evenly spaced.
void place(TreeLayout& layout, const Form& form, double width_mm) {
  const auto count = static_cast<double>(layout.subtrees.size());
  const double spare = width_mm - 2 * kMargin - least_width(layout, form);
  const double gap = kLeafGap + (count > 1 ? std::min(spare / (count - 1), kWidestGap) : 0);
  double left = (width_mm - least_width(layout, form) - (count - 1) * (gap - kLeafGap)) / 2;
  // Keeps long edges from being too flat.
  const double selectors = kMargin + layout.node_side * 1.5 + std::max(kDrop, 0.06 * width_mm);
  const double top = selectors + layout.node_side / 2 + kDrop;
  double row_height = 0;
  for (const SubtreeShape& shape : layout.subtrees) {
    row_height = std::max(row_height, shape.condition.height);
    if (!form.stepped) row_height = std::max(row_height, shape.action.height);
  }
  layout.width = width_mm;
  layout.height = top + row_height + kMargin;
  if (form.stepped) layout.height += kLeafGap + layout.subtrees.front().action.height;
  for (SubtreeShape& shape : layout.subtrees) {
    shape.selector.y = selectors;
    const double width = width_of(shape, form);
    if (form.stepped) put_below(shape, left, top, row_height, width);
    if (!form.stepped) put_beside(shape, left, top, row_height);
    left += width + gap;
  }
  layout.root = {(layout.subtrees.front().selector.x + layout.subtrees.back().selector.x) / 2,
                 kMargin + layout.node_side / 2};
  for (SubtreeShape& shape : layout.subtrees)
    connect(layout, shape, form);
}

}  // namespace

TreeLayout lay_out(const Tree& tree, const Flavour& flavour, double width_mm) {
  if (width_mm < kNarrowestMachine_mm) throw std::invalid_argument("the page is too narrow");
  if (tree.subtrees.empty()) throw std::invalid_argument("a tree has a subtree");
  Form form{.sizes = label_sizes(width_mm)};
  for (const auto& [narrow, stepped] : {std::pair(false, false), {true, false}, {false, true}}) {
    form.narrow = narrow;
    form.stepped = stepped;
    TreeLayout layout = without_places(tree, flavour, form);
    if (least_width(layout, form) > width_mm - 2 * kMargin) continue;
    place(layout, form, width_mm);
    return layout;
  }
  form.narrow = true;
  while (true) {
    TreeLayout layout = without_places(tree, flavour, form);
    // A tree with a hundred subtrees would not even fit with the smallest letters.
    if (least_width(layout, form) <= width_mm - 2 * kMargin || form.sizes.state < 0.5) {
      place(layout, form, width_mm);
      return layout;
    }
    form.sizes = {.state = 0.95 * form.sizes.state, .condition = 0.95 * form.sizes.condition};
  }
}

}  // namespace swarmsmith
