#include "tracking/motion/internal/clock_steps.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/assert.h"
#include "base/median.h"

namespace swarmsmith {
namespace {

using Corners = Eigen::Matrix<double, 8, 1>;

constexpr double kWindow_s = 0.3;
/// Relative change of speed that a robot may have around a step.
constexpr double kSteady = 0.3;
/// Relative change of velocity, including its direction: a robot in a tight bend.
constexpr double kBend = 0.6;
constexpr double kLeastStep_px = 1;
/// Two robots cannot be closer than this, whatever the direction of their tags.
constexpr double kSamePlace_m = 0.15;

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
    SWARMSMITH_ASSERT(film.repeats.again.size() == film.record.frame_times.size(),
                      "a word about each frame");
    for (std::size_t i = 0; i < film.record.frame_times.size(); ++i) {
      if (!film.repeats.again[i]) frames_.push_back(i);
    }
    std::vector<double> intervals;
    for (std::size_t i = 1; i < frames_.size(); ++i)
      intervals.push_back(time(i) - time(i - 1));
    if (!intervals.empty()) usual_s_ = upper_median(std::move(intervals));
  }

  std::size_t size() const { return frames_.size(); }
  double time(std::size_t i) const { return film_.record.frame_times[frames_[i]]; }
  double usual_s() const { return usual_s_; }

  /// By how much the time between a picture and the previous one exceeds the clock's time,
  /// according to the motion of one robot; nothing if the robot does not move steadily.
  std::optional<double> lost_s(const TagWay& tag, std::size_t i) const {
    SWARMSMITH_ASSERT(0 < i && i < size(), "a picture with one before");
    const auto before = velocity(tag, i - 1, -1);
    const auto after = velocity(tag, i, 1);
    if (!before || !after || !seen(tag, i) || !seen(tag, i - 1)) return std::nullopt;
    const double interval = time(i) - time(i - 1);
    const Corners moved = corners_of(*seen(tag, i)) - corners_of(*seen(tag, i - 1));
    // Root mean square over the corners, with both coordinates of a corner together.
    const double faster = std::max(before->norm(), after->norm()) / 2;
    const double slower = std::min(before->norm(), after->norm()) / 2;
    const double speed = (faster + slower) / 2;
    // A robot that is suddenly far away may also have turned.
    if (beats_top_speed(tag, i) && faster - slower <= kSteady * speed &&
        speed * usual_s_ >= kLeastStep_px) {
      return moved.norm() / 2 / speed - interval;
    }
    const Corners mean = (*before + *after) / 2;
    if (mean.norm() / 2 * usual_s_ < kLeastStep_px ||
        (*after - *before).norm() > kBend * mean.norm())
      return std::nullopt;
    // The time needed for the distance at the mean of both velocities; the rest is sideways.
    const double time_s = moved.dot(mean) / mean.squaredNorm();
    const double aside = (moved - time_s * mean).norm() / 2;
    if (aside > kLeastStep_px + kSteady * std::fabs(time_s) * mean.norm() / 2) return std::nullopt;
    return time_s - interval;
  }

  /// The speed of a corner, in pixels per second, that is exceeded in a tenth of the film; limited
  /// to between a half and all of the fastest driving speed.
  double usual_speed(const TagWay& tag) const {
    std::vector<double> speeds;
    for (std::size_t i = 0; i < size(); ++i) {
      if (const auto speed = velocity(tag, i, 1)) speeds.push_back(speed->norm() / 2);
    }
    const double least = tag.corner_speed_m_s / 4 * tag.pixels_per_m;
    if (speeds.empty()) return least;
    const auto high =
        speeds.begin() + static_cast<std::ptrdiff_t>(0.9 * static_cast<double>(speeds.size() - 1));
    std::ranges::nth_element(speeds, high);
    return std::clamp(*high, least, 2 * least);
  }

  /// How long robots drove between a picture and the previous one, if at least two of them are
  /// farther away than a robot can drive.
  std::optional<double> leap_s(const std::vector<TagWay>& tags, std::size_t i) const {
    std::vector<const TagWay*> far;
    double longest = 0;
    for (const TagWay& tag : tags) {
      if (!seen(tag, i) || !seen(tag, i - 1)) continue;
      if (!beats_top_speed(tag, i)) {
        const auto lost = lost_s(tag, i);
        if (lost && std::fabs(*lost) < usual_s_ / 2) return std::nullopt;
        continue;
      }
      far.push_back(&tag);
      longest = std::max(longest, corners_moved(seen(tag, i - 1)->corners, seen(tag, i)->corners) /
                                      usual_speed(tag));
    }
    if (far.size() < 2) return std::nullopt;
    // Robots whose tags were exchanged show nothing about the clock.
    for (const TagWay* const one : far) {
      for (const TagWay* const other : far) {
        const double apart = corners_moved(seen(*other, i - 1)->corners, seen(*one, i)->corners);
        if (one != other && apart < kSamePlace_m * one->pixels_per_m) return std::nullopt;
      }
    }
    return longest;
  }

