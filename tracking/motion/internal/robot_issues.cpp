#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "base/assert.h"
#include "base/math.h"
#include "base/plain_text.h"
#include "tracking/motion/internal/robot_track.h"

namespace swarmsmith {
namespace {

constexpr Question kTwins{"frames with its number twice", "", "a second tag with its number"};
constexpr Question kGap{"longest gap", "s", "a robot that was hidden, carried or lost"};
constexpr Question kJumps{"jumps", "", "a robot that was carried; another tag with its number"};
constexpr Question kEnd{"gap around the last instant", "s", "an end that no camera saw"};
constexpr Question kBridged{"bridged cycles", "%", "a path that is a guess between samples"};
constexpr Question kGuessed{"cycles in long gaps", "", "a path that is a guess between samples"};
constexpr Question kOutside{"samples in a row outside of the walls", "",
                            "a robot that was carried out; a wrong survey"};
constexpr Question kOutliers{"dropped samples", "%", "reflections, blur, a second tag"};
constexpr Question kCameras{"cameras agree", "mm", "a wrong clock or place of one camera"};
constexpr Question kByHand{"points by hand", "", "positions from a person instead of the film"};

/// A period of the run in which a robot was not seen.
struct Gap {
  double from_s = 0;
  double to_s = 0;

  double length_s() const { return to_s - from_s; }
};

/// The gaps between samples, and those between the limits of the video and the first and last
/// sample.
std::vector<Gap> gaps_of(const std::vector<TimedPose>& track, const FrameReport& frames) {
  SWARMSMITH_ASSERT(!track.empty(), "a robot that was never seen is an error before");
  std::vector<Gap> gaps;
  if (track.front().time_s > frames.from_s) gaps.push_back({frames.from_s, track.front().time_s});
  for (std::size_t i = 1; i < track.size(); ++i) {
    if (track[i].time_s <= frames.from_s || track[i - 1].time_s >= frames.to_s) continue;
    gaps.push_back({track[i - 1].time_s, track[i].time_s});
  }
  if (track.back().time_s < frames.to_s) gaps.push_back({track.back().time_s, frames.to_s});
  return gaps;
}

/// Adds issues of one robot.
class Complaints {
 public:
  Complaints(const TaggedRobot& robot, std::vector<Issue>& issues)
      : robot_(robot.setup), issues_(issues) {}

  void add(IssueCode code, const std::string& text, std::optional<double> from = {},
           std::optional<double> to = {}) {
    issues_.push_back({code, fmt::format("{} ({}) {}", robot_.name, tags_text(robot_), text),
                       robot_.name, from, to});
  }

