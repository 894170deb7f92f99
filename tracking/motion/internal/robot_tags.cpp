#include "tracking/motion/internal/robot_tags.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "base/assert.h"
#include "base/math.h"
#include "tracking/motion/internal/precision.h"

namespace swarmsmith {
namespace {

constexpr Question kAgreement{"tags of one robot agree", "mm",
                              "a tag that came loose, or was mounted again"};

/// Some errors stay the same within a second and are not independent in each picture, so the limit
/// is four sigmas of one picture.
constexpr double kSigmas = 4;
/// An error that affects no score (robot_travel.cpp).
constexpr double kHarmless_m = 0.005;
constexpr double kDegree = kPi / 180;
/// The largest error of a heading (robot_travel.cpp).
constexpr double kHeading_rad = 5 * kDegree;
/// Number of pictures in a stretch, and the smallest number that is enough for a result.
constexpr std::size_t kStretch = 15;
constexpr std::size_t kLeast = 5;

double square(double value) {
  return value * value;
}

/// Noise of each tag's samples, per camera.
using Noise = std::vector<Scatter>;

Noise noise_of(const RobotSamples& samples, std::size_t cameras) {
  std::vector<std::vector<TimedPose>> tracks(cameras);
  for (const Sample& sample : samples.samples) {
    if (sample.use != Sample::Use::Used) continue;
    SWARMSMITH_ASSERT(static_cast<std::size_t>(sample.camera) < cameras,
                      "sightings of cameras that are lost were left out");
    tracks[static_cast<std::size_t>(sample.camera)].push_back({sample.time_s, sample.pose});
  }
  Noise noise;
  for (const std::vector<TimedPose>& track : tracks)
    noise.push_back(scatter_of(track));
  return noise;
}

std::vector<Noise> noise_of(std::span<const OneOfTags> tags, std::size_t cameras) {
  std::vector<Noise> noise;
  for (const OneOfTags& one : tags)
    noise.push_back(noise_of(one.samples, cameras));
  return noise;
}

/// The error of a robot's place that is specific to this tag (offset and height) and not shared
/// with the robot's other tags, without noise. Variance of one coordinate.
double own_variance(const TaggedRobot& tag, const TrackedCamera& camera, const Point& at) {
  const Point3 centre = camera.view.place.centre();
  const double reach = hypot(at.x - centre.x, at.y - centre.y) / (centre.z - tag.setup.height_m);
  return square(tag.offset_sigma_m) + square(reach * tag.setup.height_error_m);
}

/// A sample that fits, and the index of its tag.
struct Part {
  std::size_t tag = 0;
  const Sample* sample = nullptr;
};

/// All samples that fit, by camera and frame.
using Pictures = std::map<std::pair<int, std::int64_t>, std::vector<Part>>;

Pictures pictures_of(std::span<const OneOfTags> tags) {
  Pictures pictures;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    for (const Sample& sample : tags[i].samples.samples) {
      if (sample.use == Sample::Use::Used)
        pictures[{sample.camera, sample.frame}].push_back({i, &sample});
    }
  }
  return pictures;
}

Sample fused(std::span<const OneOfTags> tags, const std::vector<Part>& parts,
             const std::vector<Noise>& noise, std::span<const TrackedCamera> cameras,
             const Rig& rig) {
  SWARMSMITH_ASSERT(!parts.empty(), "a picture without samples makes none");
  Sample made = *parts.front().sample;
  if (parts.size() == 1) return made;
  const auto number = static_cast<std::size_t>(made.camera);
  const double first_theta = made.pose.theta;
  const double first_s = made.time_s;
  double weights = 0;
  double turn_weights = 0;
  double x = 0;
  double y = 0;
  double turn = 0;
  double later_s = 0;
  for (const Part& part : parts) {
    const TaggedRobot& tag = tags[part.tag].tag;
    const Scatter& scatter = noise[part.tag][number];
    const Pose& pose = part.sample->pose;
    // A lean of the robot moves a higher tag more.
    const double weight =
        1 / (square(scatter.sigma_m) + own_variance(tag, cameras[number], pose.position()) +
             square(tag.setup.height_m * std::sin(rig.tilt_error_rad)));
    const double turn_weight = 1 / square(scatter.sigma_rad);
    weights += weight;
    turn_weights += turn_weight;
    x += weight * pose.x;
    y += weight * pose.y;
    later_s += weight * (part.sample->time_s - first_s);
    turn += turn_weight * wrap_angle(pose.theta - first_theta);
    if (part.sample != parts.front().sample) made.more_sightings.push_back(part.sample->sighting);
  }
  made.pose = {x / weights, y / weights, wrap_angle(first_theta + turn / turn_weights)};
  // A rolling shutter sees the tags at different times.
  made.time_s = first_s + later_s / weights;
  return made;
}

/// The difference between the poses from two tags of a robot in one picture.
struct Difference {
  double time_s = 0;
  double x = 0;
  double y = 0;
  double turn = 0;
  double variance = 0;       ///< known variance of one coordinate
  double turn_variance = 0;  ///< variance due to noise
};

std::vector<Difference> differences_of(const OneOfTags& a, const OneOfTags& b, const Noise& noise_a,
                                       const Noise& noise_b, std::span<const TrackedCamera> cameras,
                                       const Rig& rig, double driving_m_s) {
  const std::pair of_both{a.tag.setup.height_m, b.tag.setup.height_m};
  std::map<std::pair<int, std::int64_t>, const Sample*> seen;
  for (const Sample& sample : a.samples.samples) {
    if (sample.use == Sample::Use::Used) seen[{sample.camera, sample.frame}] = &sample;
  }
  std::vector<Difference> differences;
  for (const Sample& other : b.samples.samples) {
    const auto found = seen.find({other.camera, other.frame});
    if (other.use != Sample::Use::Used || found == seen.end()) continue;
    const Sample& one = *found->second;
    const auto number = static_cast<std::size_t>(one.camera);
    const TrackedCamera& camera = cameras[number];
    const Point at = one.pose.position();
    const double above_m = camera.view.place.centre().z - std::min(of_both.first, of_both.second);
    Difference& made = differences.emplace_back();
    made.time_s = one.time_s;
    made.x = other.pose.x - one.pose.x;
    made.y = other.pose.y - one.pose.y;
    made.turn = wrap_angle(other.pose.theta - one.pose.theta);
    // Errors of the survey, and of the camera's place and clock, move both tags alike.
    made.variance = own_variance(a.tag, camera, at) + own_variance(b.tag, camera, at) +
                    2 * square(camera.lens_error_rad * above_m) +
                    square((of_both.first - of_both.second) * std::sin(rig.tilt_error_rad)) +
                    square(driving_m_s * (other.time_s - one.time_s)) +
                    square(noise_a[number].sigma_m) + square(noise_b[number].sigma_m);
    made.turn_variance = square(noise_a[number].sigma_rad) + square(noise_b[number].sigma_rad);
  }
  std::ranges::stable_sort(differences, {}, &Difference::time_s);
  return differences;
}

/// The mean difference of two tags over several consecutive pictures.
struct Stretch {
  double from_s = 0;
  double to_s = 0;
  double off_m = 0;
  double limit_m = 0;
  double turn_rad = 0;
  double turn_limit_rad = 0;

