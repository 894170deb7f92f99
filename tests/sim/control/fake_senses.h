#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "sim/control/reference_model.h"

namespace swarmsmith {

inline constexpr double kNothing = std::numeric_limits<double>::infinity();

/// A neighbour at a distance in metres and a bearing in degrees, counter-clockwise.
inline Neighbour neighbour_at(double distance_m, double bearing_deg) {
  const double bearing = bearing_deg * 3.14159265358979323846 / 180;
  return {distance_m, std::cos(bearing), std::sin(bearing)};
}

/// Readings as a test sets them, and how often each sensor was asked. At first there are no
/// obstacles, no neighbours and no light, and the floor is the arena's grey.
class FakeSenses final : public Senses {
 public:
  ProximityReadings proximity() override {
    ++proximity_asked;
    return distances;
  }
  const Rgb& ground_color() override {
    ++ground_asked;
    return floor;
  }
  std::span<const Neighbour> neighbours() override {
    ++neighbours_asked;
    return others;
  }
  LightReadings light() override {
    ++light_asked;
    return lux;
  }
  double time_s() override {
    ++time_asked;
    return now_s;
  }

  /// One obstacle in the direction, one of 45, 0, -45, -90, -135, 180, 135, 90 degrees.
  FakeSenses& obstacle(int direction_deg, double distance_m) {
    for (std::size_t i = 0; i < distances.size(); ++i) {
      if (kProximityDirections_deg[i] == direction_deg) distances[i] = distance_m;
    }
    return *this;
  }
  /// What the light sensor in the direction reads, one of the same.
  FakeSenses& light_from(int direction_deg, double reading_lux) {
    for (std::size_t i = 0; i < lux.size(); ++i) {
      if (kProximityDirections_deg[i] == direction_deg) lux[i] = reading_lux;
    }
    return *this;
  }
  FakeSenses& neighbour(double distance_m, double bearing_deg) {
    others.push_back(neighbour_at(distance_m, bearing_deg));
    return *this;
  }

  std::array<double, kProximitySensors> distances{kNothing, kNothing, kNothing, kNothing,
                                                  kNothing, kNothing, kNothing, kNothing};
  Rgb floor{127, 127, 127};
  std::vector<Neighbour> others;
  std::array<double, kProximitySensors> lux{};
  double now_s = 0;
  int proximity_asked = 0;
  int ground_asked = 0;
  int neighbours_asked = 0;
  int light_asked = 0;
  int time_asked = 0;

  int asked() const {
    return proximity_asked + ground_asked + neighbours_asked + light_asked + time_asked;
  }
};

}  // namespace swarmsmith
