#include "analysis/machines/internal/condition_placing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace swarmsmith {
namespace {

// Costs, in millimetres of way from the middle of an edge, as it were.
constexpr double kOverlap = 2000;      // of two things that must not, and more by its depth
constexpr double kUnderBox = 60;       // a curve that passes under a box,
constexpr double kUnderBoxLength = 8;  // and more by the mm of it
constexpr double kThroughState = 1000;
constexpr double kCrossing = 7;
constexpr double kCrowded = 12;  // a mm of two ends of curves that are nearer than kEndDistance
constexpr double kEndDistance = 2.4;
constexpr double kAlongside = 8;  // a tenth of a curve that is nearer to another than kLineDistance
constexpr double kLineDistance = 1.3;
constexpr double kSideways = 0.35;  // a mm that the curve goes away from its chord,
constexpr double kBent = 30;        // and the square of that by the chord's length
constexpr double kAlong = 0.3;      // a mm from the middle of the chord
constexpr double kWrongSide = 5;    // so that the two directions keep to two sides

/// Between a box and its own states: the arrow head, and some of the line.
constexpr double kOwnGap = kArrowLength + 1.6;
/// From a box to a curve that passes by.
constexpr double kCurveGap = 0.7;

constexpr std::size_t kSegments = 10;
constexpr std::size_t kMostPlaces = 200;
constexpr std::array<double, 9> kParts = {0.5, 0.44, 0.56, 0.38, 0.62, 0.32, 0.68, 0.26, 0.74};

/// A place of an edge's box, and what follows from it.
struct Place {
  PageBox box;
  std::array<PagePoint, kSegments + 1> line;  ///< the curve as a polyline
  PageBox around;                             ///< the curve
  double alone = 0;                           ///< the cost, without other edges
  bool apart = true;
  bool clear = true;
};

PageBox box_around(const std::array<PagePoint, kSegments + 1>& line) {
  PagePoint low = line[0];
  PagePoint high = line[0];
  for (const PagePoint& point : line) {
    low = {std::min(low.x, point.x), std::min(low.y, point.y)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y)};
  }
  return {0.5 * (low + high), (high.x - low.x) / 2, (high.y - low.y) / 2};
}

double length_under(const Place& curve, const Place& other) {
  PageBox box = other.box;
  box.half_width += kCurveGap;
  box.half_height += kCurveGap;
  if (overlap_of(curve.around, box, 0) <= 0) return 0;
  double length = 0;
  for (std::size_t i = 0; i < kSegments; ++i)
    length += length_within(curve.line[i], curve.line[i + 1], box);
  return length;
}

int crossings(const Place& a, const Place& b) {
  if (overlap_of(a.around, b.around, 0) <= 0) return 0;
  int count = 0;
  for (std::size_t i = 0; i < kSegments; ++i) {
    for (std::size_t j = 0; j < kSegments; ++j)
      count += segments_cross(a.line[i], a.line[i + 1], b.line[j], b.line[j + 1]) ? 1 : 0;
  }
  return count;
}

/// Whether a point is nearer to a segment than `kLineDistance`.
bool lies_beside(PagePoint point, PagePoint from, PagePoint to) {
  // Most are far away, which takes no division to see.
  if (point.x < std::min(from.x, to.x) - kLineDistance) return false;
  if (point.x > std::max(from.x, to.x) + kLineDistance) return false;
  if (point.y < std::min(from.y, to.y) - kLineDistance) return false;
  if (point.y > std::max(from.y, to.y) + kLineDistance) return false;
  return distance_to_segment(point, from, to) < kLineDistance;
}

