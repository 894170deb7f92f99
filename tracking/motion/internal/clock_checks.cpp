#include "tracking/motion/internal/clock_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/assert.h"
#include "base/math.h"
#include "base/median.h"
#include "base/plain_text.h"
#include "tracking/motion/internal/clock_steps.h"
#include "tracking/motion/resampling.h"

namespace swarmsmith {
namespace {

/// Tracking facts, section 7, "AVI": a film may play too fast, and only its length shows it.
constexpr double kLengthTolerance_s = 0.2;
constexpr std::size_t kFewFrames = 20;

Issue issue_of(IssueCode code, std::string text, std::optional<double> from = {},
               std::optional<double> to = {}) {
  return {code, std::move(text), {}, from, to};
}

double mean_interval_s(const std::vector<double>& times) {
  return times.size() < 2 ? 0
                          : (times.back() - times.front()) / static_cast<double>(times.size() - 1);
}

/// The resolution of the times in a container.
double grain_s(const std::vector<double>& times) {
  constexpr double kMillisecond = 1e-3;
  constexpr double kFiner = 1.2e-5;  // a little more than 1/90000 s
  constexpr double kExact = 1e-6;
  const bool are_milliseconds = std::ranges::all_of(times, [](double time) {
    return std::fabs(time - std::round(time / kMillisecond) * kMillisecond) < kExact;
  });
  return are_milliseconds ? kMillisecond : kFiner;
}

void check_repeats(const FilmedCamera& film, Findings& findings) {
  const Repeats& repeats = film.repeats;
  const double start = film.camera.start_s;
  constexpr double kShare = 0.05;
  const auto frames = static_cast<double>(film.record.frame_times.size());
  const double share = frames > 0 ? static_cast<double>(repeats.count) / frames : 0;
  Check check{.name = "repeated pictures",
              .subject = film.camera.name,
              .value = 100 * share,
              .limit = 100 * kShare,
              .unit = "%",
              .catches = "a recorder that hangs, or shows pictures twice"};
  if (film.tags.empty()) {
    check.outcome = Check::Outcome::NotRun;
    check.reason = "it saw no robot";
    return findings.add(std::move(check));
  }
  std::optional<Issue> issue;
  for (const ClockSpan& span : repeats.frozen) {
    // Before and after the run a recorder may hang.
    if (span.from_s - start > film.duration_s || span.to_s < start) continue;
    if (issue) findings.issues.push_back(std::move(*issue));
    issue =
        issue_of(IssueCode::PicturesRepeated,
                 fmt::format("camera {} shows {} from {:.2f} s to {:.2f} s, while robots moved on: "
                             "its recorder hung; the copies are not samples",
                             film.camera.name,
                             span.is_loop ? "the same few pictures over and over" : "one picture",
                             span.from_s - start, span.to_s - start),
                 span.from_s - start, span.to_s - start);
  }
  // Standing robots at the end of a film look like a recorder that hangs: a doubt, not a fault.
  const double doubtful = repeats.doubtful_from_s.value_or(start) - start;
  if (!issue && repeats.doubtful_from_s && doubtful < film.duration_s - kSameInstant_s) {
    issue = issue_of(IssueCode::PicturesRepeated,
                     fmt::format("camera {} shows nothing that moves from {:.2f} s to the film's "
                                 "end, as if its recorder hung; look at the film, and record more "
                                 "than the run",
                                 film.camera.name, doubtful),
                     doubtful, film.duration_s);
  }
  if (!issue && share > kShare) {
    issue = issue_of(
        IssueCode::PicturesRepeated,
        fmt::format("{} of the {:.0f} pictures of camera {} show the one before once more ({:.1f} "
                    "%, limit {:.0f} %) and are not samples: the recorder wrote more pictures than "
                    "the camera took, so that times may be late; record at the camera's own rate",
                    repeats.count, frames, film.camera.name, 100 * share, 100 * kShare));
  }
  findings.add(std::move(check), std::move(issue));
}

/// Whether a length is given and agrees with the film.
bool check_length(const FilmedCamera& film, Findings& findings) {
  const std::vector<double>& times = film.record.frame_times;
  Check check{.name = "length of the film",
              .subject = film.camera.name,
              .limit = kLengthTolerance_s,
              .unit = "s",
              .catches = "a film that plays too fast or too slowly"};
  if (!film.length_s || times.empty()) {
    check.outcome = Check::Outcome::NotRun;
    check.reason = "the run log says no `length`";
    findings.add(std::move(check));
    return false;
  }
  // The last picture lasts for one interval, too.
  const double length = times.back() - times.front() + mean_interval_s(times);
  const double off = length - *film.length_s;
  check.value = std::fabs(off);
  if (std::fabs(off) <= kLengthTolerance_s) {
    findings.add(std::move(check));
    return true;
  }
  const double speed = *film.length_s / length;
  findings.add(
      std::move(check),
      issue_of(IssueCode::Duration,
               fmt::format("{} lasts {:.2f} s and the run log says {:.2f} s (limit {:.1f} "
                           "s): it plays {:.3g} times as fast as the camera filmed. If "
                           "frames were dropped or counted, give the camera's times as a "
                           "sidecar; if the stopwatch was wrong, mend `length`",
                           film.record.file, length, *film.length_s, kLengthTolerance_s, speed)));
  return false;
}

void check_counting(const FilmedCamera& film, bool length_agrees, Findings& findings) {
  Check check{.name = kClockOfTheFilm,
              .subject = film.camera.name,
              .unit = "frames/s",
              .catches = "a recorder that counts frames at another rate than the camera's"};
  // A sidecar has the camera's own times (docs/tracking.md, "Videos and time").
  if (film.record.time_source == TimeSource::Sidecar) return findings.add(std::move(check));
  const auto period = counted_period_s(film.record.frame_times);
  // Times that are not multiples of one period were read from a clock.
  if (!period && film.record.time_source != TimeSource::FrameRate) {
    return findings.add(std::move(check));
  }
  const double rate = 1 / period.value_or(std::max(mean_interval_s(film.record.frame_times), 1e-9));
  check.value = rate;
  // A second clock confirms the counted one. Robots' logs may do this later (`kClockOfTheFilm`).
  if (length_agrees) return findings.add(std::move(check));
  findings.add(
      std::move(check),
      issue_of(IssueCode::ClockCounted,
               fmt::format("the times of {} are multiples of 1/{:.6g} s: its recorder counted "
                           "frames, and no clock says that {:.6g} a second were taken. Write how "
                           "long the camera ran, by another clock, as `length` into the run log, "
                           "or record with `track record`, which keeps the time of each frame",
                           film.record.file, rate, rate)));
}

void check_order(const FilmedCamera& film, const ClockSteps& steps, Findings& findings) {
  constexpr int kMost = 1;
  Check check{.name = "order of the pictures",
              .subject = film.camera.name,
              .value = static_cast<double>(steps.backwards),
              .limit = kMost,
              .unit = "",
              .catches = "a film with its pictures in the wrong order"};
  if (!steps.reason.empty()) {
    check.outcome = Check::Outcome::NotRun;
    check.value.reset();
    check.reason = steps.reason;
  }
  if (steps.backwards <= kMost) return findings.add(std::move(check));
  findings.add(std::move(check),
               issue_of(IssueCode::Timestamps,
                        fmt::format("pictures of camera {} are out of order: at {} places all "
                                    "robots that move go back at once, first at {:.2f} s of the "
                                    "run; copy the film again from the camera",
                                    film.camera.name, steps.backwards, steps.backwards_at_s),
                        steps.backwards_at_s, steps.backwards_at_s));
}

void check_steps(const FilmedCamera& film, Findings& findings) {
  const ClockSteps steps = clock_steps(film);
  check_order(film, steps, findings);
  // docs/tracking.md, "Is the clock right?".
  constexpr double kLimit_s = 0.15;
  Check check{
      .name = "steps of the clock",
      .subject = film.camera.name,
      .value = steps.most_off_s,
      .limit = kLimit_s,
      .unit = "s",
      .catches = "a clock that was set during the run, or frames lost by a recorder that counts"};
  if (!steps.reason.empty()) {
    check.outcome = Check::Outcome::NotRun;
    check.value.reset();
    check.reason = steps.reason;
  }
  if (steps.most_off_s <= kLimit_s) return findings.add(std::move(check));
  const ClockStep& worst = steps.worst;
  const std::string text =
      worst.lost_s > 0
          ? fmt::format(
                "the clock of camera {} lost {:.2f} s at {:.2f} s of the run: pictures "
                "before and after are {:.2f} s apart by it, and {:.2f} s of driving",
                film.camera.name, worst.lost_s, worst.at_s, worst.between_s, worst.driving_s())
          : fmt::format(
                "the clock of camera {} jumped ahead by {:.2f} s at {:.2f} s of the run: "
                "pictures before and after are {:.2f} s of driving apart",
                film.camera.name, -worst.lost_s, worst.at_s, worst.driving_s());
  findings.add(
      std::move(check),
      issue_of(IssueCode::ClockStep,
               text + fmt::format(" ({}, together up to {:.2f} s off, limit "
                                  "{:.2f} s); was a clock set, or were frames lost while "
                                  "they were counted? Give the camera's own times",
                                  counted(steps.count, "such place"), steps.most_off_s, kLimit_s),
               worst.at_s, worst.at_s));
}

/// The speed that a robot exceeds in a tenth of its samples, and the turning speed that it exceeds
/// in a fiftieth.
struct Fastest {
  double speed_m_s = 0;
  double turn_rad_s = 0;
};

/// Not the largest value, which a single wrong sample would determine. 0 for too few values.
double high_one(std::vector<double>& values, double share) {
  SWARMSMITH_ASSERT(share >= 0 && share <= 1, "a share of the values is smaller");
  if (values.size() < kFewFrames) return 0;
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, place);
  return *place;
}

Fastest fastest_of(const TrackedRobot& robot, double duration_s) {
  constexpr double kWay_s = 0.5;
  constexpr double kTurn_s = 0.3;
  std::vector<double> speeds;
  std::vector<double> turns;
  std::vector<const Sample*> used;
  for (const Sample& sample : robot.samples) {
    // Of one camera only: a difference between two cameras' positions would look like a speed.
    if (sample.use == Sample::Use::Used && sample.camera == robot.samples.front().camera &&
        sample.time_s >= 0 && sample.time_s <= duration_s) {
      used.push_back(&sample);
    }
  }
  std::size_t way = 0;
  std::size_t turn = 0;
  double turned = 0;  // turned since `turn`
  for (std::size_t i = 1; i < used.size(); ++i) {
    // Summed frame by frame: the difference over a longer time is ambiguous beyond half a turn.
    turned += wrap_angle(used[i]->pose.theta - used[i - 1]->pose.theta);
    const double now = used[i]->time_s;
    const auto take = [&](std::size_t first, double span_s) {
      // A long time without samples gives only a mean speed, so it is left out.
      return now - used[first]->time_s >= span_s && now - used[first]->time_s < 2 * span_s;
    };
    if (take(way, kWay_s)) {
      speeds.push_back(
          std::hypot(used[i]->pose.x - used[way]->pose.x, used[i]->pose.y - used[way]->pose.y) /
          (now - used[way]->time_s));
    }
    if (take(turn, kTurn_s)) turns.push_back(std::fabs(turned) / (now - used[turn]->time_s));
    while (now - used[way]->time_s >= kWay_s)
      ++way;
    while (now - used[turn]->time_s >= kTurn_s) {
      turned -= wrap_angle(used[turn + 1]->pose.theta - used[turn]->pose.theta);
      ++turn;
    }
  }
  return {high_one(speeds, 0.9), high_one(turns, 0.98)};
}

}  // namespace

