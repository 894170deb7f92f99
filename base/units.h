#pragma once

#include <compare>

namespace swarmsmith {

/// A number with a unit, for public borders; numeric kernels take `.value` into a double whose name
/// ends in the unit (`range_m`). All are SI.
template <class Unit>
struct Quantity {
  double value = 0;

  friend constexpr auto operator<=>(Quantity, Quantity) = default;
  friend constexpr Quantity operator+(Quantity a, Quantity b) { return {a.value + b.value}; }
  friend constexpr Quantity operator-(Quantity a, Quantity b) { return {a.value - b.value}; }
  friend constexpr Quantity operator*(double k, Quantity a) { return {k * a.value}; }
};

using Metres = Quantity<struct MetreUnit>;
using Radians = Quantity<struct RadianUnit>;
using Seconds = Quantity<struct SecondUnit>;
using MetresPerSecond = Quantity<struct MetrePerSecondUnit>;

constexpr Radians degrees(double angle_deg) {
  return {angle_deg * 0.017453292519943295};
}
constexpr Metres centimetres(double length_cm) {
  return {length_cm / 100.0};
}

namespace literals {
constexpr Metres operator""_m(long double v) {
  return {static_cast<double>(v)};
}
constexpr Radians operator""_rad(long double v) {
  return {static_cast<double>(v)};
}
constexpr Seconds operator""_s(long double v) {
  return {static_cast<double>(v)};
}
constexpr MetresPerSecond operator""_mps(long double v) {
  return {static_cast<double>(v)};
}
}  // namespace literals

}  // namespace swarmsmith
