#include "tracking/motion/internal/robot_travel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "base/assert.h"
#include "base/math.h"
#include "base/overloaded.h"
#include "tracking/geometry/walls.h"

namespace swarmsmith {
namespace {

constexpr double kDegree = kPi / 180;
/// The heading from a straight run is more precise than this.
constexpr double kHeading_rad = 5 * kDegree;
/// Error of a place on the floor: an offset with this error changes the grid exploration score by
/// less than a percent (tracking facts, section 5).
constexpr double kPlace_m = 0.010;
/// An error is harmless if it moves no place by more than a calibration may
/// (PlaceLimits::left_out_m).
constexpr double kHarmless_m = 0.005;
/// Walls give way, and survey and height have errors, by about this distance.
constexpr double kTouch_m = 0.03;
/// A robot that drives backwards for this share of its distance may really drive ahead, with its
/// tag turned by 180 degrees.
constexpr double kMostlyBackwards = 0.9;

/// The radius of the circle around a body.
double reach_of(const Outline& outline) {
  return std::visit(
      Overloaded{[](const CircleOutline& circle) { return circle.radius_m; },
                 [](const BoxOutline& box) { return 0.5 * hypot(box.length_m, box.width_m); },
                 [](const PolygonOutline& polygon) {
                   double reach = 0;
                   for (const Point& corner : polygon.corners)
                     reach = std::max(reach, hypot(corner.x, corner.y));
                   return reach;
                 }},
      outline);
}

/// The poses of all robots at the end of a cycle; 0 is the start.
std::span<const Pose> poses_at(const TrackedRun& run, int cycle) {
  return cycle == 0 ? std::span<const Pose>(run.starts) : run.trajectory.at(cycle - 1);
}

bool touches(const std::span<const Pose> poses, std::size_t robot, const Arena& arena,
             double reach_m) {
  SWARMSMITH_ASSERT(robot < poses.size(), "each robot has a pose at each instant");
  const Point at = poses[robot].position();
  if (distance_to_walls(arena, at) < reach_m + kTouch_m) return true;
  for (const Obstacle& obstacle : arena.obstacles) {
    if (hypot(at.x - obstacle.pose.x, at.y - obstacle.pose.y) <
        reach_m + reach_of(obstacle.outline) + kTouch_m)
      return true;
  }
  for (std::size_t other = 0; other < poses.size(); ++other) {
    if (other != robot &&
        hypot(at.x - poses[other].x, at.y - poses[other].y) < 2 * reach_m + kTouch_m)
      return true;
  }
  return false;
}

/// A robot that gains or loses speed continues in its old direction for a moment.
void mark_unsteady(std::vector<TravelStep>& steps, double sigma_m) {
  constexpr double kSteady_m = 0.0015;
  constexpr double kSigmas = 4;
  const auto way = [&](std::size_t i) { return hypot(steps[i].ahead_m, steps[i].aside_m); };
  for (std::size_t i = 1; i < steps.size(); ++i) {
    if (std::fabs(way(i) - way(i - 1)) <= kSteady_m + kSigmas * sigma_m) continue;
    steps[i].is_steady = false;
    steps[i - 1].is_steady = false;
  }
}

std::vector<TravelStep> steps_of(const TrackedRun& run, const RobotTrack& track, std::size_t robot,
                                 const Arena& arena, double reach_m) {
  std::vector<TravelStep> steps;
  const int cycles = run.trajectory.instants();
  SWARMSMITH_ASSERT(track.kinds.size() == static_cast<std::size_t>(cycles) + 1 &&
                        track.sigmas.size() == track.kinds.size(),
                    "the start and each cycle have their kind and their sigma");
  // A body that was pushed slides until friction has stopped it.
  constexpr int kSlides = 10;
  int touched = touches(poses_at(run, 0), robot, arena, reach_m) ? 0 : -kSlides - 1;
  for (int cycle = 1; cycle <= cycles; ++cycle) {
    const int touched_before = touched;
    if (touches(poses_at(run, cycle), robot, arena, reach_m)) touched = cycle;
    const auto i = static_cast<std::size_t>(cycle);
    const CycleKind kind = std::max(track.kinds[i - 1], track.kinds[i]);
    // In a longer gap the robot may have turned away and back.
    if (kind > CycleKind::Interpolated) continue;
    const Pose& from = poses_at(run, cycle - 1)[robot];
    const Pose& to = poses_at(run, cycle)[robot];
    const double turn = wrap_angle(to.theta - from.theta);
    const SinCos half_way = sin_cos(from.theta + 0.5 * turn);
    const double dx = to.x - from.x;
    const double dy = to.y - from.y;
    const double sigma = kind == CycleKind::Measured
                             ? 0
                             : hypot(track.sigmas[i - 1].sigma_m, track.sigmas[i].sigma_m);
    steps.push_back({.from_s = instant_s(cycle - 1),
                     .to_s = instant_s(cycle),
                     .ahead_m = dx * half_way.cos + dy * half_way.sin,
                     .aside_m = dy * half_way.cos - dx * half_way.sin,
                     .turn_rad = turn,
                     .turn_sigma_rad = 1.5 * track.sigma.sigma_rad,
                     .noise_m = hypot(1.5 * track.noise_m, sigma),
                     .sigma_m = sigma,
                     .touches = cycle - std::max(touched, touched_before) <= kSlides});
  }
  mark_unsteady(steps, track.noise_m);
  return steps;
}

/// The measured error of a robot whose tag is not where it was calibrated.
struct Misplaced {
  double turned_rad = 0;
  double ahead_m = 0;  ///< of the measured point, ahead of the true centre
  double aside_m = 0;  ///< to the left of the centre
  double off_m = 0;    ///< distance from the centre
};

/// The robot's own tag was put back at the same place, but turned.
Misplaced if_turned(const TagOffset& own, double turned_rad) {
  const SinCos turn = sin_cos(turned_rad);
  const SinCos yaw = sin_cos(own.yaw_rad);
  const double x = own.x_m - (turn.cos * own.x_m - turn.sin * own.y_m);
  const double y = own.y_m - (turn.sin * own.x_m + turn.cos * own.y_m);
  return {turned_rad, yaw.cos * x - yaw.sin * y, yaw.sin * x + yaw.cos * y, hypot(x, y)};
}

/// The robot's tag is on another robot, at the place of that robot's tag.
Misplaced if_exchanged(const TagOffset& own, const TagOffset& others) {
  const SinCos yaw = sin_cos(others.yaw_rad);
  const double x = others.x_m - own.x_m;
  const double y = others.y_m - own.y_m;
  return {wrap_angle(others.yaw_rad - own.yaw_rad), yaw.cos * x - yaw.sin * y,
          yaw.sin * x + yaw.cos * y, hypot(x, y)};
}

/// Limit of the error of a place on the floor, including its uncertainty.
double place_limit(const TravelFit& fit) {
  return kPlace_m + 3 * fit.place_sigma_m;
}

bool explains(const Misplaced& guess, const TravelFit& fit) {
  return std::fabs(wrap_angle(guess.turned_rad - fit.turned_rad)) < kHeading_rad &&
         (!fit.knows_place ||
          hypot(guess.ahead_m - fit.ahead_m, guess.aside_m - fit.aside_m) < place_limit(fit));
}

std::string degrees(double radians) {
  return fmt::format("{:.0f} degrees", radians / kDegree);
}

/// Judges the tag and the travel of one robot.
class Case {
 public:
  Case(const std::vector<TaggedRobot>& robots, const std::vector<TravelFit>& fits,
       std::size_t number, TrackedRun& run)
      : robots_(robots),
        fits_(fits),
        number_(number),
        robot_(robots[number]),
        fit_(fits[number]),
        run_(run) {}

