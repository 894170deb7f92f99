#include "tracking/motion/repeats.h"

#include <algorithm>
#include <utility>

#include "base/assert.h"
#include "base/median.h"
#include "tracking/motion/internal/tag_ways.h"

namespace swarmsmith {
namespace {

/// Motion is measured over this time before and after a picture.
constexpr double kAround_s = 0.35;
/// A tag that moves less between frames may stand still: corners are precise to some hundredths of
/// a pixel, in bad films to a tenth.
constexpr double kMoving_px = 0.4;
/// Share of its usual step that a moving tag may still move between two copies of a picture, due to
/// the codec.
constexpr double kStandingShare = 0.2;
/// Largest difference of a tag's corners between copies of a picture, including key frames.
constexpr double kStanding_px = 0.5;
/// A longer standstill needs proof, because it becomes a gap if the pictures are repeats.
constexpr double kLong_s = 0.3;
/// A robot that starts to move does not make larger steps at first than later; a robot whose
/// picture stood still jumps to make up for it.
constexpr double kMakesUp = 1.3;
constexpr double kMakesUpMuch = 1.5;
/// A robot that really stops does so anywhere between two frames, so its last step is any share of
/// its usual step. A robot whose picture stands still made its full last step.
constexpr double kFullStep = 0.8;
constexpr double kLargeStep = 0.6;
constexpr double kDoubtful_s = 1;

class Search {
 public:
  Search(const std::vector<double>& times, std::vector<TagWay> tags)
      : times_(times), tags_(std::move(tags)) {
    SWARMSMITH_ASSERT(std::ranges::all_of(tags_,
                                          [&](const TagWay& tag) {
                                            return tag.seen.size() == times.size() &&
                                                   tag.way.size() == times.size();
                                          }),
                      "a tag's way has each frame");
    found_.again.assign(times.size(), false);
  }

  Repeats run() {
    find_long();
    find_loops();
    find_short();
    found_.count = static_cast<std::size_t>(std::ranges::count(found_.again, true));
    return std::move(found_);
  }

 private:
  std::size_t frames() const { return times_.size(); }
  double interval_s(std::size_t frame) const { return times_[frame] - times_[frame - 1]; }
  static double step(const TagWay& tag, std::size_t frame) {
    return tag.way[frame] - tag.way[frame - 1];
  }
  double speed_before(const TagWay& tag, std::size_t frame) const {
    return way_speed(tag, times_, frame_before(times_, frame, kAround_s), frame);
  }
  double speed_after(const TagWay& tag, std::size_t frame) const {
    return way_speed(tag, times_, frame, frame_after(times_, frame, kAround_s));
  }
  static bool both(const TagWay& tag, std::size_t a, std::size_t b) {
    return tag.is_seen(a) && tag.is_seen(b);
  }

  // Pictures that repeat for a few frames.

  /// The distance that a tag should have moved since the previous frame; 0 if it does not move
  /// there.
  double usual_step(const TagWay& tag, std::size_t frame) const {
    const double after = speed_after(tag, frame) * interval_s(frame);
    // The motion before the film is unknown.
    const double before = frame == 1 ? after : speed_before(tag, frame - 1) * interval_s(frame);
    return std::min(before, after) > kMoving_px ? (before + after) / 2 : 0;
  }

  /// Whether a tag that stands still at `frame` jumps to make up for it when it moves again.
  bool makes_up(const TagWay& tag, std::size_t frame) const {
    std::size_t next = frame + 1;
    while (next < frames() && both(tag, next - 1, next) &&
           step(tag, next) < kStandingShare * usual_step(tag, next)) {
      ++next;
    }
    if (next >= frames() || !both(tag, next - 1, next)) return false;
    return step(tag, next) > kMakesUp * speed_after(tag, next) * interval_s(next) + kMoving_px;
  }

  bool comes_again(std::size_t frame) const {
    int standing = 0;
    const TagWay* last = nullptr;
    for (const TagWay& tag : tags_) {
      if (!both(tag, frame - 1, frame)) continue;
      const double usual = usual_step(tag, frame);
      if (usual <= 0) {
        if (step(tag, frame) > kMoving_px) return false;
        continue;
      }
      if (step(tag, frame) >= kStandingShare * usual) return false;
      ++standing;
      last = &tag;
    }
    return standing >= 2 || (standing == 1 && makes_up(*last, frame));
  }

