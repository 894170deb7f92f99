#include "tests/support/film/path.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/math.h"

namespace swarmsmith::film {
namespace {

double hermite(double p0, double m0, double p1, double m1, double s) {
  const double s2 = s * s;
  const double s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * p0 + (s3 - 2 * s2 + s) * m0 + (-2 * s3 + 3 * s2) * p1 +
         (s3 - s2) * m1;
}

}  // namespace

Path::Path(std::vector<Pose> poses, double start_s, double step_s)
    : knots_(std::move(poses)), start_s_(start_s), step_s_(step_s) {
  if (knots_.empty()) throw std::invalid_argument("a path needs a pose");
  for (std::size_t i = 1; i < knots_.size(); ++i) {
    const double before = knots_[i - 1].theta;
    knots_[i].theta = before + wrap_angle(knots_[i].theta - before);
  }
}

double Path::end_s() const {
  return start_s_ + step_s_ * static_cast<double>(knots_.size() - 1);
}

Pose Path::at(double time_s) const {
  const double last = static_cast<double>(knots_.size() - 1);
  const double place = std::clamp((time_s - start_s_) / step_s_, 0.0, last);
  const auto i = std::min(static_cast<std::size_t>(place), knots_.size() - 1);
  const Pose& a = knots_[i];
  const double s = place - static_cast<double>(i);
  if (s == 0) return {a.x, a.y, wrap_angle(a.theta)};
  const Pose& b = knots_[i + 1];
  const Pose& before = i == 0 ? a : knots_[i - 1];
  const Pose& after = i + 2 < knots_.size() ? knots_[i + 2] : b;
  const auto along = [&](double Pose::*part) {
    return hermite(a.*part, (b.*part - before.*part) / 2, b.*part, (after.*part - a.*part) / 2, s);
  };
  return {along(&Pose::x), along(&Pose::y), wrap_angle(along(&Pose::theta))};
}

}  // namespace swarmsmith::film
