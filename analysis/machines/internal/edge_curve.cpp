#include "analysis/machines/internal/edge_curve.h"

#include <algorithm>
#include <cmath>

namespace swarmsmith {
namespace {

constexpr int kCurveSteps = 4;

/// Limits where on a parabola its given point may be; nearer to an end, the curve would bend too
/// much.
constexpr double kFirstPart = 0.2;

/// A vector of this length in the given direction; to the right if the direction is zero.
PagePoint directed(PagePoint direction, double length) {
  const double norm = length_of(direction);
  if (norm == 0) return {length, 0};
  return (length / norm) * direction;
}

}  // namespace

double distance_to(const PageBox& box, PagePoint point) {
  const double x = std::max(0.0, std::fabs(point.x - box.centre.x) - box.half_width);
  const double y = std::max(0.0, std::fabs(point.y - box.centre.y) - box.half_height);
  return std::sqrt(x * x + y * y);
}

PagePoint point_on(const EdgeCurve& curve, double part) {
  const double rest = 1 - part;
  return rest * rest * curve[0] + 2 * rest * part * curve[1] + part * part * curve[2];
}

EdgeCurve curve_through(const PageCircle& from, const PageCircle& to, PagePoint middle) {
  EdgeCurve curve = {from.centre, middle, to.centre};
  // The ends of a curve on the circles depend on its control point, and the control point depends
  // on the ends; a few iterations bring both within a hundredth of a millimetre.
  for (int step = 0; step < kCurveSteps; ++step) {
    curve[0] = from.centre + directed(curve[1] - from.centre, from.radius);
    curve[2] = to.centre + directed(curve[1] - to.centre, to.radius);
    const PagePoint chord = curve[2] - curve[0];
    double part = 0.5;
    if (dot(chord, chord) > 0) part = dot(middle - curve[0], chord) / dot(chord, chord);
    part = std::clamp(part, kFirstPart, 1 - kFirstPart);
    const double rest = 1 - part;
    curve[1] = (1 / (2 * part * rest)) * (middle - rest * rest * curve[0] - part * part * curve[2]);
  }
  return curve;
}

double length_within(PagePoint from, PagePoint to, const PageBox& box) {
  if (std::max(from.x, to.x) <= box.centre.x - box.half_width) return 0;
  if (std::min(from.x, to.x) >= box.centre.x + box.half_width) return 0;
  if (std::max(from.y, to.y) <= box.centre.y - box.half_height) return 0;
  if (std::min(from.y, to.y) >= box.centre.y + box.half_height) return 0;
  // Liang and Barsky: the part of the segment between the last entry and the first exit.
  double first = 0;
  double last = 1;
  const PagePoint step = to - from;
  const auto clip = [&](double start, double move, double low, double high) {
    if (move == 0) return low <= start && start <= high;
    const double a = (low - start) / move;
    const double b = (high - start) / move;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
    return first < last;
  };
  if (!clip(from.x, step.x, box.centre.x - box.half_width, box.centre.x + box.half_width)) return 0;
  if (!clip(from.y, step.y, box.centre.y - box.half_height, box.centre.y + box.half_height)) {
    return 0;
  }
  return (last - first) * length_of(step);
}

}  // namespace swarmsmith
