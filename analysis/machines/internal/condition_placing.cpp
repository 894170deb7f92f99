#include "analysis/machines/internal/condition_placing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace swarmsmith {
namespace {

// Costs; the unit is 1 mm of distance from the middle of an edge.
constexpr double kUnderBox = 60;       // for a curve that passes under a box,
constexpr double kUnderBoxLength = 8;  // and in addition per mm under the box
constexpr double kCrossing = 7;
constexpr double kCrowded =
    12;  // penalty for each mm that two curve ends are too close (kEndDistance)
constexpr double kEndDistance = 2.4;
constexpr double kAlongside = 8;  // per tenth of a curve that runs beside another one

double under_cost(double length) {
  return length > 0 ? kUnderBox + kUnderBoxLength * length : 0;
}

class Placer {
 public:
  explicit Placer(const PlacingTask& task) : task_(task) {
    for (const PlacingTask::Edge& edge : task.edges)
      places_.push_back(places_of(task, edge));
  }

  /// Places the edges in this order, then improves them in sweeps.
  Placing place(const std::vector<std::size_t>& order) {
    chosen_.assign(places_.size(), kNone);
    for (const std::size_t edge : order)
      improve(edge);
    sweep(order);
    return result();
  }

  /// Removes some boxes that are close to each other, inserts them again in another order, and
  /// keeps improvements. This escapes local optima in which no single box can be improved.
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
          places_[edge], [&](const EdgePlace& place) { return place.box.centre == boxes[edge]; });
      chosen_[edge] = static_cast<std::size_t>(found - places_[edge].begin());
    }
  }

  /// The edge, and the edges whose boxes are nearest to its box, nearest first.
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

  const EdgePlace& place_of(std::size_t edge) const { return places_[edge][chosen_[edge]]; }

  bool share_a_state(std::size_t a, std::size_t b) const {
    const PlacingTask::Edge& first = task_.edges[a];
    const PlacingTask::Edge& second = task_.edges[b];
    return first.source == second.source || first.source == second.target ||
           first.target == second.source || first.target == second.target;
  }

  /// The cost of two ends of curves that are too close to each other at a common state.
  double crowding(std::size_t a, const EdgePlace& at, std::size_t b, const EdgePlace& other) const {
    const auto ends = [](const PlacingTask::Edge& edge, const EdgePlace& place) {
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

  /// The cost of the place together with the edges that have been placed; stops when it exceeds
  /// `most`.
  double cost_of(std::size_t edge, const EdgePlace& place, double most) const {
    double cost = place.alone;
    // The most expensive conflicts, which are quick to compute, come first.
    for (std::size_t other = 0; other < places_.size(); ++other) {
      if (other == edge || chosen_[other] == kNone) continue;
      const double overlap = overlap_of(place.box, place_of(other).box, kBoxGap - 1e-6);
      if (overlap > 0) cost += kOverlap + 100 * overlap;
    }
    for (std::size_t other = 0; other < places_.size() && cost < most; ++other) {
      if (other == edge || chosen_[other] == kNone) continue;
      const EdgePlace& there = place_of(other);
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

  /// Moves the edge's box to its best place. Returns whether the place has changed.
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
      const EdgePlace& place = place_of(a);
      placing.boxes.push_back(place.box.centre);
      placing.apart = placing.apart && place.apart;
      placing.clear = placing.clear && place.clear;
      // Each pair is counted twice.
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
  std::vector<std::vector<EdgePlace>> places_;
  std::vector<std::size_t> chosen_;
};

}  // namespace

Placing place_conditions(const PlacingTask& task) {
  Placer placer(task);
  std::vector<std::size_t> order(task.edges.size());
  std::iota(order.begin(), order.end(), 0U);
  Placing best = placer.place(order);
  for (int turn = 1; turn < kPlacingOrders; ++turn) {
    // Tries other orders by reversing and rotating the list: the first edges get the straightest
    // curves.
    if (turn % 2 == 1) {
      std::ranges::reverse(order);
    } else {
      std::rotate(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(order.size() / 3),
                  order.end());
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