void Findings::add(Check check, std::optional<Issue> issue) {
  if (issue && check.outcome == Check::Outcome::Passed) {
    check.outcome = is_error(issue->code) ? Check::Outcome::Failed : Check::Outcome::Warned;
  }
  checks.push_back(std::move(check));
  if (issue) issues.push_back(std::move(*issue));
}

std::optional<double> counted_period_s(const std::vector<double>& times) {
  constexpr double kSince1970_s = 1e8;
  // Times since 1970 come from a clock: a recorder that counts begins near 0.
  if (times.size() < kFewFrames || times.front() > kSince1970_s) return std::nullopt;
  std::vector<double> intervals;
  for (std::size_t i = 1; i < times.size(); ++i)
    intervals.push_back(times[i] - times[i - 1]);
  const double grain = grain_s(times);
  double period = upper_median(std::move(intervals));
  // Otherwise every time would be close to a multiple of the period.
  if (!(period > 2 * grain)) return std::nullopt;
  // Each further frame makes the period more precise.
  double turns = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double since = times[i] - times[i - 1];
    const double more = std::round(since / period);
    // An interval may be several periods: then frames are missing.
    if (more < 1 || std::fabs(since - more * period) > 2 * grain + 0.01 * more * period)
      return std::nullopt;
    turns += more;
    if (i > kFewFrames / 2) period = (times[i] - times.front()) / turns;
  }
  // With the final period, all times must lie on one grid: many small errors in one direction do
  // not.
  turns = 0;
  double least = 0;
  double most = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    turns += std::round((times[i] - times[i - 1]) / period);
    const double off = times[i] - times.front() - turns * period;
    least = std::min(least, off);
    most = std::max(most, off);
  }
  // Rounding shifts each time by at most half the resolution; the first and the last time tilt the
  // grid.
  return most - least <= 2 * grain + 1e-6 ? std::optional(period) : std::nullopt;
}

