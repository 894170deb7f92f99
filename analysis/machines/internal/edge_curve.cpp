#include "analysis/machines/internal/edge_curve.h"

#include <algorithm>
#include <cmath>

namespace swarmsmith {
namespace {

constexpr int kCurveSteps = 4;

/// Where within a parabola its given point may be; nearer to an end it would rear up.
constexpr double kFirstPart = 0.2;

double cross(PagePoint a, PagePoint b) {
  return a.x * b.y - a.y * b.x;
}

/// `length` long; to the right when there is no direction.
PagePoint directed(PagePoint direction, double length) {
  const double norm = length_of(direction);
  if (norm == 0) return {length, 0};
  return (length / norm) * direction;
}

}  // namespace

PagePoint operator+(PagePoint a, PagePoint b) {
  return {a.x + b.x, a.y + b.y};
}

PagePoint operator-(PagePoint a, PagePoint b) {
  return {a.x - b.x, a.y - b.y};
}

PagePoint operator*(double factor, PagePoint a) {
  return {factor * a.x, factor * a.y};
}

double dot(PagePoint a, PagePoint b) {
  return a.x * b.x + a.y * b.y;
}

double length_of(PagePoint a) {
  return std::sqrt(dot(a, a));
}

double overlap_of(const PageBox& a, const PageBox& b, double gap) {
  const double x = a.half_width + b.half_width + gap - std::fabs(a.centre.x - b.centre.x);
  const double y = a.half_height + b.half_height + gap - std::fabs(a.centre.y - b.centre.y);
  return std::max(0.0, std::min(x, y));
}

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
  // Where a curve ends on the circles depends on its control point, and the other way round; a few
  // steps bring both within a hundredth of a millimetre.
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
  // Liang and Barsky: the part of the segment between its first and its last border.
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

double distance_to_segment(PagePoint point, PagePoint from, PagePoint to) {
  const PagePoint step = to - from;
  const double length2 = dot(step, step);
  double part = 0;
  if (length2 > 0) part = std::clamp(dot(point - from, step) / length2, 0.0, 1.0);
  return length_of(point - (from + part * step));
}

bool segments_cross(PagePoint a, PagePoint b, PagePoint c, PagePoint d) {
  const double side_c = cross(b - a, c - a);
  const double side_d = cross(b - a, d - a);
  const double side_a = cross(d - c, a - c);
  const double side_b = cross(d - c, b - c);
  return side_c * side_d < 0 && side_a * side_b < 0;
}

}  // namespace swarmsmith