  void find_short() {
    for (std::size_t frame = 1; frame < frames(); ++frame) {
      if (!found_.again[frame]) found_.again[frame] = comes_again(frame);
    }
  }

  // Pictures that stand still for longer.

  bool stands(std::size_t from, std::size_t frame) const {
    bool any = false;
    for (const TagWay& tag : tags_) {
      if (!both(tag, from, frame)) continue;
      any = true;
      if (corners_moved(tag.seen[from]->corners, tag.seen[frame]->corners) > kStanding_px)
        return false;
    }
    return any;
  }

  /// Whether robots that stood still from `from` to `last` are suddenly elsewhere in the next
  /// frame, and stay there.
  bool makes_up_much(std::size_t from, std::size_t last) const {
    const std::size_t next = last + 1;
    int caught_up = 0;
    for (const TagWay& tag : tags_) {
      if (!both(tag, last, next)) continue;
      const double jump = corners_moved(tag.seen[last]->corners, tag.seen[next]->corners);
      const double speed = std::max(speed_before(tag, from), speed_after(tag, next));
      const double most = 2 * kStanding_px + kMakesUpMuch * speed * interval_s(next);
      if (jump <= most || !stays_away(tag, last, next, jump)) continue;
      ++caught_up;
      const double fastest = tag.corner_speed_m_s * tag.pixels_per_m * interval_s(next);
      if (jump > fastest + 2 * kStanding_px) return true;
    }
    return caught_up >= 2;
  }

  /// A tag that was misread is back at its place in the following frame.
  bool stays_away(const TagWay& tag, std::size_t last, std::size_t next, double jump) const {
    if (next + 1 >= frames() || !tag.is_seen(next + 1)) return true;
    return corners_moved(tag.seen[last]->corners, tag.seen[next + 1]->corners) > jump / 2;
  }

  enum class End { Stopped, Frozen, Doubtful };

  /// Median steps of tags that stand still: before a frame, in pictures where other tags move (so
  /// that they are not repeats), and after this frame.
  struct Noise {
    double before_px = 0;
    double after_px = 0;
  };

  std::optional<Noise> noise_around(std::size_t from) const {
    constexpr std::size_t kEnoughBefore = 60;
    constexpr std::size_t kEnoughAfter = 20;
    std::vector<double> before;
    std::vector<double> after;
    for (std::size_t frame = 1; frame < frames(); ++frame) {
      const bool moves = std::ranges::any_of(tags_, [&](const TagWay& tag) {
        return both(tag, frame - 1, frame) && step(tag, frame) > 2 * kStanding_px;
      });
      if (frame <= from && !moves) continue;
      for (const TagWay& tag : tags_) {
        if (!both(tag, frame - 1, frame)) continue;
        if (frame > from) after.push_back(step(tag, frame));
        if (frame <= from && step(tag, frame) <= kStanding_px) before.push_back(step(tag, frame));
      }
    }
    if (before.size() < kEnoughBefore || after.size() < kEnoughAfter) return std::nullopt;
    return Noise{upper_median(std::move(before)), upper_median(std::move(after))};
  }

  /// Judges robots that stand still from a frame to the film's end. Camera noise moves the corners
  /// of still tags, unless the codec hides it; a repeated picture has no noise.
  End end_of(std::size_t from) const {
    constexpr double kSeen_px = 0.005;
    const std::optional<Noise> noise = noise_around(from);
    if (noise && noise->before_px > kSeen_px) {
      if (noise->after_px < 0.2 * noise->before_px) return End::Frozen;
      if (noise->after_px > 0.8 * noise->before_px) return End::Stopped;
    }
    int moving = 0;
    int full = 0;
    int large = 0;
    for (const TagWay& tag : tags_) {
      if (from < 2 || !both(tag, from - 1, from)) continue;
      const double usual = speed_before(tag, from - 1) * interval_s(from);
      if (usual <= 2 * kMoving_px) continue;
      ++moving;
      if (step(tag, from) > kFullStep * usual) ++full;
      if (step(tag, from) > kLargeStep * usual) ++large;
    }
    if (moving >= 2 && full == moving) return End::Frozen;
    if (moving > 0) return large > 0 ? End::Doubtful : End::Stopped;
    // Nothing moved before the standstill.
    const bool is_noisy = std::ranges::any_of(
        tags_, [&](const TagWay& tag) { return tag.way.back() > tag.way[from]; });
    if (times_.back() - times_[from] < kDoubtful_s || is_noisy || noise) return End::Stopped;
    return End::Doubtful;
  }

