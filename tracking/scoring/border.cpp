#include "tracking/scoring/border.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "base/math.h"
#include "base/overloaded.h"
#include "sim/files/color_text.h"
#include "sim/mission/polygon.h"

namespace swarmsmith {
namespace {

constexpr int kDirections = 1000;

/// Finds the parameter that says when the score is computed. A formula may use more than the floor,
/// so it has no borders.
struct EndFinder {
  bool found = false;
  bool has_formula = false;

  void operator()(const ScoreField& field, const std::string& /*value*/) {
    has_formula = has_formula || field.choices.empty();
  }

  void operator()(const ScoreField& /*field*/, When when) { found = found || when == When::End; }
  template <class Value>
  void operator()(const ScoreField& /*field*/, const Value& /*value*/) {}
};

/// The score of a single robot at a point.
double share_at(const ScoreRule& rule, const Arena& arena, Point point) {
  Scorer scorer(rule, arena);
  scorer.observe(std::span(&point, 1));
  return scorer.score();
}

/// A place where a ray crosses the border of a patch.
struct Crossing {
  double distance_m = 0;
  const Patch* patch = nullptr;
};

class LineOfSight {
 public:
  LineOfSight(Point origin, Point direction) : origin_(origin), direction_(direction) {}

  Point at(double distance_m) const {
    return {origin_.x + distance_m * direction_.x, origin_.y + distance_m * direction_.y};
  }

  void cross(const Patch& patch, std::vector<Crossing>& crossings) const {
    std::visit(Overloaded{[&](const Disc& disc) { cross_disc(disc, patch, crossings); },
                          [&](const Rectangle& box) { cross_grid(box, 1, 1, patch, crossings); },
                          [&](const FloorImage& image) {
                            cross_grid(image.area, image.picture->width(), image.picture->height(),
                                       patch, crossings);
                          }},
               patch.shape);
  }

 private:
  static void add(double distance_m, const Patch& patch, std::vector<Crossing>& crossings) {
    if (distance_m >= 0) crossings.push_back({distance_m, &patch});
  }

  void cross_disc(const Disc& disc, const Patch& patch, std::vector<Crossing>& crossings) const {
    const Point to{disc.centre.x - origin_.x, disc.centre.y - origin_.y};
    const double along = to.x * direction_.x + to.y * direction_.y;
    const double across = to.x * direction_.y - to.y * direction_.x;
    const double squares = disc.radius_m * disc.radius_m - across * across;
    if (squares < 0) return;
    const double half = std::sqrt(squares);
    add(along - half, patch, crossings);
    add(along + half, patch, crossings);
  }

  /// Adds the crossings of the ray with the lines of a grid of pixels; a rectangle is a grid of one
  /// pixel.
  void cross_grid(const Rectangle& area, int columns, int rows, const Patch& patch,
                  std::vector<Crossing>& crossings) const {
    const Point low{area.centre.x - 0.5 * area.width_m, area.centre.y - 0.5 * area.height_m};
    const auto add_within = [&](double distance_m) {
      const Point at_line = at(distance_m);
      const bool is_within = std::fabs(at_line.x - area.centre.x) <= 0.5 * area.width_m + 1e-9 &&
                             std::fabs(at_line.y - area.centre.y) <= 0.5 * area.height_m + 1e-9;
      if (is_within) add(distance_m, patch, crossings);
    };
    for (int i = 0; i <= columns && direction_.x != 0; ++i)
      add_within((low.x + area.width_m * i / columns - origin_.x) / direction_.x);
    for (int i = 0; i <= rows && direction_.y != 0; ++i)
      add_within((low.y + area.height_m * i / rows - origin_.y) / direction_.y);
  }

  Point origin_;
  Point direction_;
};

/// The directions in which the nearest point of a disc or rectangle may be, and regular steps.
std::vector<Point> directions_from(Point point, const Arena& arena) {
  std::vector<Point> directions{{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  const auto towards = [&](double x, double y) {
    const double length = hypot(x - point.x, y - point.y);
    if (length == 0) return;
    directions.push_back({(x - point.x) / length, (y - point.y) / length});
    directions.push_back({(point.x - x) / length, (point.y - y) / length});
  };
  for (const Patch& patch : arena.patches) {
    if (const auto* disc = std::get_if<Disc>(&patch.shape)) towards(disc->centre.x, disc->centre.y);
    if (const auto* box = std::get_if<Rectangle>(&patch.shape)) {
      for (const double sx : {-0.5, 0.5}) {
        for (const double sy : {-0.5, 0.5})
          towards(box->centre.x + sx * box->width_m, box->centre.y + sy * box->height_m);
      }
    }
  }
  for (int k = 0; k < kDirections; ++k) {
    const SinCos turn = sin_cos(2 * kPi * k / kDirections);
    directions.push_back({turn.cos, turn.sin});
  }
  return directions;
}

/// Finds the first place along the ray where the share changes, if it is nearer than `best`.
void look_along(const LineOfSight& ray, const ScoreRule& rule, const Arena& arena, double here,
                std::optional<NearestBorder>& best) {
  std::vector<Crossing> crossings;
  for (const Patch& patch : arena.patches)
    ray.cross(patch, crossings);
  std::ranges::stable_sort(crossings, {}, &Crossing::distance_m);
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    const double distance = crossings[i].distance_m;
    if (best && distance >= best->distance_m) return;
    const bool is_last = i + 1 == crossings.size();
    // The middle of the strip behind this crossing; strips of no width are skipped.
    const double behind = is_last ? distance + 1e-3 : crossings[i + 1].distance_m;
    if (behind - distance < 1e-9) continue;
    const double beyond = share_at(rule, arena, ray.at(0.5 * (distance + behind)));
    if (beyond == here) continue;
    best = NearestBorder{distance, patch_text(*crossings[i].patch), here, beyond};
    return;
  }
}

}  // namespace

bool is_scored_at_the_end(const ScoreRule& rule) {
  EndFinder finder;
  visit_fields(rule, finder);
  return finder.found && !finder.has_formula;
}

std::optional<NearestBorder> nearest_border(const ScoreRule& rule, const Arena& arena,
                                            Point point) {
  if (!is_scored_at_the_end(rule)) return std::nullopt;
  const double here = share_at(rule, arena, point);
  std::optional<NearestBorder> best;
  for (const Point direction : directions_from(point, arena))
    look_along(LineOfSight(point, direction), rule, arena, here, best);
  return best;
}

std::string patch_text(const Patch& patch) {
  return std::visit(
      Overloaded{
          [&](const Disc& disc) {
            return color_text(patch.color) + " spot at " + point_text(disc.centre);
          },
          [&](const Rectangle& box) {
            return color_text(patch.color) + " patch at " + point_text(box.centre);
          },
          [](const FloorImage& image) { return "picture at " + point_text(image.area.centre); }},
      patch.shape);
}

}  // namespace swarmsmith