void check_clock(const FilmedCamera& film, Findings& findings) {
  check_repeats(film, findings);
  const bool length_agrees = check_length(film, findings);
  check_counting(film, length_agrees, findings);
  check_steps(film, findings);
}

void check_speeds(const std::vector<TrackedRobot>& robots, const TrackLimits& limits,
                  double duration_s, Findings& findings) {
  std::vector<double> shares;
  for (const TrackedRobot& robot : robots) {
    const Fastest fastest = fastest_of(robot, duration_s);
    // A robot that only turns shows the speed of the film, too.
    shares.push_back(std::max(fastest.speed_m_s / limits.driving_speed_m_s,
                              fastest.turn_rad_s / limits.driving_turn_rad_s));
  }
  std::ranges::sort(shares, std::greater());
  constexpr double kLimit = 1.15;
  Check check{.name = "speed of the robots",
              .value = shares.empty() ? 0 : shares[std::min<std::size_t>(1, shares.size() - 1)],
              .limit = kLimit,
              .unit = "of the fastest that they can",
              .catches = "a film that plays too fast"};
  if (*check.value <= 0) {
    check.outcome = Check::Outcome::NotRun;
    check.value.reset();
    check.reason = "robots did not move";
    return findings.add(std::move(check));
  }
  if (*check.value <= kLimit) return findings.add(std::move(check));
  const double value = *check.value;
  findings.add(
      std::move(check),
      issue_of(
          limits.knows_driving_speed ? IssueCode::FilmTooFast : IssueCode::FilmSpeed,
          fmt::format("robots drive and turn at up to {:.2f} times the fastest that they can "
                      "({:.2f} m/s, {:.1f} rad/s; limit {:.2f} times): the film plays too "
                      "fast, or the robots are faster than the mission's. Give the camera's own "
                      "times as a sidecar, or `length`, and the robots' logs; or give the "
                      "mission's robot its own `max_speed`",
                      value, limits.driving_speed_m_s, limits.driving_turn_rad_s, kLimit)));
}

}  // namespace swarmsmith