  void judge_heading() {
    Check check{.name = "travel against heading",
                .subject = robot_.setup.name,
                .limit = kHeading_rad / kDegree,
                .unit = "degrees",
                .catches = "a tag that was turned, or put on another robot"};
    if (!robot_.has_yaw) return skip(std::move(check), "no straight run was filmed");
    if (!fit_.knows_heading) return skip(std::move(check), kTooLittle);
    const double off = std::fabs(fit_.turned_rad);
    const bool backwards = kPi - off <= kHeading_rad;
    check.value = (backwards ? kPi - off : off) / kDegree;
    if (backwards) {
      judge_backwards(std::move(check));
    } else if (off > kHeading_rad) {
      const Misplaced turned = if_turned(robot_.offset, fit_.turned_rad);
      accuse(std::move(check), turned.off_m > kHarmless_m || !robot_.has_offset,
             fmt::format("travels {} beside its heading, all over the run (limit {})", degrees(off),
                         degrees(kHeading_rad)),
             turned);
    } else {
      run_.checks.push_back(std::move(check));
    }
  }

  /// Compares the measured point with the point about which the robot turns, as in its spin.
  void judge_place() {
    Check check{.name = "tag against the treads",
                .subject = robot_.setup.name,
                .limit = {},
                .unit = "mm",
                .catches = "a tag that is not where it was calibrated"};
    if (!robot_.has_offset) return skip(std::move(check), "its tag was taken for its centre");
    if (!fit_.knows_place)
      return skip(std::move(check), "it turned too little on the spot where it touched nothing");
    const double off = hypot(fit_.ahead_m, fit_.aside_m);
    check.value = 1000 * off;
    check.limit = 1000 * place_limit(fit_);
    const bool is_off = off > place_limit(fit_);
    if (!is_off || is_accused_) {
      if (is_off) check.outcome = Check::Outcome::Failed;
      return run_.checks.push_back(std::move(check));
    }
    // This is no proof: a robot with a tread that slips or does not move turns about another point,
    // too.
    check.outcome = Check::Outcome::Warned;
    run_.checks.push_back(std::move(check));
    add(IssueCode::TagPlaceDoubtful,
        fmt::format("turns on the spot about a point {:.0f} mm {} where its offset puts its centre "
                    "(limit {:.0f} mm): its tag sits otherwise than calibrated, or one of its "
                    "treads slips; look at the tag, or calibrate the robot again",
                    1000 * off, side_of_pivot(), 1000 * place_limit(fit_)));
  }

