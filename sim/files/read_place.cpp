#include "sim/files/read_place.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/math.h"

namespace swarmsmith {

bool can_be_read(std::span<const Point> corners) {
  return std::ranges::all_of(corners, [](Point corner) {
    return std::max(std::fabs(corner.x), std::fabs(corner.y)) <= kCoordinate.most;
  });
}

double need(TableReader& table, std::string_view key, Limits<double> limits) {
  if (!table.has(key)) table.complain(key, table.name() + " needs `" + std::string(key) + "`");
  return table.number(key, limits).value_or(limits.most);
}

Point need_point(TableReader& table) {
  return {need(table, "x", kCoordinate), need(table, "y", kCoordinate)};
}

double read_heading(TableReader& table) {
  const auto angle_deg = table.number("angle", {-36'000, 36'000});
  // The program writes radians, because degrees would not read back to the same bits.
  const auto theta = table.number("theta", {-1000, 1000});
  if (angle_deg && theta) {
    table.complain("theta", "`angle` (degrees) and `theta` (radians) mean the same; give only one");
  }
  if (theta) return wrap_angle(*theta);
  return angle_deg ? wrap_angle(*angle_deg * (kPi / 180)) : 0;
}

}  // namespace swarmsmith
