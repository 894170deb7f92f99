#include "tracking/scoring/internal/color_match.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/assert.h"

namespace swarmsmith {
namespace {

using Channels = std::array<double, 3>;

/// Length of the channels' differences from their mean (with the floor at 1) from which a colour
/// certainly has a hue.
constexpr double kHue = 0.35;

/// A colour as a point: its hue on the unit circle in the plane r + g + b = 0 (nearer to the origin
/// below `kHue`), and its lightness relative to the floor, which counts less the stronger the hue
/// is.
struct Place {
  Channels hue{};
  double lightness = 0;
};

Place place_of(const Channels& ratio) {
  const double mean = (ratio[0] + ratio[1] + ratio[2]) / 3;
  double squares = 0;
  for (const double value : ratio)
    squares += (value - mean) * (value - mean);
  const double length = std::sqrt(squares);
  Place place;
  for (std::size_t i = 0; i < ratio.size(); ++i)
    place.hue.at(i) = (ratio.at(i) - mean) / std::max(length, kHue);
  const double colored = std::min(1.0, length / kHue);
  place.lightness = std::clamp(mean - 1, -1.0, 1.0) * (1 - colored * colored);
  return place;
}

double distance(const Place& a, const Place& b) {
  double squares = (a.lightness - b.lightness) * (a.lightness - b.lightness);
  for (std::size_t i = 0; i < a.hue.size(); ++i)
    squares += (a.hue.at(i) - b.hue.at(i)) * (a.hue.at(i) - b.hue.at(i));
  return std::sqrt(squares);
}

Channels over_floor(Rgb color, Rgb floor) {
  return {static_cast<double>(color.r) / floor.r, static_cast<double>(color.g) / floor.g,
          static_cast<double>(color.b) / floor.b};
}

}  // namespace

ColorMatch nearest_color(const std::array<double, 3>& ratio, std::span<const Rgb> colors,
                         Rgb floor) {
  SWARMSMITH_ASSERT(colors.size() >= 2, "one colour alone is always the nearest");
  const Place seen = place_of(ratio);
  std::vector<std::pair<double, Rgb>> found;
  for (const Rgb color : colors)
    found.emplace_back(distance(seen, place_of(over_floor(color, floor))), color);
  std::ranges::stable_sort(found, {}, &std::pair<double, Rgb>::first);
  const double next = found[1].first;
  return {found[0].second, found[1].second, found[0].first,
          next > 0 ? 1 - found[0].first / next : 0};
}

}  // namespace swarmsmith