  void find_long() {
    for (std::size_t from = 0; from + 1 < frames();) {
      std::size_t last = from;
      while (last + 1 < frames() && stands(from, last + 1))
        ++last;
      if (times_[last] - times_[from] <= kLong_s) {
        ++from;
        continue;
      }
      judge_long(from, last);
      from = last + 1;
    }
  }

  void judge_long(std::size_t from, std::size_t last) {
    bool frozen = false;
    if (last + 1 < frames()) {
      frozen = makes_up_much(from, last);
    } else {
      const std::size_t begin = end_begins(from, last);
      const End end = end_of(begin);
      frozen = end == End::Frozen;
      if (end == End::Doubtful) found_.doubtful_from_s = times_[begin];
      if (frozen) from = begin;
    }
    if (!frozen) return;
    for (std::size_t frame = from + 1; frame <= last; ++frame)
      found_.again[frame] = true;
    found_.frozen.push_back({times_[from], times_[last]});
  }

  /// The frame after which no corner changes any more; or the first frame of the standstill if
  /// there is motion right before it.
  std::size_t end_begins(std::size_t from, std::size_t last) const {
    const bool moved = std::ranges::any_of(tags_, [&](const TagWay& tag) {
      return from > 0 && both(tag, from - 1, from) && step(tag, from) > kMoving_px;
    });
    if (moved) return from;
    std::size_t first = last;
    while (first > from && std::ranges::all_of(tags_, [&](const TagWay& tag) {
             return tag.way[first - 1] >= tag.way[last];
           })) {
      --first;
    }
    return times_[last] - times_[first] >= kDoubtful_s ? first : from;
  }

  // Several pictures that repeat in a loop.

  /// Whether all robots are where they were `back` frames before, and at least two were elsewhere
  /// meanwhile.
  bool comes_back(std::size_t frame, std::size_t back) const {
    constexpr double kElsewhere_px = 2;
    int away = 0;
    for (const TagWay& tag : tags_) {
      if (!both(tag, frame - back, frame)) continue;
      const TagCorners& now = tag.seen[frame]->corners;
      if (corners_moved(tag.seen[frame - back]->corners, now) > kStanding_px) return false;
      for (std::size_t between = frame - back + 1; between < frame; ++between) {
        if (!tag.is_seen(between)) continue;
        if (corners_moved(tag.seen[between]->corners, now) < kElsewhere_px) continue;
        ++away;
        break;
      }
    }
    return away >= 2;
  }

  void find_loops() {
    constexpr double kLongest_s = 1.5;
    constexpr std::size_t kInARow = 3;
    for (std::size_t first = 2; first < frames(); ++first) {
      std::size_t longest = 0;
      for (std::size_t back = 2; back <= first; ++back) {
        if (times_[first] - times_[first - back] > kLongest_s) break;
        std::size_t count = 0;
        while (first + count < frames() && comes_back(first + count, back))
          ++count;
        longest = std::max(longest, count);
      }
      if (longest < kInARow) continue;
      const std::size_t last = first + longest - 1;
      for (std::size_t frame = first; frame <= last; ++frame)
        found_.again[frame] = true;
      found_.frozen.push_back({times_[first - 1], times_[last], true});
      first = last;
    }
  }

  const std::vector<double>& times_;
  std::vector<TagWay> tags_;
  Repeats found_;
};

}  // namespace

Repeats repeats_of(const Observations& observations, int camera, std::span<const RobotSetup> robots,
                   double corner_speed_m_s) {
  const CameraRecord& record = observations.cameras.at(static_cast<std::size_t>(camera));
  return Search(record.frame_times, tag_ways(observations, camera, robots, corner_speed_m_s)).run();
}

}  // namespace swarmsmith
