#include "analysis/machines/internal/state_places.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/math.h"

namespace swarmsmith {
namespace {

constexpr double kGrow = 1.15;
constexpr int kMostHeights = 14;
/// The number of best trials that are refined.
constexpr std::size_t kRefined = 3;
/// The number of further heights that are tried after a perfect result.
constexpr int kFurther = 1;
/// Costs per mm of height and width, added to the cost of a placing.
constexpr double kHeightCost = 0.8;
constexpr double kWidthCost = 0.15;

/// The states at the four corners, clockwise from the upper left one. State 0 is the first. The
/// others are chosen so that few transitions are diagonal, and then so that few are vertical: boxes
/// are wide, so they have more room stacked above each other between two states side by side.
std::array<std::size_t, 4> corners_by_traffic(const PlacingTask& task) {
  std::array<std::size_t, 4> order = {0, 1, 2, 3};
  std::array<std::size_t, 4> best = order;
  double least = std::numeric_limits<double>::infinity();
  do {
    double cost = 0;
    for (const PlacingTask::Edge& edge : task.edges) {
      const auto corner = [&](std::size_t state) {
        return static_cast<std::size_t>(std::ranges::find(order, state) - order.begin());
      };
      const std::size_t a = corner(edge.source);
      const std::size_t b = corner(edge.target);
      const bool across = (a + 2) % 4 == b;
      const bool sideways = a + b == 1 || a + b == 5;  // neighbours: 0 and 1, or 2 and 3
      cost += across ? 2 : sideways ? 0 : 0.8;
    }
    if (cost < least) {
      least = cost;
      best = order;
    }
  } while (std::next_permutation(order.begin() + 1, order.end()));
  return best;
}

/// The busiest pair is side by side, because boxes between them can be stacked. The third state is
/// below the pair, or above it if it is state 0, which is read first.
std::vector<PagePoint> triangle(const PlacingTask& task, PagePoint middle, double x, double y) {
  std::array<std::size_t, 3> traffic{};  // transitions between the other two states, by the third
  for (const PlacingTask::Edge& edge : task.edges)
    ++traffic[3 - edge.source - edge.target];
  const auto third = static_cast<std::size_t>(std::ranges::max_element(traffic) - traffic.begin());
  const PagePoint left{middle.x - x, middle.y};
  const PagePoint right{middle.x + x, middle.y};
  const PagePoint above{middle.x, middle.y - y};
  const PagePoint below{middle.x, middle.y + y};
  if (third == 0) return {above, right, left};
  if (third == 1) return {left, below, right};
  return {left, right, below};
}

/// Centres of states that are `width` and `height` apart.
std::vector<PagePoint> centres(const PlacingTask& task, std::size_t states, double width,
                               double height) {
  const double middle = (task.left + task.right) / 2;
  const double x = width / 2;
  const double y = height / 2;
  if (states == 1) return {{middle, 0}};
  if (states == 2) return {{middle - x, 0}, {middle + x, 0}};
  if (states == 3) return triangle(task, {middle, 0}, x, height);
  std::vector<PagePoint> result(states);
  if (states == 4) {
    const std::array<PagePoint, 4> corners = {
        {{middle - x, -y}, {middle + x, -y}, {middle + x, y}, {middle - x, y}}};
    const auto order = corners_by_traffic(task);
    for (std::size_t i = 0; i < 4; ++i)
      result[order[i]] = corners[i];
    return result;
  }
  for (std::size_t i = 0; i < states; ++i) {
    const double angle = kPi * (2 * static_cast<double>(i) / static_cast<double>(states) - 0.5);
    result[i] = {middle + x * cos(angle), y * sin(angle)};
  }
  return result;
}

/// Useful distances between columns of states, with room for one, two or three boxes.
std::vector<double> widths_for(const PlacingTask& task, std::size_t states) {
  const double most = task.right - task.left - 2 * task.radius;
  double box = 20;
  for (const PlacingTask::Edge& edge : task.edges)
    box = std::max(box, edge.width);
  std::vector<double> widths;
  for (const double boxes : {1.7, 2.5, 3.5}) {
    if (states == 2 && boxes > 2) break;
    if (states > 4) break;
    const double width = 2 * task.radius + boxes * box;
    if (width < most - 5) widths.push_back(width);
  }
  if (widths.empty() || states > 2) widths.push_back(most);
  return widths;
}

/// A placement of the states, and its result.
struct Trial {
  std::vector<PagePoint> states;
  Placing placing;
  double size_cost = 0;

  double cost() const { return placing.cost + size_cost; }
};

/// All distances between states, lowest cost first.
std::vector<Trial> trials_of(PlacingTask& task, std::size_t states) {
  std::vector<Trial> trials;
  for (const double width : widths_for(task, states)) {
    double height = 2 * task.radius + 14;
    // Neighbours on an ellipse must not touch.
    if (states > 4) height = std::max(height, static_cast<double>(states) * task.radius);
    int further = kFurther;
    for (int i = 0; i < kMostHeights && further >= 0; ++i) {
      task.states = centres(task, states, width, height);
      trials.push_back({.states = task.states,
                        .placing = place_conditions(task),
                        .size_cost = kHeightCost * height + kWidthCost * width});
      if (trials.back().placing.apart && trials.back().placing.clear) --further;
      if (states <= 2) break;
      height *= kGrow;
    }
  }
  std::ranges::stable_sort(trials, {}, &Trial::cost);
  return trials;
}

}  // namespace

Placing place_all(PlacingTask& task, std::size_t states) {
  std::vector<Trial> trials = trials_of(task, states);
  if (trials.size() > kRefined) trials.resize(kRefined);
  for (Trial& trial : trials) {
    task.states = trial.states;
    trial.placing = refine_conditions(task, trial.placing);
  }
  Trial& best = *std::ranges::min_element(trials, {}, &Trial::cost);
  task.states = std::move(best.states);
  return std::move(best.placing);
}

}  // namespace swarmsmith