 private:
  const RobotSetup& robot_;
  std::vector<Issue>& issues_;
};

/// Whether the clock stepped at the end of a period; then the step is the cause, which has its own
/// issue.
bool is_step(const FrameReport& frames, double from_s, double to_s) {
  return std::ranges::any_of(frames.issues, [&](const Issue& issue) {
    return issue.code == IssueCode::ClockStep && issue.from.value_or(-1) > from_s &&
           (*issue.from <= to_s + kSameInstant_s || to_s >= frames.to_s - kSameInstant_s);
  });
}

void check_gaps(const std::vector<Gap>& gaps, const FrameReport& frames, const TrackLimits& limits,
                Complaints& complaints) {
  for (const Gap& gap : gaps) {
    if (is_step(frames, gap.from_s, gap.to_s)) continue;
    if (gap.length_s() <= limits.degraded_gap_s + kSameInstant_s) continue;
    complaints.add(IssueCode::Gap,
                   fmt::format("was not seen from {:.2f} s to {:.2f} s (limit {:.1f} s); look what "
                               "hid its tag",
                               gap.from_s, gap.to_s, limits.degraded_gap_s),
                   gap.from_s, gap.to_s);
  }
}

/// Returns the number of breaks.
int check_breaks(const RobotTrack& track, const FrameReport& frames, const TrackOptions& options,
                 Complaints& complaints) {
  const TrackLimits& limits = options.limits;
  int breaks = 0;
  for (const auto& [from, to] : track.breaks) {
    if (to.time_s < 0 || from.time_s > instant_s(options.span.cycles)) continue;
    if (is_step(frames, from.time_s, to.time_s)) continue;
    ++breaks;
    const double way = hypot(to.pose.x - from.pose.x, to.pose.y - from.pose.y);
    const double turn = std::fabs(wrap_angle(to.pose.theta - from.pose.theta));
    const double duration = std::max(to.time_s - from.time_s, kSameInstant_s);
    complaints.add(IssueCode::Gap,
                   fmt::format("cannot have come from where it was at {:.2f} s to where it was at "
                               "{:.2f} s: {:.1f} m/s and {:.0f} rad/s, the limits are {:.1f} m/s "
                               "and {:.0f} rad/s; was it carried, or is there another tag of its "
                               "number?",
                               from.time_s, to.time_s, way / duration, turn / duration,
                               limits.top_speed_m_s, limits.top_turn_rad_s),
                   from.time_s, to.time_s);
  }
  return breaks;
}

/// A score of the last instant needs a measured pose: a short interpolation is allowed, but never
/// extrapolation. Returns the gap around the last instant; none if the film does not cover it, or
/// no sample follows.
std::optional<double> check_end(const RobotTrack& track, const FrameReport& frames,
                                const TrackOptions& options, Complaints& complaints) {
  if (!options.scored_at_the_end || !frames.covers_the_end) return std::nullopt;
  const double end = instant_s(options.span.cycles);
  const auto next =
      std::ranges::lower_bound(track.merged, end - kSameInstant_s, {}, &TimedPose::time_s);
  if (next == track.merged.end()) {
    complaints.add(IssueCode::Gap,
                   fmt::format("was not seen at the end nor after it, last at {:.2f} s: the score "
                               "looks at {:.2f} s and nothing is extrapolated",
                               track.merged.back().time_s, end),
                   track.merged.back().time_s, end);
    return std::nullopt;
  }
  if (next->time_s <= end + kSameInstant_s || next == track.merged.begin()) return 0;
  SWARMSMITH_ASSERT(std::prev(next)->time_s < end, "the last instant lies in the gap");
  const double from = std::prev(next)->time_s;
  const double gap_s = next->time_s - from;
  if (gap_s <= options.limits.last_instant_gap_s + kSameInstant_s) return gap_s;
  complaints.add(IssueCode::Gap,
                 fmt::format("was not seen from {:.2f} s to {:.2f} s, around the instant that the "
                             "score looks at (limit {:.1f} s)",
                             from, next->time_s, options.limits.last_instant_gap_s),
                 from, next->time_s);
  return gap_s;
}

/// Number of cycles with a guessed pose: across a long gap, or held without a near sample. A video
/// that ends a frame before the run's last instant does not count, and a video that covers less
/// than the run is reported elsewhere.
std::int64_t guessed_cycles(const RobotTrack& track, const FrameReport& frames,
                            const TrackLimits& limits) {
  std::int64_t guessed = 0;
  for (std::size_t cycle = 1; cycle < track.kinds.size(); ++cycle) {
    if (track.kinds[cycle] == CycleKind::Degraded) ++guessed;
    if (track.kinds[cycle] != CycleKind::Missing) continue;
    const double time = instant_s(static_cast<int>(cycle));
    if (time < frames.from_s || time > frames.to_s) continue;
    const auto next = std::ranges::lower_bound(track.merged, time, {}, &TimedPose::time_s);
    const double to = next == track.merged.end() ? frames.to_s : next->time_s;
    const double from = next == track.merged.begin() ? frames.from_s : std::prev(next)->time_s;
    // Longer gaps are reported as errors.
    if (to - from > limits.degraded_gap_s + kSameInstant_s) continue;
    const bool is_near = (next != track.merged.end() && to - time <= limits.measured_gap_s) ||
                         (next != track.merged.begin() && time - from <= limits.measured_gap_s);
    if (!is_near) ++guessed;
  }
  return guessed;
}

/// Number of cycles that were bridged, and of those in which no camera took a frame.
struct Bridged {
  std::int64_t cycles = 0;
  std::int64_t without_frames = 0;
};

Bridged bridged_cycles(const RobotTrack& track, const FrameReport& frames) {
  Bridged bridged;
  for (std::size_t cycle = 1; cycle < track.kinds.size(); ++cycle) {
    const CycleKind kind = track.kinds[cycle];
    if (kind != CycleKind::Interpolated && kind != CycleKind::Degraded) continue;
    ++bridged.cycles;
    const auto next = std::ranges::lower_bound(track.merged, instant_s(static_cast<int>(cycle)), {},
                                               &TimedPose::time_s);
    if (next == track.merged.begin() || next == track.merged.end()) continue;
    const auto frame =
        std::ranges::upper_bound(frames.times, std::prev(next)->time_s + kSameInstant_s);
    const bool was_looked_at =
        frame != frames.times.end() && *frame < next->time_s - kSameInstant_s;
    if (!was_looked_at) ++bridged.without_frames;
  }
  return bridged;
}

void check_bridged(const RobotTrack& track, const std::vector<Gap>& gaps, const FrameReport& frames,
                   const TrackLimits& limits, Complaints& complaints) {
  const Bridged bridged = bridged_cycles(track, frames);
  const auto cycles = static_cast<std::int64_t>(track.kinds.size()) - 1;
  SWARMSMITH_ASSERT(bridged.without_frames <= bridged.cycles && bridged.cycles <= cycles,
                    "a cycle is bridged once");
  const double share = static_cast<double>(bridged.cycles) / static_cast<double>(cycles);
  if (share > limits.interpolated_share) {
    const bool is_for_want_of_frames = 2 * bridged.without_frames > bridged.cycles;
    complaints.add(
        IssueCode::Gap,
        fmt::format("was interpolated in {} of {} cycles ({:.1f} %, limit {:.0f} %), in {} of them "
                    "since frames are missing; {}",
                    bridged.cycles, cycles, 100 * share, 100 * limits.interpolated_share,
                    bridged.without_frames,
                    is_for_want_of_frames
                        ? "a faster disk, another codec or 15 to 30 frames/s help"
                        : "more light, larger tags or another place of the camera help"));
  }
  const std::int64_t guessed = guessed_cycles(track, frames, limits);
  SWARMSMITH_ASSERT(guessed <= cycles, "a cycle is guessed once");
  if (guessed == 0 || gaps.empty()) return;
  const auto longest = std::ranges::max_element(gaps, {}, &Gap::length_s);
  complaints.add(IssueCode::Interpolated,
                 fmt::format("has {} across gaps of more than {:.1f} s or at the ends of "
                             "the video",
                             counted(guessed, "cycle"), limits.bridged_gap_s),
                 longest->from_s, longest->to_s);
}

/// A misread tag appears for a moment; a second tag of the same number stays.
std::size_t twins_allowed(const RobotSamples& samples) {
  constexpr std::size_t kPersistent = 10;
  const std::size_t share = (samples.samples.size() + 99) / 100;
  return std::max(kPersistent, share) - 1;
}

void check_twins(const RobotSamples& samples, Complaints& complaints) {
  const std::vector<std::int64_t>& frames = samples.twice;
  if (frames.size() <= twins_allowed(samples)) return;
  complaints.add(IssueCode::DuplicateId,
                 fmt::format("was seen twice in {}, from frame {} to frame {}; in {} of "
                             "them the robot's own could not be identified: take one tag away",
                             counted(frames.size(), "frame"), std::ranges::min(frames),
                             std::ranges::max(frames), samples.twice_unresolved));
}

/// So many samples in a row beyond the walls are a robot, and not a misread tag.
constexpr int kInARow = 3;

/// Returns the largest number of consecutive samples outside.
int check_outside(const std::vector<Sample>& samples, const TrackOptions& options,
                  Complaints& complaints) {
  const double end = instant_s(options.span.cycles);
  int in_a_row = 0;
  int most_in_a_row = 0;
  std::optional<double> first;
  double from = 0;
  double to = 0;
  for (const Sample& sample : samples) {
    if (sample.time_s < 0 || sample.time_s > end) continue;
    if (sample.use == Sample::Use::Used) in_a_row = 0;
    if (sample.use != Sample::Use::Outside) continue;
    if (++in_a_row == 1) from = sample.time_s;
    most_in_a_row = std::max(most_in_a_row, in_a_row);
    if (in_a_row < kInARow) continue;
    if (!first) first = from;
    to = sample.time_s;
  }
  if (!first) return most_in_a_row;
  complaints.add(IssueCode::OutsideArena,
                 fmt::format("was more than {:.2f} m outside of the walls, first at {:.2f} s, last "
                             "at {:.2f} s",
                             options.limits.outside_m, *first, to),
                 *first, to);
  return most_in_a_row;
}

/// Returns the number of dropped samples.
std::int64_t check_outliers(const TrackedRobot& robot, Complaints& complaints) {
  const auto bad_fits = std::ranges::count(robot.samples, Sample::Use::BadFit, &Sample::use);
  if (robot.outliers + bad_fits == 0) return 0;
  complaints.add(IssueCode::Outliers,
                 fmt::format("lost {} samples of {} as outliers and {} as bad fits", robot.outliers,
                             robot.samples.size(), bad_fits));
  return robot.outliers + bad_fits;
}

/// Who marked the robot at these times: "A. Person, B. Person".
std::string who_marked(const std::vector<double>& times_s, const std::vector<HandPoint>& points,
                       const std::string& robot) {
  std::string who;
  for (const HandPoint& point : points) {
    if (point.robot != robot || who.find(point.who) != std::string::npos) continue;
    if (std::ranges::find(times_s, point.time_s) == times_s.end()) continue;
    who += (who.empty() ? "" : ", ") + point.who;
  }
  return who;
}

/// "at 3.00 s", or "from 3.00 s to 4.00 s".
std::string when_text(const std::vector<double>& times_s) {
  const auto [first, last] = std::ranges::minmax(times_s);
  if (first == last) return fmt::format("at {:.2f} s", first);
  return fmt::format("from {:.2f} s to {:.2f} s", first, last);
}

void check_by_hand(const RobotTrack& track, const std::vector<HandPoint>& points,
                   const std::string& robot, Complaints& complaints) {
  const auto add = [&](IssueCode code, const std::vector<double>& times_s, const char* more) {
    if (times_s.empty()) return;
    const auto [first, last] = std::ranges::minmax(times_s);
    complaints.add(
        code,
        fmt::format("was put where a person saw it, {} {} ({}){}", counted(times_s.size(), "time"),
                    when_text(times_s), who_marked(times_s, points, robot), more),
        first, last);
  };
  add(IssueCode::ByHand, track.by_hand_s, "");
  add(IssueCode::FilmOdd, track.unneeded_s,
      ", although a camera saw its tag then: these points by hand change nothing and are not used");
}

void check_cameras(const RobotTrack& track, Complaints& complaints) {
  if (track.disagreeing == 0) return;
  complaints.add(
      IssueCode::CamerasDisagree,
      fmt::format("is seen by cameras more than {:.0f} mm apart in {}, most {:.1f} mm at "
                  "{:.1f} s; check their clocks and calibrate their places again",
                  1000 * kDisagree_m, counted(track.disagreeing, "cycle"),
                  1000 * track.worst_disagreement_m, track.worst_disagreement_at_s));
}

}  // namespace

TrackedRobot tracked_robot(const TaggedRobot& robot, RobotSamples samples, const RobotTrack& track,
                           const FrameReport& frames, const TrackOptions& options,
                           std::vector<Issue>& issues, std::vector<Check>& checks) {
  SWARMSMITH_ASSERT(!track.kinds.empty() && track.kinds.size() == track.sigmas.size(),
                    "the start and each cycle have their kind and their sigma");
  TrackedRobot made{.name = robot.setup.name, .tag = robot.setup.tag, .has_heading = robot.has_yaw};
  made.cycles.assign(track.kinds.begin() + 1, track.kinds.end());
  made.sigmas.assign(track.sigmas.begin() + 1, track.sigmas.end());
  made.mean_scale = samples.scale;
  made.sigma = track.sigma;
  Complaints complaints(robot, issues);
  std::size_t first = issues.size();
  /// Adds a check; its outcome follows from the issues since the last one.
  const auto note = [&](const Question& question, std::optional<double> value,
                        std::optional<double> limit, std::optional<IssueCode> code = {}) {
    checks.push_back(
        answered(question, robot.setup.name, outcome_of(issues, first, code), value, limit));
  };
  const auto next = [&] { first = issues.size(); };
  const TrackLimits& limits = options.limits;
  check_twins(samples, complaints);
  note(kTwins, static_cast<double>(samples.twice.size()),
       static_cast<double>(twins_allowed(samples)), IssueCode::DuplicateId);
  made.samples = std::move(samples.samples);
  double used = 0;
  for (const Sample& sample : made.samples) {
    if (sample.use == Sample::Use::Outlier) ++made.outliers;
    if (sample.use != Sample::Use::Used) continue;
    ++used;
    made.mean_residual_m += sample.residual_m;
  }
  SWARMSMITH_ASSERT(used > 0, "a robot that was never seen is an error before");
  made.mean_residual_m /= used;
  const std::vector<Gap> gaps = gaps_of(track.merged, frames);
  if (!gaps.empty()) {
    const auto longest = std::ranges::max_element(gaps, {}, &Gap::length_s);
    made.longest_gap_s = longest->length_s();
    made.longest_gap_from_s = longest->from_s;
  }
  next();
  check_gaps(gaps, frames, limits, complaints);
  note(kGap, made.longest_gap_s, limits.degraded_gap_s);
  next();
  const int jumps = check_breaks(track, frames, options, complaints);
  note(kJumps, jumps, 0);
  next();
  const std::optional<double> gap_at_end = check_end(track, frames, options, complaints);
  if (options.scored_at_the_end && !frames.covers_the_end) {
    checks.push_back(not_asked(kEnd, robot.setup.name, "the film ends before the run"));
  } else if (options.scored_at_the_end) {
    note(kEnd, gap_at_end, limits.last_instant_gap_s);
  }
  next();
  check_bridged(track, gaps, frames, limits, complaints);
  note(kBridged,
       100 * static_cast<double>(bridged_cycles(track, frames).cycles) /
           static_cast<double>(made.cycles.size()),
       100 * limits.interpolated_share, IssueCode::Gap);
  note(kGuessed, static_cast<double>(guessed_cycles(track, frames, limits)), 0,
       IssueCode::Interpolated);
  next();
  const int most_outside = check_outside(made.samples, options, complaints);
  note(kOutside, most_outside, kInARow - 1);
  next();
  const auto dropped = check_outliers(made, complaints);
  note(kOutliers, 100 * static_cast<double>(dropped) / static_cast<double>(made.samples.size()), 0);
  next();
  check_cameras(track, complaints);
  if (track.compared == 0) {
    checks.push_back(
        not_asked(kCameras, robot.setup.name, "no two cameras saw it at the same time"));
  } else {
    note(kCameras, 1000 * track.worst_disagreement_m, 1000 * kDisagree_m);
  }
  next();
  check_by_hand(track, options.points, robot.setup.name, complaints);
  note(kByHand, static_cast<double>(track.by_hand_s.size()), 0);
  return made;
}

}  // namespace swarmsmith
