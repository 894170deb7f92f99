#include "sim/control/reference_model.h"

#include <tuple>

namespace swarmsmith {
namespace {

constexpr double kTurn_rad = 6.283185307179586;
constexpr double kMostChannel = 255;
constexpr int kWheels = 2;
constexpr int kLeds = static_cast<int>(std::tuple_size_v<Leds>);

constexpr std::array<ReferenceEntry, 12> kTable = {{
    {.device = "proximity", .variable = "prox", .unit = "", .most = 1, .count = kProximitySensors},
    {.device = "proximity",
     .variable = "angle",
     .unit = "rad",
     .most = kTurn_rad,
     .below_most = true,
     .count = kProximitySensors},
    {.device = "light",
     .variable = "light",
     .unit = "lux",
     .most = kMostLight_lux,
     .count = kProximitySensors},
    {.device = "ground colour", .variable = "R", .unit = "", .most = kMostChannel, .count = 1},
    {.device = "ground colour", .variable = "G", .unit = "", .most = kMostChannel, .count = 1},
    {.device = "ground colour", .variable = "B", .unit = "", .most = kMostChannel, .count = 1},
    {.device = "neighbours",
     .variable = "d",
     .unit = "m",
     .most = kNeighbourRange_m,
     .below_most = true},
    {.device = "neighbours",
     .variable = "angle",
     .unit = "rad",
     .most = kTurn_rad,
     .below_most = true},
    {.device = "wheels",
     .variable = "v",
     .unit = "m/s",
     .least = -kMaxWheelSpeed_mps,
     .most = kMaxWheelSpeed_mps,
     .count = kWheels},
    {.device = "LEDs", .variable = "R", .unit = "", .most = kMostChannel, .count = kLeds},
    {.device = "LEDs", .variable = "G", .unit = "", .most = kMostChannel, .count = kLeds},
    {.device = "LEDs", .variable = "B", .unit = "", .most = kMostChannel, .count = kLeds},
}};

}  // namespace

std::span<const ReferenceEntry> reference_model() {
  return kTable;
}

}  // namespace swarmsmith
