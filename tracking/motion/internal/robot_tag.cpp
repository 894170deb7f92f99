#include "tracking/motion/internal/robot_tag.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "base/assert.h"
#include "base/math.h"
#include "base/median.h"

namespace swarmsmith {
namespace {

constexpr double kDegree = kPi / 180;
/// Limits of the lean: the tag of the robot is 10 mm off (as much as an offset may be).
constexpr double kLean_m = 0.010;
constexpr double kLeastTilt_rad = 2.5 * kDegree;
constexpr double kMostTilt_rad = 8 * kDegree;

double tilt_limit(const RobotSetup& robot) {
  return std::clamp(std::atan2(kLean_m, robot.height_m), kLeastTilt_rad, kMostTilt_rad);
}

/// The shear of a sighting, and its position.
struct Shear {
  std::complex<double> place;   ///< from the point below the camera, over its height above the tag
  std::complex<double> strain;  ///< strain of the square, in the world's axes
  double heading = 0;           ///< heading of the tag
};

std::optional<Shear> shear_of(const View& view, const TagCorners& corners, double edge_m,
                              double height_m) {
  const std::vector<Point> found = on_plane(view, corners, height_m);
  // The square of the coordinates along each axis sums to 1, so the sums below are the
  // least-squares matrix from the tag's frame to the floor.
  constexpr std::array<Point, 4> kModel{{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}};
  Point middle;
  for (const Point& point : found) {
    middle.x += point.x / 4;
    middle.y += point.y / 4;
  }
  double xx = 0;
  double xy = 0;
  double yx = 0;
  double yy = 0;
  for (std::size_t i = 0; i < kModel.size(); ++i) {
    xx += (found[i].x - middle.x) * kModel[i].x / edge_m;
    xy += (found[i].x - middle.x) * kModel[i].y / edge_m;
    yx += (found[i].y - middle.y) * kModel[i].x / edge_m;
    yy += (found[i].y - middle.y) * kModel[i].y / edge_m;
  }
  Shear shear;
  // The heading of the rigid fit (tracking facts, section 4).
  shear.heading = std::atan2(yx - xy, xx + yy);
  // After the rotation by the heading is removed, the matrix is symmetric.
  const double c = std::cos(shear.heading);
  const double s = std::sin(shear.heading);
  const double left = (xx * c - xy * s) - (yx * s + yy * c);
  const double cross = (yx * c - yy * s) + (xx * s + xy * c);
  // The part without a trace: a wrong edge or height stretches both axes alike and does not appear
  // in it.
  shear.strain = {0.5 * left, 0.5 * cross};
  const Point3 centre = view.place.centre();
  shear.place =
      std::complex<double>(middle.x - centre.x, middle.y - centre.y) / (centre.z - height_m);
  if (!std::isfinite(std::abs(shear.strain)) || !std::isfinite(std::abs(shear.place)))
    return std::nullopt;
  return shear;
}

/// The scale of the floor tags in the run; light and print change the scale of all tags alike. 1 if
/// fewer than two were seen.
double floor_scale(const Observations& observations, std::span<const TrackedCamera> cameras,
                   const Rig& rig) {
  constexpr double kPlausible = 0.03;
  SWARMSMITH_ASSERT(cameras.size() == observations.cameras.size(), "each camera has its record");
  std::vector<double> scales;
  std::vector<int> tags;
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    for (const ReferenceLook& look : observations.cameras[c].references) {
      const auto tag = std::ranges::find(rig.references, look.tag, &ReferenceTag::tag);
      if (tag == rig.references.end()) continue;
      const double scale = tag_pose(cameras[c].view, look.corners, tag->edge_m, 0).scale;
      if (!std::isfinite(scale)) continue;
      scales.push_back(scale);
      if (std::ranges::find(tags, look.tag) == tags.end()) tags.push_back(look.tag);
    }
  }
  // One tag may have another edge than declared.
  if (tags.size() < 2) return 1;
  const double scale = upper_median(std::move(scales));
  // A larger deviation is not taken over to the robots' scales.
  return std::fabs(scale - 1) < kPlausible ? scale : 1;
}

/// Two cameras see a robot at the same time. Returns the difference of their positions along the
/// line between the points below the cameras, divided by the length of this line: 1 - scale if the
/// height is wrong, 0 if the edge is wrong.
std::optional<double> stretch_between(std::span<const Sample> samples, const Point& foot_a,
                                      const Point& foot_b, int a, int b) {
  constexpr double kNear_s = 0.15;
  constexpr int kLeast = 20;
  const double dx = foot_a.x - foot_b.x;
  const double dy = foot_a.y - foot_b.y;
  SWARMSMITH_ASSERT(dx != 0 || dy != 0, "only cameras that hang apart are compared");
  const Sample* before = nullptr;
  const Sample* between = nullptr;
  double sum = 0;
  int count = 0;
  for (const Sample& sample : samples) {
    if (sample.use != Sample::Use::Used) continue;
    if (sample.camera == b) between = &sample;
    if (sample.camera != a) continue;
    const bool has_pair =
        before != nullptr && between != nullptr && between->time_s >= before->time_s &&
        sample.time_s - before->time_s < kNear_s && sample.time_s > before->time_s;
    if (has_pair) {
      // The robot moves between two frames, so the positions from one camera are interpolated to
      // the time of the other.
      const double share = (between->time_s - before->time_s) / (sample.time_s - before->time_s);
      const double x = before->pose.x + share * (sample.pose.x - before->pose.x);
      const double y = before->pose.y + share * (sample.pose.y - before->pose.y);
      sum += ((x - between->pose.x) * dx + (y - between->pose.y) * dy) / (dx * dx + dy * dy);
      ++count;
    }
    before = &sample;
  }
  if (count < kLeast) return std::nullopt;
  return sum / count;
}

enum class Cause { Open, Height, Edge };

/// Whether height or edge is wrong, if two cameras see the robot from places far enough apart.
Cause cause_of(std::span<const Sample> samples, double scale,
               std::span<const TrackedCamera> cameras) {
  // If the height is wrong, the cameras differ by this or more; a smaller difference could have
  // other causes.
  constexpr double kTold_m = 0.010;
  for (std::size_t a = 0; a < cameras.size(); ++a) {
    for (std::size_t b = a + 1; b < cameras.size(); ++b) {
      const Point3 at = cameras[a].view.place.centre();
      const Point3 other = cameras[b].view.place.centre();
      if (std::fabs(1 - scale) * hypot(at.x - other.x, at.y - other.y) < kTold_m) continue;
      const auto stretch = stretch_between(samples, {at.x, at.y}, {other.x, other.y},
                                           static_cast<int>(a), static_cast<int>(b));
      // Expected are 1 for a wrong height and 0 for a wrong edge.
      if (stretch) return *stretch / (1 - scale) > 0.5 ? Cause::Height : Cause::Edge;
    }
  }
  return Cause::Open;
}

/// The robot whose tag is checked, and the results from its samples.
struct Look {
  const TaggedRobot& robot;
  const TrackedTag& seen;
  double scale = 1;     ///< relative to the floor tags
  double sigma = 0;     ///< standard error of the mean scale
  double height_m = 0;  ///< height of the camera
  double reach_m = 0;   ///< its largest distance from the point below the camera
};

Look look_at(const TrackedTag& seen, double floor, std::span<const TrackedCamera> cameras) {
  Look look{.robot = *seen.tag, .seen = seen, .scale = seen.mean_scale / floor};
  double squares = 0;
  double count = 0;
  for (const Sample& sample : seen.samples) {
    if (sample.use != Sample::Use::Used) continue;
    squares += (sample.scale - seen.mean_scale) * (sample.scale - seen.mean_scale);
    ++count;
    const Point3 centre = cameras[static_cast<std::size_t>(sample.camera)].view.place.centre();
    look.height_m = centre.z;
    look.reach_m =
        std::max(look.reach_m, hypot(sample.pose.x - centre.x, sample.pose.y - centre.y));
  }
  // Standard deviation over the root of the count.
  if (count > 0) look.sigma = std::sqrt(squares) / count;
  return look;
}

std::string size_text(const Look& look, double floor, double limit, Cause cause, bool all_alike) {
  const RobotSetup& setup = look.robot.setup;
  const double off = look.scale - 1;
  // The height at which a tag with the declared edge would look like this one.
  const double height = look.height_m - (look.height_m - setup.height_m) / look.scale;
  const std::string is_height = fmt::format(
      "its `height` is {:.3f} m and not {:.3f} m, which puts "
      "it up to {:.0f} mm off",
      height, setup.height_m, 1000 * look.reach_m * std::fabs(off));
  const std::string is_edge =
      fmt::format("its `edge` is {:.4f} m, which moves nothing", look.scale * setup.edge_m);
  std::string text = fmt::format(
      "measures {:.4f} m along its edge, declared are {:.4f} m ({:+.1f} %, limit {:.0f} %; floor "
      "tags {:+.1f} %): ",
      look.seen.mean_scale * setup.edge_m, setup.edge_m, 100 * off, 100 * limit, 100 * (floor - 1));
  if (cause == Cause::Height) return text + is_height + ", as two cameras show; measure it again";
  if (cause == Cause::Edge) return text + is_edge + ", as two cameras show; measure it again";
  text += "either " + is_height + ", or " + is_edge + "; ";
  return text + (all_alike ? "all robots are off alike: measure the heights, and the black edge on "
                             "a print"
                           : "measure both on this robot");
}

/// Whether all robots have about the same scale; then the error is in a common measure.
bool are_alike(const std::vector<Look>& looks) {
  constexpr double kAlike = 0.005;
  const auto [least, most] = std::ranges::minmax_element(looks, {}, &Look::scale);
  return looks.size() > 1 && most->scale - least->scale < kAlike;
}

double judge_size(const Look& look, double floor, bool all_alike,
                  std::span<const TrackedCamera> cameras, const TrackLimits& limits,
                  TrackedRun& run) {
  const RobotSetup& setup = look.robot.setup;
  const double off = std::fabs(look.scale - 1);
  // 1 % and 3 % are from tracking facts, section 10. A warning must also be significant.
  const double warn = std::max(limits.scale_warning, 3 * look.sigma);
  Check check{.name = "size of the tag",
              .subject = look.robot.subject(),
              .value = 100 * off,
              .limit = 100 * limits.scale_tolerance,
              .unit = "%",
              .catches = "a wrong height, or another tag"};
  const Cause cause = off > warn ? cause_of(look.seen.samples, look.scale, cameras) : Cause::Open;
  // A wrong edge does not move the robot; it only affects the estimate of the height.
  const bool fails = off > limits.scale_tolerance && cause != Cause::Edge;
  if (fails) check.outcome = Check::Outcome::Failed;
  if (!fails && off > warn) {
    check.outcome = Check::Outcome::Warned;
    check.limit = 100 * warn;
  }
  run.checks.push_back(check);
  if (off <= warn) return 0;
  run.issues.push_back(
      {fails ? IssueCode::TagSize : IssueCode::TagSizeDoubtful,
       fmt::format("{} (tag {}) {}", setup.name, setup.tag,
                   size_text(look, floor, fails ? limits.scale_tolerance : warn, cause, all_alike)),
       setup.name});
  // A height that is wrong by d changes the size by d / (H - h) (docs/tracking.md, "Robots move as
  // robots do"); this is d, for the robot's sigma.
  return cause == Cause::Edge ? 0 : off * (look.height_m - setup.height_m);
}

double judge_tilt(const TaggedRobot& robot, const std::optional<TagTilt>& tilt, TrackedRun& run) {
  const RobotSetup& setup = robot.setup;
  const double limit = tilt_limit(setup);
  Check check{.name = "tilt of the tag",
              .subject = robot.subject(),
              .limit = limit / kDegree,
              .unit = "degrees",
              .catches = "a tag or robot that is not level"};
  // A tilt at the limit must be distinguishable from none, otherwise the check proves nothing.
  const bool is_told = tilt && 3 * tilt->sigma < limit;
  if (!is_told) {
    check.outcome = Check::Outcome::NotRun;
    check.reason = "it was seen too little, or only from right above";
    run.checks.push_back(std::move(check));
    return 0;
  }
  const double angle = tilt->angle_rad();
  check.value = angle / kDegree;
  // Only if it is certainly over the limit.
  const bool leans = angle > limit + 3 * tilt->sigma;
  if (leans) check.outcome = Check::Outcome::Warned;
  run.checks.push_back(std::move(check));
  if (!leans) return 0;
  run.issues.push_back(
      {IssueCode::Tilted,
       fmt::format("{} (tag {}) is tilted by {:.1f} degrees (limit {:.1f}): the tag is not level, "
                   "or the robot leans, which moves its tag by {:.0f} mm; lay the tag flat and "
                   "calibrate the robot again",
                   setup.name, setup.tag, angle / kDegree, limit / kDegree,
                   1000 * setup.height_m * std::sin(angle)),
       setup.name});
  return angle;
}

}  // namespace

