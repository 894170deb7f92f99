#include "sim/control/readings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/assert.h"
#include "base/math.h"
#include "sim/control/flavour.h"

namespace swarmsmith {
namespace {

/// 1 up to `near`, 0 from `far` on, linear between.
double ramp(double value, double near, double far) {
  const double between = (far - value) / (far - near);  // without a branch, so that loops are fast
  const double from_near = value <= near ? 1 : between;
  return value >= far ? 0 : from_near;
}

double inverse_within(double value, double near, double far) {
  const double inverse = 1.0 / value;
  const bool within = static_cast<int>(near <= value) & static_cast<int>(value <= far);
  return within ? inverse : 0.0;
}

/// The sum of kProximityDirections, each times its strength, in the order of the sensors. Sensors
/// without an obstacle add 0: this is cheaper than eight unpredictable branches.
Vector2 sum_along_sensors(const std::array<double, kProximitySensors>& strengths) {
  const auto& s = strengths;
  const double left_ahead = kSqrtHalf * s[0];
  const double right_ahead = kSqrtHalf * s[2];
  const double right_back = kSqrtHalf * s[4];
  const double left_back = kSqrtHalf * s[6];
  return {left_ahead + s[1] + right_ahead - right_back - s[5] - left_back,
          left_ahead - right_ahead - s[3] - right_back + left_back + s[7]};
}

/// The sum of the directions of a robot's sensors (none: the RVR's ring), each times its strength.
Vector2 sum_along(const std::optional<RingDirections>& of_robot,
                  std::span<const double> strengths) {
  std::span<const Vector2> directions = kProximityDirections;
  if (of_robot) directions = *of_robot;
  SWARMSMITH_ASSERT(directions.size() == strengths.size(), "the flavour is fitted to the robot");
  Vector2 sum;
  for_each_reading(strengths.size(), [&](std::size_t i) {
    sum.x += strengths[i] * directions[i].x;
    sum.y += strengths[i] * directions[i].y;
  });
  return sum;
}

/// The light vector of a model with its own law or directions.
Vector2 light_by_law(LightReadings readings, const LightModel& model) {
  std::array<double, kMostRingSensors> strengths;
  double strongest = 0;
  for_each_reading(readings.size(), [&](std::size_t i) {
    strengths[i] = std::min(1.0, readings[i] / model.full_lux);
    strongest = std::max(strongest, strengths[i]);
  });
  if (model.least_reading > 0 && strongest <= model.least_reading) return {};
  const Vector2 sum = sum_along(model.directions, std::span(strengths).first(readings.size()));
  if (!model.unit_vector) return sum;
  // If the readings add up to zero, the light counts as straight ahead (epuck facts, 3.2).
  const double length = std::sqrt(sum.x * sum.x + sum.y * sum.y);
  return length > 0 ? Vector2{sum.x / length, sum.y / length} : Vector2{1, 0};
}

}  // namespace

double obstacle_strength(double distance_m, const ObstacleModel& model) {
  if (model.reading == ObstacleModel::Reading::AsSensed) return distance_m;
  if (model.reading == ObstacleModel::Reading::Linear) {
    return ramp(distance_m, model.near_m, model.far_m);
  }
  return inverse_within(distance_m, model.near_m, model.far_m);
}

namespace {

/// Strengths of readings that are distances. Inlined into the sum, which steering requests in each
/// cycle: a call would add a tenth to its time.
[[gnu::always_inline]] inline std::array<double, kProximitySensors> strengths_of_distances(
    std::span<const double, kProximitySensors> proximity, const ObstacleModel& model) {
  std::array<double, kProximitySensors> strengths;
  const double near = model.near_m;
  const double far = model.far_m;
  if (model.reading == ObstacleModel::Reading::Linear) {
    for (std::size_t i = 0; i < strengths.size(); ++i)
      strengths[i] = ramp(proximity[i], near, far);
  } else {
    for (std::size_t i = 0; i < strengths.size(); ++i)
      strengths[i] = inverse_within(proximity[i], near, far);
  }
  return strengths;
}

/// For a robot whose ring has its own directions, or gives strengths instead of distances.
Vector2 sum_of_ring(ProximityReadings proximity, const ObstacleModel& model) {
  if (model.reading == ObstacleModel::Reading::AsSensed)
    return sum_along(model.directions, proximity);
  std::array<double, kMostRingSensors> strengths;
  for_each_reading(proximity.size(),
                   [&](std::size_t i) { strengths[i] = obstacle_strength(proximity[i], model); });
  return sum_along(model.directions, std::span(strengths).first(proximity.size()));
}

}  // namespace

double neighbour_strength(double distance_m, const ObstacleModel& model) {
  return ramp(distance_m, model.neighbour_near_m, model.neighbour_far_m);
}

Vector2 obstacle_sum(ProximityReadings proximity, std::span<const Neighbour> neighbours,
                     const ObstacleModel& model) {
  Vector2 sum;
  if (model.directions || model.reading == ObstacleModel::Reading::AsSensed) {
    sum = sum_of_ring(proximity, model);
  } else {
    const auto of_rvr = proximity.first<kProximitySensors>();
    if (neighbours.empty() && nothing_within(of_rvr, model.far_m)) return sum;
    sum = sum_along_sensors(strengths_of_distances(of_rvr, model));
  }
  for (const Neighbour& neighbour : neighbours) {
    const double strength = neighbour_strength(neighbour.distance_m, model);
    sum.x += strength * neighbour.direction_x;
    sum.y += strength * neighbour.direction_y;
  }
  return sum;
}

Vector2 obstacle_vector(ProximityReadings proximity, std::span<const Neighbour> neighbours,
                        const ObstacleModel& model) {
  Vector2 sum = obstacle_sum(proximity, neighbours, model);
  const double square = sum.x * sum.x + sum.y * sum.y;
  if (square > model.longest_sum * model.longest_sum) {
    const double factor = model.longest_sum / std::sqrt(square);
    sum.x *= factor;
    sum.y *= factor;
  }
  return sum;
}

Vector2 light_vector(LightReadings lux, const LightModel& model) {
  if (model.unit_vector || model.least_reading > 0 || model.directions)
    return light_by_law(lux, model);
  Vector2 sum;
  for (std::size_t i = 0; i < kProximitySensors; ++i) {
    const double strength = std::min(1.0, lux[i] / model.full_lux);
    sum.x += strength * kProximityDirections[i].x;
    sum.y += strength * kProximityDirections[i].y;
  }
  return sum;
}

std::optional<HueSaturation> hue_and_saturation(const Rgb& color) {
  const int r = color.r;
  const int g = color.g;
  const int b = color.b;
  const int largest = std::max({r, g, b});
  const int spread = largest - std::min({r, g, b});
  if (spread == 0) return std::nullopt;
  // The hue in sixths of a turn from red.
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

std::optional<ColorLabel> perceived_label(const Rgb& color, const FloorModel& model) {
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