/// How many points of a curve lie beside another one.
int points_alongside(const Place& a, const Place& b) {
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

double under_cost(double length) {
  return length > 0 ? kUnderBox + kUnderBoxLength * length : 0;
}

/// Adds what the box and the curve do to the states.
void meet_states(const PlacingTask& task, const PlacingTask::Edge& edge, Place& place) {
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

Place make_place(const PlacingTask& task, const PlacingTask::Edge& edge, PagePoint at) {
  Place place{.box = {at, edge.width / 2, edge.height / 2}, .line = {}, .around = {}};
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

/// The places of one edge, the best ones first.
std::vector<Place> places_of(const PlacingTask& task, const PlacingTask::Edge& edge) {
  const PagePoint source = task.states[edge.source];
  const PagePoint chord = task.states[edge.target] - source;
  const double length = std::max(1e-9, length_of(chord));
  const PagePoint normal{-chord.y / length, chord.x / length};
  // Boxes that are stacked are half a box apart, or a fourth of a wide one.
  const bool stacked = std::fabs(normal.y) > 0.6;
  const double step = stacked ? (edge.height + kBoxGap) / 2 : (edge.width + kBoxGap) / 5;
  const auto rows = static_cast<int>(task.edges.size()) + 4;
  std::vector<Place> places;
  for (const double part : kParts) {
    for (int row = -rows; row <= rows; ++row) {
      const PagePoint at = source + part * chord + row * step * normal;
      Place place = make_place(task, edge, at);
      const double away = std::abs(row) * step / (4 * part * (1 - part));
      place.alone += kSideways * away + kBent * (away / length) * (away / length) +
                     kAlong * std::fabs(part - 0.5) * length + (row < 0 ? kWrongSide : 0);
      places.push_back(place);
    }
  }
  std::ranges::stable_sort(places, {}, &Place::alone);
  if (places.size() > kMostPlaces) places.resize(kMostPlaces);
  return places;
}

class Placer {
 public:
  explicit Placer(const PlacingTask& task) : task_(task) {
    for (const PlacingTask::Edge& edge : task.edges)
      places_.push_back(places_of(task, edge));
  }

  /// Edges in this order, then sweeps.
  Placing place(const std::vector<std::size_t>& order) {
    chosen_.assign(places_.size(), kNone);
    for (const std::size_t edge : order)
      improve(edge);
    sweep(order);
    return result();
  }

  /// Takes some boxes that are near to each other out and puts them in again in another order, and
  /// keeps what gets better: the way out of places that are best only as long as nobody else moves.
  Placing refine(const std::vector<PagePoint>& boxes) {
    start_from(boxes);
    Placing best = result();
    for (int round = 0; round < kRefinements; ++round) {
      const double before = best.cost;
      for (std::size_t edge = 0; edge < places_.size(); ++edge) {
        for (std::size_t group = 2; group <= 4; ++group)
          reorder(neighbourhood(edge, group), best);
      }
      if (best.cost >= before - 1e-9) break;
    }
    return best;
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  void start_from(const std::vector<PagePoint>& boxes) {
    chosen_.assign(places_.size(), kNone);
    for (std::size_t edge = 0; edge < places_.size(); ++edge) {
      const auto found = std::ranges::find_if(
          places_[edge], [&](const Place& place) { return place.box.centre == boxes[edge]; });
      chosen_[edge] = static_cast<std::size_t>(found - places_[edge].begin());
    }
  }

  /// The edge and those whose boxes are nearest to its box, the nearest first.
  std::vector<std::size_t> neighbourhood(std::size_t edge, std::size_t count) const {
    std::vector<std::size_t> edges(places_.size());
    std::iota(edges.begin(), edges.end(), 0U);
    const PagePoint here = place_of(edge).box.centre;
    std::ranges::stable_sort(
        edges, {}, [&](std::size_t other) { return length_of(place_of(other).box.centre - here); });
    edges.resize(std::min(count, edges.size()));
    return edges;
  }

  void reorder(std::vector<std::size_t> edges, Placing& best) {
    const std::vector<std::size_t> before = chosen_;
    std::ranges::reverse(edges);
    for (const std::size_t edge : edges)
      chosen_[edge] = kNone;
    for (const std::size_t edge : edges)
      improve(edge);
    sweep(edges);
    Placing now = result();
    if (now.cost < best.cost - 1e-9) {
      best = std::move(now);
    } else {
      chosen_ = before;
    }
  }

  void sweep(const std::vector<std::size_t>& order) {
    for (int i = 0; i < kPlacingSweeps; ++i) {
      bool better = false;
      for (const std::size_t edge : order)
        better = improve(edge) || better;
      if (!better) break;
    }
  }

  const Place& place_of(std::size_t edge) const { return places_[edge][chosen_[edge]]; }

  bool share_a_state(std::size_t a, std::size_t b) const {
    const PlacingTask::Edge& first = task_.edges[a];
    const PlacingTask::Edge& second = task_.edges[b];
    return first.source == second.source || first.source == second.target ||
           first.target == second.source || first.target == second.target;
  }

  /// Two ends of curves that come too near to each other at a state that they share.
  double crowding(std::size_t a, const Place& at, std::size_t b, const Place& other) const {
    const auto ends = [](const PlacingTask::Edge& edge, const Place& place) {
      return std::array{std::pair(edge.source, place.line.front()),
                        std::pair(edge.target, place.line.back())};
    };
    double cost = 0;
    for (const auto& [state, end] : ends(task_.edges[a], at)) {
      for (const auto& [same, end2] : ends(task_.edges[b], other)) {
        if (state != same) continue;
        cost += kCrowded * std::max(0.0, kEndDistance - length_of(end - end2));
      }
    }
    return cost;
  }

  /// What the place costs beside the others, as far as they have one; gives up beyond `most`.
  double cost_of(std::size_t edge, const Place& place, double most) const {
    double cost = place.alone;
    // What is quickly known and costs most comes first.
    for (std::size_t other = 0; other < places_.size(); ++other) {
      if (other == edge || chosen_[other] == kNone) continue;
      const double overlap = overlap_of(place.box, place_of(other).box, kBoxGap - 1e-6);
      if (overlap > 0) cost += kOverlap + 100 * overlap;
    }
    for (std::size_t other = 0; other < places_.size() && cost < most; ++other) {
      if (other == edge || chosen_[other] == kNone) continue;
      const Place& there = place_of(other);
      cost += under_cost(length_under(place, there)) + under_cost(length_under(there, place));
      if (cost >= most) break;
      cost += kCrossing * crossings(place, there);
      if (cost >= most) break;
      cost += crowding(edge, place, other, there);
      if (cost >= most || !share_a_state(edge, other)) continue;
      cost += kAlongside * (points_alongside(place, there) + points_alongside(there, place)) / 2;
    }
    return cost;
  }

  /// Moves the edge's box to its best place; whether that is another one.
  bool improve(std::size_t edge) {
    double best = std::numeric_limits<double>::infinity();
    std::size_t found = chosen_[edge];
    if (found != kNone) best = cost_of(edge, places_[edge][found], best);
    const std::size_t before = found;
    for (std::size_t i = 0; i < places_[edge].size(); ++i) {
      if (places_[edge][i].alone >= best) break;  // they are sorted
      const double cost = cost_of(edge, places_[edge][i], best - 1e-9);
      if (cost >= best - 1e-9) continue;
      best = cost;
      found = i;
    }
    chosen_[edge] = found;
    return found != before;
  }

  Placing result() const {
    Placing placing{.apart = true, .clear = true};
    for (std::size_t a = 0; a < places_.size(); ++a) {
      const Place& place = place_of(a);
      placing.boxes.push_back(place.box.centre);
      placing.apart = placing.apart && place.apart;
      placing.clear = placing.clear && place.clear;
      // Each pair is met twice.
      placing.cost +=
          (place.alone + cost_of(a, place, std::numeric_limits<double>::infinity())) / 2;
      for (std::size_t b = 0; b < places_.size(); ++b) {
        if (a == b) continue;
        if (overlap_of(place.box, place_of(b).box, kBoxGap - 1e-6) > 0) placing.apart = false;
        if (length_under(place, place_of(b)) > 0) placing.clear = false;
      }
    }
    return placing;
  }

  const PlacingTask& task_;
  std::vector<std::vector<Place>> places_;
  std::vector<std::size_t> chosen_;
};

}  // namespace

EdgeCurve edge_curve(const PlacingTask& task, const PlacingTask::Edge& edge, PagePoint box) {
  return curve_through({task.states[edge.source], task.radius},
                       {task.states[edge.target], task.radius + kArrowLength}, box);
}

Placing place_conditions(const PlacingTask& task) {
  Placer placer(task);
  std::vector<std::size_t> order(task.edges.size());
  std::iota(order.begin(), order.end(), 0U);
  Placing best = placer.place(order);
  for (int turn = 1; turn < kPlacingOrders; ++turn) {
    // Turned round, then by halves: the first ones get the straight ways.
    if (turn % 2 == 1) {
      std::ranges::reverse(order);
    } else {
      std::ranges::rotate(order, order.begin() + static_cast<std::ptrdiff_t>(order.size() / 3));
    }
    Placing other = placer.place(order);
    if (other.cost < best.cost) best = std::move(other);
  }
  return best;
}

Placing refine_conditions(const PlacingTask& task, const Placing& placing) {
  return Placer(task).refine(placing.boxes);
}

}  // namespace swarmsmith