double TagTilt::angle_rad() const {
  return std::atan(hypot(along, aside));
}

std::optional<TagTilt> tilt_of(const RobotSetup& robot, std::span<const Sample> samples,
                               const std::vector<Sighting>& sightings,
                               std::span<const TrackedCamera> cameras) {
  // Closer to the point below the camera, the effect of a tilt is only of second order.
  constexpr double kLeastPlace = 0.08;
  constexpr std::size_t kLeast = 20;
  constexpr double kDegreesOfFreedom = 10;  // lens errors are constant while a robot stands
  std::vector<Shear> shears;
  for (const Sample& sample : samples) {
    // Bad fits, too: a tag that leans much fits a level square badly.
    if (sample.use != Sample::Use::Used && sample.use != Sample::Use::BadFit) continue;
    SWARMSMITH_ASSERT(sample.sighting < sightings.size() &&
                          static_cast<std::size_t>(sample.camera) < cameras.size(),
                      "a sample has its sighting and its camera");
    const View& view = cameras[static_cast<std::size_t>(sample.camera)].view;
    const auto shear =
        shear_of(view, sightings[sample.sighting].corners, robot.edge_m, robot.height_m);
    if (shear && std::abs(shear->place) > kLeastPlace) shears.push_back(*shear);
  }
  if (shears.size() < kLeast) return std::nullopt;
  std::complex<double> tilt = 0;
  double weights = 0;
  double squares = 0;
  // Newton's method: the shear is linear in the tilt, except for the shortening by the tilt.
  for (int round = 0; round < 8; ++round) {
    std::complex<double> sum = 0;
    double slopes = 0;
    weights = 0;
    squares = 0;
    for (const Shear& shear : shears) {
      // The tilt is in the tag's axes, and the strain in the world's.
      const std::complex<double> turn = std::polar(1.0, shear.heading);
      const std::complex<double> leans = tilt * turn;
      const std::complex<double> off =
          shear.strain - 0.5 * shear.place * leans + leans * leans / 4.0;
      const std::complex<double> slope = 0.5 * (leans - shear.place) * turn;
      sum += std::conj(slope) * off;
      slopes += std::norm(slope);
      squares += std::norm(off);
      weights += std::norm(shear.place);
    }
    if (slopes < 1e-12) return std::nullopt;
    // The least-squares step over all sightings.
    tilt -= sum / slopes;
  }
  const auto count = static_cast<double>(shears.size());
  const double strain_sigma = std::sqrt(squares / (2 * count));
  const double place = std::sqrt(weights / count);
  return TagTilt{tilt.real(), tilt.imag(),
                 2 * strain_sigma / place / std::sqrt(std::min(count, kDegreesOfFreedom))};
}