  /// The difference as a share of its limit; above 1 the tags disagree.
  double part() const { return std::max(off_m / limit_m, std::fabs(turn_rad) / turn_limit_rad); }
};

Stretch stretch_of(std::span<const Difference> differences) {
  SWARMSMITH_ASSERT(!differences.empty(), "a stretch is of pictures");
  Stretch made{.from_s = differences.front().time_s, .to_s = differences.back().time_s};
  const auto count = static_cast<double>(differences.size());
  double x = 0;
  double y = 0;
  double variance = 0;
  double turn_variance = 0;
  for (const Difference& each : differences) {
    x += each.x / count;
    y += each.y / count;
    made.turn_rad += each.turn / count;
    variance += each.variance / count;
    turn_variance += each.turn_variance / count;
  }
  made.off_m = hypot(x, y);
  made.limit_m = std::max(kHarmless_m, kSigmas * std::sqrt(variance));
  made.turn_limit_rad = std::max(kHeading_rad, kSigmas * std::sqrt(turn_variance));
  return made;
}

/// Stretches that overlap by half; the last one reaches to the end.
std::vector<Stretch> stretches_of(const std::vector<Difference>& differences) {
  std::vector<Stretch> stretches;
  if (differences.size() < kLeast) return stretches;
  const std::span all(differences);
  const std::size_t length = std::min(kStretch, all.size());
  for (std::size_t from = 0;; from += kStretch / 2) {
    const std::size_t last = all.size() - length;
    stretches.push_back(stretch_of(all.subspan(std::min(from, last), length)));
    if (from >= last) return stretches;
  }
}

/// The worst stretch, and the whole period in which the tags disagree.
struct Disagreement {
  Stretch worst;
  double from_s = 0;
  double to_s = 0;
};

Disagreement disagreement_of(const std::vector<Stretch>& stretches) {
  SWARMSMITH_ASSERT(!stretches.empty(), "tags that were not seen together are not judged");
  Disagreement made{.worst = *std::ranges::max_element(stretches, {}, &Stretch::part)};
  const auto is_off = [](const Stretch& stretch) { return stretch.part() > 1; };
  const auto first = std::ranges::find_if(stretches, is_off);
  if (first == stretches.end()) return made;
  made.from_s = first->from_s;
  for (const Stretch& stretch : stretches) {
    if (is_off(stretch)) made.to_s = stretch.to_s;
  }
  return made;
}

std::int64_t used_of(const OneOfTags& one) {
  return std::ranges::count(one.samples.samples, Sample::Use::Used, &Sample::use);
}

/// Judges the tags of one robot.
class Agreement {
 public:
  Agreement(std::span<const OneOfTags> tags, TrackedRun& run)
      : tags_(tags), run_(run), name_(tags.front().tag.setup.name), compared_(tags.size(), false) {}

