#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "sim/control/reference_model.h"

namespace swarmsmith {

struct ObstacleModel;
struct FloorModel;
struct LightModel;
enum class ColorLabel;

/// How modules convert raw readings: obstacles and light to vectors, floor colours to grey levels
/// and labels.

/// A vector in the robot's frame.
struct Vector2 {
  double x = 0;
  double y = 0;

  friend bool operator==(const Vector2&, const Vector2&) = default;
};

inline constexpr double kSqrtHalf = 0.7071067811865476;

/// Unit vectors of `kProximityDirections_deg`, by index.
inline constexpr std::array<Vector2, kProximitySensors> kProximityDirections = {
    {{kSqrtHalf, kSqrtHalf},
     {1, 0},
     {kSqrtHalf, -kSqrtHalf},
     {0, -1},
     {-kSqrtHalf, -kSqrtHalf},
     {-1, 0},
     {-kSqrtHalf, kSqrtHalf},
     {0, 1}}};

/// Calls `act` with the index of each reading of a ring, at least eight times. The first loop is
/// fast, because its length is fixed.
template <class Act>
void for_each_reading(std::size_t count, const Act& act) {
  for (std::size_t i = 0; i < kProximitySensors; ++i)
    act(i);
  for (std::size_t i = kProximitySensors; i < count; ++i)
    act(i);
}

/// Unit vectors towards the sensors of a ring, one per reading: zero where a robot has no sensor.
using RingDirections = std::vector<Vector2>;

/// Strength of the reading of one proximity sensor: prox of the reference model, in [0, 1], or the
/// inverse distance of the published program in 1/m. 0 when there is no obstacle.
double obstacle_strength(double distance_m, const ObstacleModel& model);

/// Whether no sensor measures an obstacle up to this distance; then all strengths are 0 for a model
/// whose `far_m` is this distance.
template <std::size_t N>
bool nothing_within(std::span<const double, N> proximity, double far_m) {
  bool any = false;
  for (const double distance : proximity)
    any |= distance <= far_m;
  return !any;
}

/// Strength of a neighbour as an obstacle, in [0, 1] (thesis facts, section 6.2).
double neighbour_strength(double distance_m, const ObstacleModel& model);

/// Vector of all obstacles: w_o of the thesis, P of the published program (rvr-automode facts,
/// section 4.1). Pass no neighbours when the model does not treat them as obstacles.
Vector2 obstacle_vector(ProximityReadings proximity, std::span<const Neighbour> neighbours,
                        const ObstacleModel& model);
/// The same vector before it is shortened to the model's longest length: for callers that need only
/// its direction, or whether it is longer than a threshold below that length.
Vector2 obstacle_sum(ProximityReadings proximity, std::span<const Neighbour> neighbours,
                     const ObstacleModel& model);

/// Vector of the light: w_l of the thesis (eq. 5.1), each reading as light_i in [0, 1].
Vector2 light_vector(LightReadings lux, const LightModel& model);

/// Colours are passed by reference: the three bytes of a colour were often just written one by one,
/// and code that reads two of them at once then stalls.

/// Grey level in thousandths of 0..255: 0.299 R + 0.587 G + 0.114 B without rounding.
constexpr int gray_level(const Rgb& color) {
  return 299 * color.r + 587 * color.g + 114 * color.b;
}

struct HueSaturation {
  double hue_deg = 0;     ///< in [0, 360)
  double saturation = 0;  ///< in [0, 1]
};

/// Nothing when the three channels are equal: greys have no hue.
std::optional<HueSaturation> hue_and_saturation(const Rgb& color);

/// The label with the nearest hue, if it is near enough.
std::optional<ColorLabel> perceived_label(const Rgb& color, const FloorModel& model);

}  // namespace swarmsmith
