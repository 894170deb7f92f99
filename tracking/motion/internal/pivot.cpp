#include "tracking/motion/internal/pivot.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/assert.h"
#include "base/math.h"

namespace swarmsmith {
namespace {

constexpr double kLeastTurn_rad = 0.1;
/// Largest error of a single point from the noise of the poses.
constexpr double kTold_m = 0.003;
/// How far the end of a skid moves a point.
constexpr double kSkid_m = 0.005;
/// A point that is nearer to the side than a tread: robots also turn about a tread. No midpoint of
/// a tread is farther ahead or behind than `kNoTread_m`.
constexpr double kMostAside_m = 0.06;
constexpr double kNoTread_m = 0.03;
constexpr std::size_t kLeastPoints = 5;
constexpr int kLeastEachWay = 2;

/// The position of the measured point relative to the point that did not move in a step.
struct Resting {
  double ahead_m = 0;
  double aside_m = 0;
  double sigma_m = 0;
  bool is_left = false;
};

std::vector<Resting> resting_of(std::span<const TravelStep> steps) {
  std::vector<Resting> points;
  for (const TravelStep& step : steps) {
    if (step.touches || std::fabs(step.turn_rad) < kLeastTurn_rad) continue;
    const Resting point{step.aside_m / step.turn_rad, -step.ahead_m / step.turn_rad,
                        step.noise_m / std::fabs(step.turn_rad), step.turn_rad > 0};
    if (point.sigma_m < kTold_m) points.push_back(point);
  }
  return points;
}

/// The mean of the points near one of them.
struct Heap {
  std::size_t count = 0;
  double ahead_m = 0;
  double aside_m = 0;
  double noise_m = 0;
  double scatter_m = 0;
};

std::optional<Heap> heap_around(const Resting& middle, const std::vector<Resting>& points) {
  Heap heap;
  int left = 0;
  double squares = 0;
  double noise = 0;
  for (const Resting& point : points) {
    const double reach = kSkid_m + 3 * std::max(point.sigma_m, middle.sigma_m);
    if (hypot(point.ahead_m - middle.ahead_m, point.aside_m - middle.aside_m) > reach) continue;
    ++heap.count;
    left += point.is_left ? 1 : 0;
    heap.ahead_m += point.ahead_m;
    heap.aside_m += point.aside_m;
    squares += point.ahead_m * point.ahead_m + point.aside_m * point.aside_m;
    noise += point.sigma_m * point.sigma_m;
  }
  SWARMSMITH_ASSERT(heap.count >= 1, "a point is in the heap around it");
  if (heap.count < kLeastPoints) return std::nullopt;
  const auto count = static_cast<double>(heap.count);
  heap.ahead_m /= count;
  heap.aside_m /= count;
  const double mean = heap.ahead_m * heap.ahead_m + heap.aside_m * heap.aside_m;
  heap.scatter_m = std::sqrt(std::max(0.0, squares / count - mean) / count);
  heap.noise_m = std::sqrt(noise) / count;
  const bool turns_both_ways =
      std::min(left, static_cast<int>(heap.count) - left) >= kLeastEachWay &&
      (std::fabs(heap.aside_m) < kMostAside_m || std::fabs(heap.ahead_m) > kNoTread_m);
  if (!turns_both_ways && std::fabs(heap.aside_m) > kSkid_m) return std::nullopt;
  return heap;
}

}  // namespace

std::optional<Pivot> pivot_of(std::span<const TravelStep> steps) {
  const std::vector<Resting> points = resting_of(steps);
  std::optional<Heap> best;
  for (const Resting& point : points) {
    const std::optional<Heap> heap = heap_around(point, points);
    if (heap && (!best || heap->count > best->count)) best = heap;
  }
  if (!best) return std::nullopt;
  return Pivot{best->ahead_m, best->aside_m,
               std::sqrt(best->scatter_m * best->scatter_m + best->noise_m * best->noise_m +
                         kSkid_m * kSkid_m / 4)};
}

}  // namespace swarmsmith