  void look(std::size_t a, std::size_t b, const std::vector<Difference>& differences) {
    const std::vector<Stretch> stretches = stretches_of(differences);
    if (stretches.empty()) return;
    compared_[a] = compared_[b] = true;
    const Disagreement found = disagreement_of(stretches);
    if (!worst_ || found.worst.part() > worst_->part()) worst_ = found.worst;
    if (found.worst.part() <= 1) return;
    is_wrong_ = true;
    add(IssueCode::TagsDisagree,
        fmt::format("has tags {} and {} {:.0f} mm (limit {:.1f} mm) and {:.1f} degrees from where "
                    "its calibration has them to each other, from {:.2f} s to {:.2f} s: one of "
                    "them came loose, or a `height` is wrong; fix it, calibrate the robot again, "
                    "and film the run again",
                    tags_[a].tag.setup.tag, tags_[b].tag.setup.tag, 1000 * found.worst.off_m,
                    1000 * found.worst.limit_m, std::fabs(found.worst.turn_rad) / kDegree,
                    found.from_s, found.to_s),
        found.from_s, found.to_s);
  }

  /// Reports tags that could not be compared, and adds the check.
  void finish() {
    bool is_open = false;
    for (std::size_t i = 0; i < tags_.size(); ++i) {
      const int tag = tags_[i].tag.setup.tag;
      if (tags_[i].samples.samples.empty()) {
        add(IssueCode::FilmOdd,
            fmt::format("carries tag {}, too, which was never seen in this run; is it still there?",
                        tag));
      } else if (!compared_[i] && used_of(tags_[i]) >= static_cast<std::int64_t>(kLeast)) {
        if (!others_are_used(i)) continue;
        is_open = true;
        add(IssueCode::TagPlaceDoubtful,
            fmt::format("has tag {} in no {} pictures together with another of its tags, so that "
                        "nothing tells whether they agree; mount them so that both are seen at "
                        "times",
                        tag, kLeast));
      }
    }
    if (!worst_) {
      if (is_open)
        return run_.checks.push_back(answered(kAgreement, name_, Check::Outcome::Warned));
      return run_.checks.push_back(
          not_asked(kAgreement, name_, "no two of its tags were seen together"));
    }
    const Check::Outcome outcome = is_wrong_ ? Check::Outcome::Failed
                                   : is_open ? Check::Outcome::Warned
                                             : Check::Outcome::Passed;
    run_.checks.push_back(
        answered(kAgreement, name_, outcome, 1000 * worst_->off_m, 1000 * worst_->limit_m));
  }

 private:
  bool others_are_used(std::size_t but) const {
    for (std::size_t i = 0; i < tags_.size(); ++i) {
      if (i != but && used_of(tags_[i]) > 0) return true;
    }
    return false;
  }

  void add(IssueCode code, const std::string& text, std::optional<double> from = {},
           std::optional<double> to = {}) {
    run_.issues.push_back({code, name_ + " " + text, name_, from, to});
  }

  std::span<const OneOfTags> tags_;
  TrackedRun& run_;
  std::string name_;
  std::vector<bool> compared_;
  std::optional<Stretch> worst_;
  bool is_wrong_ = false;
};

}  // namespace

RobotSamples fused_samples(std::span<const OneOfTags> tags, std::span<const TrackedCamera> cameras,
                           const Rig& rig) {
  SWARMSMITH_ASSERT(!tags.empty(), "a robot carries a tag");
  const std::vector<Noise> noise = noise_of(tags, cameras.size());
  RobotSamples made;
  made.scale = tags.front().samples.scale;
  for (const auto& [picture, parts] : pictures_of(tags))
    made.samples.push_back(fused(tags, parts, noise, cameras, rig));
  for (const OneOfTags& one : tags) {
    std::ranges::copy_if(one.samples.samples, std::back_inserter(made.samples),
                         [](const Sample& sample) { return sample.use != Sample::Use::Used; });
    made.twice.insert(made.twice.end(), one.samples.twice.begin(), one.samples.twice.end());
    made.twice_unresolved += one.samples.twice_unresolved;
  }
  std::ranges::stable_sort(made.samples, {}, &Sample::time_s);
  return made;
}

void judge_agreement(std::span<const OneOfTags> tags, std::span<const TrackedCamera> cameras,
                     const Rig& rig, double driving_m_s, TrackedRun& run) {
  const std::vector<Noise> noise = noise_of(tags, cameras.size());
  Agreement agreement(tags, run);
  for (std::size_t a = 0; a < tags.size(); ++a) {
    for (std::size_t b = a + 1; b < tags.size(); ++b) {
      agreement.look(
          a, b, differences_of(tags[a], tags[b], noise[a], noise[b], cameras, rig, driving_m_s));
    }
  }
  agreement.finish();
}

}  // namespace swarmsmith