std::vector<TagEvidence> judge_tags(const std::vector<TrackedTag>& tags,
                                    const Observations& observations,
                                    std::span<const TrackedCamera> cameras, const Rig& rig,
                                    const TrackLimits& limits, TrackedRun& run) {
  const double floor = floor_scale(observations, cameras, rig);
  std::vector<Look> looks;
  for (const TrackedTag& tag : tags)
    looks.push_back(look_at(tag, floor, cameras));
  const bool all_alike = are_alike(looks);
  std::vector<TagEvidence> evidence;
  for (const Look& look : looks) {
    const double height_off = judge_size(look, floor, all_alike, cameras, limits, run);
    const auto tilt = tilt_of(look.robot.setup, look.seen.samples, observations.sightings, cameras);
    evidence.push_back({height_off, judge_tilt(look.robot, tilt, run)});
  }
  return evidence;
}

std::string tilt_clause(const RobotSetup& robot, std::span<const Sample> samples,
                        const std::vector<Sighting>& sightings,
                        std::span<const TrackedCamera> cameras) {
  const auto tilt = tilt_of(robot, samples, sightings, cameras);
  if (!tilt || tilt->angle_rad() < tilt_limit(robot) + 3 * tilt->sigma) return "";
  return fmt::format("; its tag is tilted by some {:.0f} degrees", tilt->angle_rad() / kDegree);
}

}  // namespace swarmsmith