  void judge_slide(const std::vector<TravelStep>& steps) {
    Check check{.name = "way to the side",
                .subject = robot_.setup.name,
                .limit = {},
                .unit = "mm",
                .catches = "a robot that was pushed or carried"};
    const std::optional<Slide> worst = worst_slide(steps, fit_);
    if (!worst) return skip(std::move(check), "it stood still, or touched something all the time");
    check.value = 1000 * std::fabs(worst->aside_m);
    check.limit = 1000 * worst->limit_m;
    if (std::fabs(worst->aside_m) <= worst->limit_m) return run_.checks.push_back(std::move(check));
    constexpr double kProven = 2;
    const bool is_proven = std::fabs(worst->aside_m) > kProven * worst->limit_m;
    check.outcome = is_proven ? Check::Outcome::Failed : Check::Outcome::Warned;
    run_.checks.push_back(std::move(check));
    add(is_proven ? IssueCode::Pushed : IssueCode::PushedDoubtful,
        fmt::format("went {:.0f} mm to the side from {:.1f} s to {:.1f} s (limit {:.0f} mm), which "
                    "treads cannot, and nothing touched it: it was pushed or carried, or its tag "
                    "came loose; leave robots alone and film the run again",
                    1000 * std::fabs(worst->aside_m), worst->from_s, worst->to_s,
                    1000 * worst->limit_m),
        worst->from_s, worst->to_s);
  }

 private:
  static constexpr const char* kTooLittle =
      "it drove and turned too little where it touched nothing";

  std::string side_of_pivot() const {
    if (std::fabs(fit_.ahead_m) >= std::fabs(fit_.aside_m))
      return fit_.ahead_m > 0 ? "behind" : "ahead of";
    return fit_.aside_m > 0 ? "to the right of" : "to the left of";
  }

  void skip(Check check, const char* reason) {
    check.outcome = Check::Outcome::NotRun;
    check.reason = reason;
    run_.checks.push_back(std::move(check));
  }

  void add(IssueCode code, const std::string& text, std::optional<double> from = {},
           std::optional<double> to = {}) {
    run_.issues.push_back({code,
                           fmt::format("{} (tag {}) {}", robot_.setup.name, robot_.setup.tag, text),
                           robot_.setup.name, from, to});
  }

  /// The robot drives backwards, or ahead with its tag turned by 180 degrees. The point about which
  /// it turns shows which, unless the tag is over the midpoint of the treads.
  void judge_backwards(Check check) {
    const Misplaced turned = if_turned(robot_.offset, kPi);
    const bool is_told = fit_.knows_place && turned.off_m > place_limit(fit_);
    // `fit_` has the axes of a robot that drives ahead.
    const bool is_turned =
        is_told && hypot(fit_.ahead_m - turned.ahead_m, fit_.aside_m - turned.aside_m) <
                       hypot(fit_.ahead_m, fit_.aside_m);
    if (is_turned) {
      return accuse(std::move(check), true,
                    "drives backwards, and turns about another point than its offset says", turned);
    }
    const bool is_harmless = turned.off_m <= kHarmless_m && robot_.has_offset;
    if (is_told || is_harmless || fit_.backward_share < kMostlyBackwards)
      return run_.checks.push_back(std::move(check));
    check.outcome = Check::Outcome::Warned;
    run_.checks.push_back(std::move(check));
    add(IssueCode::HeadingOff,
        fmt::format("drives backwards in {:.0f} % of its way: if it cannot, its tag is turned by "
                    "180 degrees, and its centre is {:.0f} mm off; look at the film",
                    100 * fit_.backward_share, 1000 * turned.off_m));
  }

