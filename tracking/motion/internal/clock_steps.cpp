#include "tracking/motion/internal/clock_steps.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

namespace swarmsmith {
namespace {

using Corners = Eigen::Matrix<double, 8, 1>;

constexpr double kWindow_s = 0.3;
/// Of its velocity, that a robot may change around a step.
constexpr double kSteady = 0.3;
constexpr double kLeastStep_px = 1;

Corners corners_of(const Sighting& seen) {
  Corners all;
  for (std::size_t i = 0; i < seen.corners.size(); ++i) {
    all(static_cast<Eigen::Index>(2 * i)) = seen.corners.at(i).u;
    all(static_cast<Eigen::Index>(2 * i + 1)) = seen.corners.at(i).v;
  }
  return all;
}

/// The true pictures of a film.
class Film {
 public:
  explicit Film(const FilmedCamera& film) : film_(film) {
    for (std::size_t i = 0; i < film.record.frame_times.size(); ++i) {
      if (!film.repeats.again[i]) frames_.push_back(i);
    }
    std::vector<double> intervals;
    for (std::size_t i = 1; i < frames_.size(); ++i)
      intervals.push_back(time(i) - time(i - 1));
    if (intervals.empty()) return;
    const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
    std::ranges::nth_element(intervals, middle);
    usual_s_ = *middle;
  }

  std::size_t size() const { return frames_.size(); }
  double time(std::size_t i) const { return film_.record.frame_times[frames_[i]]; }
  double usual_s() const { return usual_s_; }

  /// By how much the time between a picture and the one before is longer than the clock says, in
  /// the eyes of one robot; nothing when it does not move steadily.
  std::optional<double> lost_s(const TagWay& tag, std::size_t i) const {
    const auto before = velocity(tag, i - 1, -1);
    const auto after = velocity(tag, i, 1);
    if (!before || !after || !seen(tag, i) || !seen(tag, i - 1)) return std::nullopt;
    const Corners mean = (*before + *after) / 2;
    // The root mean square of a corner's two coordinates together.
    const double speed = mean.norm() / 2;
    if (speed * usual_s_ < kLeastStep_px || (*after - *before).norm() > kSteady * mean.norm())
      return std::nullopt;
    const double interval = time(i) - time(i - 1);
    const Corners moved = corners_of(*seen(tag, i)) - corners_of(*seen(tag, i - 1));
    const double share = moved.dot(mean) / mean.squaredNorm();
    const double aside = (moved - share * mean).norm() / 2;
    if (aside > kLeastStep_px + kSteady * std::fabs(share) * speed) return std::nullopt;
    return share - interval;
  }

  bool beats_top_speed(const TagWay& tag, std::size_t i) const {
    return corners_moved(seen(tag, i - 1)->corners, seen(tag, i)->corners) >
           kCornerSpeed_m_s * tag.pixels_per_m * (time(i) - time(i - 1)) + kLeastStep_px;
  }

 private:
  const Sighting* seen(const TagWay& tag, std::size_t i) const { return tag.seen[frames_[i]]; }

  /// Over at least two intervals on one side.
  std::optional<Corners> velocity(const TagWay& tag, std::size_t i, int side) const {
    std::size_t far = i;
    while (std::fabs(time(far) - time(i)) < kWindow_s) {
      if ((side < 0 && far == 0) || (side > 0 && far + 1 == size())) break;
      const std::size_t next = side < 0 ? far - 1 : far + 1;
      if (std::fabs(time(next) - time(i)) > 2 * kWindow_s) break;
      far = next;
    }
    const std::size_t apart = far > i ? far - i : i - far;
    if (apart < 2 || !seen(tag, i) || !seen(tag, far)) return std::nullopt;
    return (corners_of(*seen(tag, far)) - corners_of(*seen(tag, i))) / (time(far) - time(i));
  }

  const FilmedCamera& film_;
  std::vector<std::size_t> frames_;
  double usual_s_ = 0;
};

/// What the robots that move agree on.
struct Said {
  int robots = 0;
  double lost_s = 0;
};

std::optional<Said> said_of(const Film& film, const std::vector<TagWay>& tags, std::size_t i) {
  std::vector<double> all;
  bool is_too_fast = false;
  for (const TagWay& tag : tags) {
    const auto lost = film.lost_s(tag, i);
    if (!lost) continue;
    all.push_back(*lost);
    is_too_fast = is_too_fast || film.beats_top_speed(tag, i);
  }
  if (all.empty() || (all.size() == 1 && !is_too_fast)) return std::nullopt;
  const auto [least, most] = std::ranges::minmax(all);
  double sum = 0;
  for (const double one : all)
    sum += one;
  const double mean = sum / static_cast<double>(all.size());
  if (most - least > std::max(kSteady * std::fabs(mean), film.usual_s() / 4)) return std::nullopt;
  return Said{static_cast<int>(all.size()), mean};
}

}  // namespace

ClockSteps clock_steps(const FilmedCamera& film) {
  ClockSteps steps;
  const Film pictures(film);
  double sum = 0;
  std::size_t within = 0;
  std::size_t asked = 0;
  for (std::size_t i = 1; i < pictures.size(); ++i) {
    const double at_s = pictures.time(i) - film.camera.start_s;
    if (at_s < 0 || pictures.time(i - 1) - film.camera.start_s > film.duration_s) continue;
    ++within;
    const auto said = said_of(pictures, film.tags, i);
    if (!said) continue;
    ++asked;
    if (std::fabs(said->lost_s) < pictures.usual_s() / 2) continue;
    ++steps.count;
    sum += said->lost_s;
    steps.most_off_s = std::max({steps.most_off_s, std::fabs(sum), std::fabs(said->lost_s)});
    if (std::fabs(said->lost_s) > std::fabs(steps.worst.lost_s)) steps.worst = {at_s, said->lost_s};
  }
  if (20 * asked < within || asked == 0)
    steps.reason = "hardly ever did two robots move steadily at once";
  return steps;
}

}  // namespace swarmsmith
