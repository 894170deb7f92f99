#include "sim/control/readings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/math.h"
#include "sim/control/flavour.h"

namespace swarmsmith {
namespace {

/// 1 at `near` and below, 0 at `far` and beyond, linear between.
double ramp(double value, double near, double far) {
  if (value >= far) return 0;  // the common case, without a division
  return value <= near ? 1 : (far - value) / (far - near);
}

}  // namespace

double obstacle_strength(double distance_m, const ObstacleModel& model) {
  if (model.reading == ObstacleModel::Reading::Linear) {
    return ramp(distance_m, model.near_m, model.far_m);
  }
  const bool within = model.near_m <= distance_m && distance_m <= model.far_m;
  return within ? 1.0 / distance_m : 0.0;
}

double neighbour_strength(double distance_m, const ObstacleModel& model) {
  return ramp(distance_m, model.neighbour_near_m, model.neighbour_far_m);
}

Vector2 obstacle_vector(const ProximityReadings& proximity, std::span<const Neighbour> neighbours,
                        const ObstacleModel& model) {
  Vector2 sum;
  if (neighbours.empty() && nothing_within(proximity, model.far_m)) return sum;
  for (std::size_t i = 0; i < proximity.size(); ++i) {
    const double strength = obstacle_strength(proximity[i], model);
    if (strength == 0) continue;
    sum.x += strength * kProximityDirections[i].x;
    sum.y += strength * kProximityDirections[i].y;
  }
  for (const Neighbour& neighbour : neighbours) {
    const double strength = neighbour_strength(neighbour.distance_m, model);
    sum.x += strength * neighbour.direction_x;
    sum.y += strength * neighbour.direction_y;
  }
  const double square = sum.x * sum.x + sum.y * sum.y;
  if (square > model.longest_sum * model.longest_sum) {
    const double factor = model.longest_sum / std::sqrt(square);
    sum.x *= factor;
    sum.y *= factor;
  }
  return sum;
}

Vector2 light_vector(const LightReadings& lux, const LightModel& model) {
  Vector2 sum;
  for (std::size_t i = 0; i < lux.size(); ++i) {
    const double strength = std::min(1.0, lux[i] / model.full_lux);
    sum.x += strength * kProximityDirections[i].x;
    sum.y += strength * kProximityDirections[i].y;
  }
  return sum;
}

std::optional<HueSaturation> hue_and_saturation(Rgb color) {
  const int r = color.r;
  const int g = color.g;
  const int b = color.b;
  const int largest = std::max({r, g, b});
  const int spread = largest - std::min({r, g, b});
  if (spread == 0) return std::nullopt;
  // Sixths of a turn from red.
  double sixths = 0;
  if (largest == r) {
    sixths = static_cast<double>(g - b) / spread + (g < b ? 6 : 0);
  } else if (largest == g) {
    sixths = static_cast<double>(b - r) / spread + 2;
  } else {
    sixths = static_cast<double>(r - g) / spread + 4;
  }
  return HueSaturation{60 * sixths, static_cast<double>(spread) / largest};
}

std::optional<ColorLabel> perceived_label(Rgb color, const FloorModel& model) {
  const std::optional<HueSaturation> seen = hue_and_saturation(color);
  if (!seen) return std::nullopt;
  std::optional<ColorLabel> nearest;
  double smallest = model.hue_tolerance_deg;
  for (const LabelSpec& label : model.labels) {
    double difference = std::fabs(seen->hue_deg - label.hue_deg);
    if (model.hue_wraps) difference = std::min(difference, 360 - difference);
    if (!(difference < smallest)) continue;
    if (!(std::fabs(seen->saturation - label.saturation) < model.saturation_tolerance)) continue;
    smallest = difference;
    nearest = label.label;
  }
  return nearest;
}

}  // namespace swarmsmith
