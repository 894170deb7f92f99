#include "sim/mission/scores/formula.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/math.h"
#include "sim/mission/colors.h"

namespace swarmsmith {
namespace {

constexpr double kInstantsPerSecond = 10;

/// Names in a formula for robots or objects, then the names of the colours; in the same order as in
/// Values.
enum Name : std::size_t { kX, kY, kT, kSpeed, kNearest, kFromCentre, kFirstColor };
constexpr std::array<std::string_view, 13> kNames = {
    "x",    "y",     "t",   "speed", "nearest", "from_centre", "black",
    "gray", "white", "red", "green", "blue",    "yellow"};
/// Names in a formula for the swarm: `spread` replaces `nearest`, `robots` replaces `from_centre`.
constexpr std::array<std::string_view, 13> kSwarmNames = {
    "x",    "y",     "t",   "speed", "spread", "robots", "black",
    "gray", "white", "red", "green", "blue",   "yellow"};
static_assert(kNames.size() == kFirstColor + kNamedColors.size());

using Values = std::array<double, kNames.size()>;

std::span<const std::string_view> names_for(std::string_view subject) {
  if (subject == "swarm") return kSwarmNames;
  return kNames;
}

double distance(Point a, Point b) {
  return hypot(a.x - b.x, a.y - b.y);
}

/// A sum that has the same bits for any order of the values.
double ordered_sum(std::vector<double> values) {
  std::ranges::sort(values);
  double sum = 0;
  for (const double value : values)
    sum += value;
  return sum;
}

/// Mean of `value(point)` over `points`; 0 if there are none.
template <class Value>
double mean_of(std::span<const Point> points, Value value) {
  std::vector<double> values;
  for (const Point& point : points)
    values.push_back(value(point));
  return values.empty() ? 0 : ordered_sum(values) / static_cast<double>(points.size());
}

Point centre_of(std::span<const Point> points) {
  return {mean_of(points, [](Point p) { return p.x; }),
          mean_of(points, [](Point p) { return p.y; })};
}

/// Metres per second since the previous instant; 0 at the first.
double speed_of(std::span<const Point> now, std::span<const Point> before, std::size_t i) {
  return i < before.size() ? distance(now[i], before[i]) * kInstantsPerSecond : 0;
}

double greatest_distance(std::span<const Point> points) {
  double greatest = 0;
  for (const Point& a : points) {
    for (const Point& b : points)
      greatest = std::max(greatest, distance(a, b));
  }
  return greatest;
}

double folded(const std::string& over, const std::vector<double>& values) {
  if (values.empty()) return 0;
  // Comparisons with NaN are false, so that extremes and sorted sums would depend on its place.
  if (std::ranges::any_of(values, [](double v) { return std::isnan(v); })) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (over == "min") return std::ranges::min(values);
  if (over == "max") return std::ranges::max(values);
  const double sum = ordered_sum(values);
  return over == "mean" ? sum / static_cast<double>(values.size()) : sum;
}

}  // namespace

std::optional<ScoreFault> Formula::fault() const {
  const auto what = CompiledFormula::fault(value, names_for(of));
  if (!what) return std::nullopt;
  const std::string_view other = of == "swarm" ? "robots" : "swarm";
  const bool would_do = !CompiledFormula::fault(value, names_for(other));
  return ScoreFault{"value",
                    "cannot be computed: " + *what +
                        (would_do ? "; with of = \"" + std::string(other) + "\" it could be" : "")};
}

FormulaScorer::FormulaScorer(const Formula& rule, Arena arena)
    : rule_(rule), arena_(std::move(arena)), formula_(rule.value, names_for(rule.of)) {
  needs_floor_ = std::ranges::any_of(
      kNamedColors, [&](const NamedColor& color) { return formula_.uses(color.name); });
}

void FormulaScorer::observe(const Positions& seen) {
  ++instant_;
  std::swap(robots_, robots_before_);
  std::swap(objects_, objects_before_);
  robots_.assign(seen.robots.begin(), seen.robots.end());
  objects_.assign(seen.objects.begin(), seen.objects.end());
  if (rule_.at == When::Sum) sum_ += value_of_instant();
}

double FormulaScorer::score() const {
  if (instant_ == 0) return 0;
  return rule_.at == When::Sum ? sum_ : value_of_instant();
}

double FormulaScorer::value_of_instant() const {
  const double time = instant_ / kInstantsPerSecond;
  const auto count_floor = [&](Point point, Values& values) {
    if (!needs_floor_) return;
    const Rgb floor = floor_at(arena_, point);
    for (std::size_t c = 0; c < kNamedColors.size(); ++c)
      values[kFirstColor + c] += floor == kNamedColors[c].color ? 1 : 0;
  };

  const Point centre = centre_of(robots_);
  if (rule_.of == "swarm") {
    std::vector<double> speeds;
    Values values{centre.x, centre.y, time};
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      speeds.push_back(speed_of(robots_, robots_before_, i));
      count_floor(robots_[i], values);
    }
    values[kSpeed] = folded("mean", speeds);
    values[kNearest] = greatest_distance(robots_);
    values[kFromCentre] = static_cast<double>(robots_.size());
    return formula_(values);
  }

  const bool of_robots = rule_.of == "robots";
  const std::vector<Point>& subjects = of_robots ? robots_ : objects_;
  const std::vector<Point>& before = of_robots ? robots_before_ : objects_before_;
  std::vector<double> results;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const Point point = subjects[i];
    Values values{point.x, point.y, time, speed_of(subjects, before, i)};
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < robots_.size(); ++j) {
      if (!of_robots || j != i) nearest = std::min(nearest, distance(point, robots_[j]));
    }
    values[kNearest] = std::isinf(nearest) ? 0 : nearest;
    values[kFromCentre] = distance(point, centre);
    count_floor(point, values);
    results.push_back(formula_(values));
  }
  return folded(rule_.over, results);
}

}  // namespace swarmsmith
