#include "analysis/figures/internal/stairs.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <set>

namespace swarmsmith {

std::vector<StairPoint> stairs(const std::vector<StairPoint>& points) {
  std::vector<StairPoint> result;
  for (const StairPoint& point : points) {
    if (!result.empty()) result.push_back({point.x, result.back().y});
    result.push_back(point);
  }
  return result;
}

std::vector<StairPoint> median_of(const std::vector<std::vector<StairPoint>>& lines) {
  double begin = 0;
  double end = std::numeric_limits<double>::max();
  std::set<double> places;
  std::size_t count = 0;
  for (const auto& line : lines) {
    if (line.empty()) continue;
    ++count;
    begin = std::max(begin, line.front().x);
    end = std::min(end, line.back().x);
    for (const StairPoint& point : line)
      places.insert(point.x);
  }
  std::vector<StairPoint> result;
  if (count == 0) return result;
  for (const double x : places) {
    // Elsewhere some lines have no value, and the median would jump because of that.
    if (x < begin || x > end) continue;
    std::vector<double> values;
    for (const auto& line : lines) {
      if (line.empty()) continue;
      const auto next = std::ranges::upper_bound(line, x, std::less<>(), &StairPoint::x);
      values.push_back(std::prev(next)->y);
    }
    std::ranges::sort(values);
    const double upper = values[values.size() / 2];
    const double lower = values[(values.size() - 1) / 2];
    result.push_back({x, (lower + upper) / 2});
  }
  return result;
}

}  // namespace swarmsmith