  /// How long robots drove between two pictures that are far apart by the clock, if all robots that
  /// move before and after (at least two) went only as far as in a few intervals. They may turn.
  std::optional<double> stall_s(const std::vector<TagWay>& tags, std::size_t i) const {
    if (time(i) - time(i - 1) < 3 * usual_s_) return std::nullopt;
    int moving = 0;
    double sum = 0;
    for (const TagWay& tag : tags) {
      const auto before = velocity(tag, i - 1, -1);
      const auto after = velocity(tag, i, 1);
      if (!before || !after || !seen(tag, i) || !seen(tag, i - 1)) continue;
      if (std::min(before->norm(), after->norm()) / 2 * usual_s_ < kLeastStep_px) continue;
      const Corners moved = corners_of(*seen(tag, i)) - corners_of(*seen(tag, i - 1));
      const double drove = 2 * moved.norm() / (before->norm() + after->norm());
      if (drove > std::min(3 * usual_s_, (time(i) - time(i - 1)) / 3)) return std::nullopt;
      ++moving;
      sum += drove;
    }
    if (moving < 2) return std::nullopt;
    return sum / moving;
  }

  bool beats_top_speed(const TagWay& tag, std::size_t i) const {
    return corners_moved(seen(tag, i - 1)->corners, seen(tag, i)->corners) >
           tag.corner_speed_m_s * tag.pixels_per_m * (time(i) - time(i - 1)) + kLeastStep_px;
  }

 private:
  const Sighting* seen(const TagWay& tag, std::size_t i) const { return tag.seen[frames_[i]]; }

  /// Velocities of all corners, in pixels per second, over at least two intervals on one side,
  /// because a single interval is noisy.
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

/// The result on which the moving robots agree.
struct Said {
  double lost_s = 0;
  /// The robots are farther away than they can drive, or hardly moved: the time is approximate.
  bool is_leap = false;
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
  auto drove_s = film.leap_s(tags, i);
  if (!drove_s) drove_s = film.stall_s(tags, i);
  std::optional<Said> leap;
  if (drove_s) leap = Said{*drove_s - (film.time(i) - film.time(i - 1)), true};
  if (all.empty() || (all.size() == 1 && !is_too_fast)) return leap;
  const auto [least, most] = std::ranges::minmax(all);
  double sum = 0;
  for (const double one : all)
    sum += one;
  const double mean = sum / static_cast<double>(all.size());
  if (most - least > std::max(kSteady * std::fabs(mean), film.usual_s() / 4)) return leap;
  return Said{mean, leap.has_value()};
}

/// The jitter of the time stamps, from the median of the lost times.
double jitter_of(const std::map<std::size_t, Said>& lost) {
  std::vector<double> sizes;
  for (const auto& [i, said] : lost) {
    if (!said.is_leap) sizes.push_back(std::fabs(said.lost_s));
  }
  if (sizes.empty()) return 0;
  return 1.4826 * upper_median(std::move(sizes));
}

}  // namespace

ClockSteps clock_steps(const FilmedCamera& film) {
  ClockSteps steps;
  const Film pictures(film);
  std::map<std::size_t, Said> lost;
  std::size_t within = 0;
  for (std::size_t i = 1; i < pictures.size(); ++i) {
    const double at_s = pictures.time(i) - film.camera.start_s;
    if (at_s < 0 || pictures.time(i - 1) - film.camera.start_s > film.duration_s) continue;
    ++within;
    const auto said = said_of(pictures, film.tags, i);
    if (!said) continue;
    lost[i] = *said;
    const double interval_s = pictures.time(i) - pictures.time(i - 1);
    if (interval_s + said->lost_s > -interval_s / 4) continue;
    if (steps.backwards++ == 0) steps.backwards_at_s = at_s;
  }
  if (20 * lost.size() < within || lost.empty())
    steps.reason = "hardly ever did two robots move steadily at once";
  const double least = std::max(pictures.usual_s() / 2, 5 * jitter_of(lost));
  double sum = 0;
  const auto at = [&](std::size_t i) { return lost.contains(i) ? lost.at(i).lost_s : 0; };
  for (const auto& [i, said] : lost) {
    const double lost_s = said.lost_s;
    // If only one stamp is late, one interval is too long and the next one too short.
    const double with_next = lost_s + (at(i - 1) + at(i + 1)) / 2;
    // Stamps are in order, so no stamp is late by more than an interval or two.
    if (std::fabs(lost_s) < (said.is_leap ? std::min(least, 2 * pictures.usual_s()) : least))
      continue;
    if (!said.is_leap && (std::fabs(with_next) < least || lost_s * with_next < 0)) continue;
    ++steps.count;
    sum += lost_s;
    steps.most_off_s = std::max({steps.most_off_s, std::fabs(sum), std::fabs(lost_s)});
    if (std::fabs(lost_s) <= std::fabs(steps.worst.lost_s)) continue;
    steps.worst = {pictures.time(i) - film.camera.start_s, lost_s,
                   pictures.time(i) - pictures.time(i - 1)};
  }
  return steps;
}

}  // namespace swarmsmith
