#include "analysis/machines/internal/edge_places.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace swarmsmith {
namespace {

constexpr double kThroughState = 1000;
constexpr double kSideways = 0.35;  // per mm that the curve deviates from its chord,
constexpr double kBent = 30;        // plus the square of that divided by the chord's length
constexpr double kAlong = 0.3;      // per mm from the middle of the chord
constexpr double kWrongSide = 5;    // so that the two directions use different sides

/// Between a box and its own states: the arrow head, and a part of the line.
constexpr double kOwnGap = kArrowLength + 1.6;
/// Between a box and a curve that passes it.
constexpr double kCurveGap = 0.7;
/// Curves that are nearer than this run beside each other.
constexpr double kLineDistance = 1.3;

constexpr std::size_t kMostPlaces = 200;
constexpr std::array<double, 9> kParts = {0.5, 0.44, 0.56, 0.38, 0.62, 0.32, 0.68, 0.26, 0.74};

PageBox box_around(const std::array<PagePoint, kSegments + 1>& line) {
  PagePoint low = line[0];
  PagePoint high = line[0];
  for (const PagePoint& point : line) {
    low = {std::min(low.x, point.x), std::min(low.y, point.y)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y)};
  }
  return {0.5 * (low + high), (high.x - low.x) / 2, (high.y - low.y) / 2};
}

/// Whether a point is nearer to a segment than `kLineDistance`.
bool lies_beside(PagePoint point, PagePoint from, PagePoint to) {
  // Most segments are far away; this test needs no division.
  if (point.x < std::min(from.x, to.x) - kLineDistance) return false;
  if (point.x > std::max(from.x, to.x) + kLineDistance) return false;
  if (point.y < std::min(from.y, to.y) - kLineDistance) return false;
  if (point.y > std::max(from.y, to.y) + kLineDistance) return false;
  return distance_to_segment(point, from, to) < kLineDistance;
}

/// Adds the cost of conflicts between the states and the box or its curve.
void meet_states(const PlacingTask& task, const PlacingTask::Edge& edge, EdgePlace& place) {
  for (std::size_t state = 0; state < task.states.size(); ++state) {
    const bool own = state == edge.source || state == edge.target;
    const double room = distance_to(place.box, task.states[state]) - task.radius;
    const double wanted = own ? kOwnGap : kBoxGap;
    if (room < kBoxGap) {
      place.alone += kOverlap;
      place.apart = false;
    }
    if (room < wanted) place.alone += 40 * (wanted - room);
    if (own) continue;
    const PageBox around{task.states[state], task.radius, task.radius};
    if (overlap_of(place.around, around, 1) <= 0) continue;
    for (std::size_t i = 0; i < kSegments; ++i) {
      const double distance =
          distance_to_segment(task.states[state], place.line[i], place.line[i + 1]);
      if (distance > task.radius + 1) continue;
      place.alone += kThroughState;
      place.clear = false;
      break;
    }
  }
}

EdgePlace make_place(const PlacingTask& task, const PlacingTask::Edge& edge, PagePoint at) {
  EdgePlace place{.box = {at, edge.width / 2, edge.height / 2}, .line = {}, .around = {}};
  const EdgeCurve curve = edge_curve(task, edge, at);
  for (std::size_t i = 0; i <= kSegments; ++i)
    place.line[i] = point_on(curve, static_cast<double>(i) / kSegments);
  place.around = box_around(place.line);
  meet_states(task, edge, place);
  for (const PageBox& box : {place.box, place.around}) {
    const double beyond = std::max(task.left - (box.centre.x - box.half_width),
                                   box.centre.x + box.half_width - task.right);
    if (beyond <= 0) continue;
    place.alone += kOverlap + 40 * beyond;
    place.apart = false;
  }
  return place;
}

}  // namespace

EdgeCurve edge_curve(const PlacingTask& task, const PlacingTask::Edge& edge, PagePoint box) {
  return curve_through({task.states[edge.source], task.radius},
                       {task.states[edge.target], task.radius + kArrowLength}, box);
}

std::vector<EdgePlace> places_of(const PlacingTask& task, const PlacingTask::Edge& edge) {
  const PagePoint source = task.states[edge.source];
  const PagePoint chord = task.states[edge.target] - source;
  const double length = std::max(1e-9, length_of(chord));
  const PagePoint normal{-chord.y / length, chord.x / length};
  // Places for boxes above each other are half a box height apart; for boxes side by side, a fifth
  // of their width.
  const bool stacked = std::fabs(normal.y) > 0.6;
  const double step = stacked ? (edge.height + kBoxGap) / 2 : (edge.width + kBoxGap) / 5;
  const auto rows = static_cast<int>(task.edges.size()) + 4;
  std::vector<EdgePlace> places;
  places.reserve(kParts.size() * static_cast<std::size_t>(2 * rows + 1));
  for (const double part : kParts) {
    for (int row = -rows; row <= rows; ++row) {
      const PagePoint at = source + part * chord + row * step * normal;
      EdgePlace place = make_place(task, edge, at);
      const double away = std::abs(row) * step / (4 * part * (1 - part));
      place.alone += kSideways * away + kBent * (away / length) * (away / length) +
                     kAlong * std::fabs(part - 0.5) * length + (row < 0 ? kWrongSide : 0);
      places.push_back(place);
    }
  }
  // A place is a large object, so only the places that stay are moved.
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return places[i].alone; });
  order.resize(std::min(order.size(), kMostPlaces));
  std::vector<EdgePlace> best;
  best.reserve(order.size());
  for (const std::size_t i : order)
    best.push_back(places[i]);
  return best;
}

double length_under(const EdgePlace& curve, const EdgePlace& other) {
  PageBox box = other.box;
  box.half_width += kCurveGap;
  box.half_height += kCurveGap;
  if (overlap_of(curve.around, box, 0) <= 0) return 0;
  double length = 0;
  for (std::size_t i = 0; i < kSegments; ++i)
    length += length_within(curve.line[i], curve.line[i + 1], box);
  return length;
}

int crossings(const EdgePlace& a, const EdgePlace& b) {
  if (overlap_of(a.around, b.around, 0) <= 0) return 0;
  int count = 0;
  for (std::size_t i = 0; i < kSegments; ++i) {
    for (std::size_t j = 0; j < kSegments; ++j)
      count += segments_cross(a.line[i], a.line[i + 1], b.line[j], b.line[j + 1]) ? 1 : 0;
  }
  return count;
}

int points_alongside(const EdgePlace& a, const EdgePlace& b) {
  if (overlap_of(a.around, b.around, kLineDistance) <= 0) return 0;
  int count = 0;
  for (const PagePoint& point : a.line) {
    bool beside = false;
    for (std::size_t i = 0; i < kSegments && !beside; ++i)
      beside = lies_beside(point, b.line[i], b.line[i + 1]);
    count += beside ? 1 : 0;
  }
  return count;
}

}  // namespace swarmsmith