  void accuse(Check check, bool moves_places, const std::string& what, const Misplaced& turned) {
    is_accused_ = true;
    check.outcome = moves_places ? Check::Outcome::Failed : Check::Outcome::Warned;
    run_.checks.push_back(std::move(check));
    add(moves_places ? IssueCode::TagTurned : IssueCode::HeadingOff,
        what + ": " + cause(turned) +
            (moves_places ? "; put it back as it was calibrated and film the run again, or "
                            "calibrate the robot as it is and `rescore`"
                          : "; positions are right, headings are not; calibrate the robot again"));
  }

  std::string cause(const Misplaced& turned) const {
    for (std::size_t other = 0; other < robots_.size(); ++other) {
      if (other == number_ || !robots_[other].has_yaw || !fits_[other].knows_heading) continue;
      const TagOffset& others = robots_[other].offset;
      if (explains(if_exchanged(robot_.offset, others), fit_) &&
          explains(if_exchanged(others, robot_.offset), fits_[other])) {
        return fmt::format(
            "it moves as {} would with this tag, and {} as this one: their tags "
            "were exchanged",
            robots_[other].setup.name, robots_[other].setup.name);
      }
    }
    if (std::fabs(turned.turned_rad) > kHeading_rad && explains(turned, fit_)) {
      return fmt::format(
          "its tag is turned by {} since it was calibrated, which puts its centre "
          "{:.0f} mm off",
          degrees(turned.turned_rad), 1000 * turned.off_m);
    }
    return "its tag sits otherwise than calibrated, or is that of another robot";
  }

  const std::vector<TaggedRobot>& robots_;
  const std::vector<TravelFit>& fits_;
  std::size_t number_;
  const TaggedRobot& robot_;
  const TravelFit& fit_;
  TrackedRun& run_;
  bool is_accused_ = false;
};

/// Bodies skid in their old direction after they turn; they skid before they turn only if the film
/// runs backwards.
void judge_direction(const std::vector<TravelFit>& fits, TrackedRun& run) {
  constexpr double kSigmas = 5;
  constexpr double kLeastSkid = 0.1;
  int told = 0;
  int backwards = 0;
  for (const TravelFit& fit : fits) {
    if (!fit.knows_heading || fit.skid_sigma <= 0) continue;
    ++told;
    const bool drives_backwards =
        kPi - std::fabs(fit.turned_rad) <= kHeading_rad && fit.backward_share >= kMostlyBackwards;
    if (drives_backwards && fit.skid > std::max(kLeastSkid, kSigmas * fit.skid_sigma)) ++backwards;
  }
  Check check{.name = "direction of time",
              .value = backwards,
              .limit = 1,
              .unit = "robots",
              .catches = "a film that runs backwards"};
  if (told == 0) {
    check.outcome = Check::Outcome::NotRun;
    check.value.reset();
    check.reason = "no robot drove and turned enough where it touched nothing";
  }
  const bool is_reversed = backwards >= 2 && backwards == told;
  if (is_reversed) {
    check.outcome = Check::Outcome::Failed;
    run.issues.push_back({IssueCode::Timestamps,
                          fmt::format("all {} robots drive backwards, and skid before they turn: "
                                      "the film runs backwards",
                                      backwards)});
  }
  run.checks.push_back(std::move(check));
}

}  // namespace

void judge_travel(const std::vector<TaggedRobot>& robots, const std::vector<RobotTrack>& tracks,
                  const Arena& arena, const TrackOptions& options, TrackedRun& run) {
  SWARMSMITH_ASSERT(robots.size() == tracks.size(), "each robot has its track");
  const double reach = reach_of(options.body);
  std::vector<std::vector<TravelStep>> steps;
  std::vector<TravelFit> fits;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    steps.push_back(steps_of(run, tracks[i], i, arena, reach));
    fits.push_back(fit_travel(steps.back()));
  }
  for (std::size_t i = 0; i < robots.size(); ++i) {
    Case one(robots, fits, i, run);
    one.judge_heading();
    one.judge_place();
    one.judge_slide(steps[i]);
  }
  judge_direction(fits, run);
}

}  // namespace swarmsmith
