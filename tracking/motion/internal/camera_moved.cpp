#include "tracking/motion/internal/camera_moved.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/math.h"
#include "tracking/motion/resampling.h"
#include "tracking/rig/calibration_limits.h"
#include "tracking/rig/rig_file.h"

namespace swarmsmith {
namespace {

constexpr Question kLens{"lens calibration", "px",
                         "a bad lens calibration: errors grow towards the border"};
constexpr Question kPlace{"floor tags fit the camera's place", "px",
                          "a wrongly measured floor tag, another focus"};
constexpr Question kLeftOut{"worst floor tag, left out", "mm", "a wrongly measured floor tag"};
constexpr Question kEdited{"place file as it was made", "px", "an edited calibration"};
constexpr Question kSurvey{"survey as it was calibrated", "",
                           "a corrected survey without a new calibration of the place"};
constexpr Question kMoved{"camera stayed where it was", "px", "a camera that was pushed"};
constexpr Question kWatched{"floor tags seen until the end", "s",
                            "a push after they were last seen"};

/// A camera that was pushed stays where it is, so a later look at the floor tags also reveals an
/// earlier push.
constexpr double kTail_s = 10;

double shift_of(const TagCorners& a, const TagCorners& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += hypot(a[i].u - b[i].u, a[i].v - b[i].v);
  return sum / static_cast<double>(a.size());
}

/// The corners of the floor tags when the camera's place was calibrated.
std::map<int, TagCorners> calibrated_corners(const Rig& rig, const std::string& camera) {
  std::map<int, TagCorners> corners;
  for (const CameraSetup& setup : rig.cameras) {
    if (setup.name != camera) continue;
    const auto place = rig.places.find(setup.place_file);
    if (place == rig.places.end()) continue;
    for (const PlaceCalibration::Seen& seen : place->second.tags)
      corners.emplace(seen.tag.tag, seen.corners);
  }
  return corners;
}

TagCorners turned_by_half(TagCorners corners, ImageSize size) {
  for (ImagePoint& corner : corners)
    corner = {size.width - 1 - corner.u, size.height - 1 - corner.v};
  return corners;
}

/// The shift of the floor tags from their earlier positions, in one look at them.
struct Span {
  double time_s = 0;  ///< middle of the look, time of the run
  int tags = 0;       ///< tags with a known earlier position; 0 if they contradict each other
  double shift_px = 0;
  double turned_px = 0;  ///< the same, for a picture that is turned by 180 degrees
};

std::vector<Span> spans_of(const CameraRecord& record, const TrackedCamera& camera, const Rig& rig,
                           double duration_s, double limit_px) {
  std::map<int, TagCorners> was = calibrated_corners(rig, camera.name);
  std::map<double, std::vector<double>> shifts;
  std::map<double, double> turned;  // the largest shifts
  std::vector<ReferenceLook> looks = record.references;
  std::ranges::sort(looks, [](const ReferenceLook& a, const ReferenceLook& b) {
    return std::pair(a.time_s, a.tag) < std::pair(b.time_s, b.tag);
  });
  for (const ReferenceLook& look : looks) {
    const auto [before, is_first] = was.emplace(look.tag, look.corners);
    // A tag that was not there at the calibration has no earlier position yet.
    if (is_first) continue;
    shifts[look.time_s].push_back(shift_of(before->second, look.corners));
    double& most = turned[look.time_s];
    most = std::max(most, shift_of(turned_by_half(before->second, record.size), look.corners));
  }
  constexpr double kMargin_s = 5;
  std::vector<Span> spans;
  for (auto& [clock, of_tags] : shifts) {
    const double time = clock - camera.start_s;
    if (time < -kMargin_s || time > duration_s + kMargin_s) continue;
    std::ranges::sort(of_tags);
    const std::size_t tags = of_tags.size();
    // The median over the tags: a few that were kicked or are half covered do not count.
    const double lower = of_tags[(tags - 1) / 2];
    // One half of the tags moved and the other half did not: robots stand on some, or some were
    // kicked. It is unknown which half is right, so none of them counts.
    const bool is_even = lower <= limit_px && of_tags[tags / 2] > limit_px;
    spans.push_back({time, is_even ? 0 : static_cast<int>(tags), lower, turned[clock]});
  }
  return spans;
}

std::optional<Issue> moved(const std::vector<Span>& spans, const std::string& camera,
                           double limit_px) {
  // A single tag may be half covered; this is the case if a later look shows the camera in its
  // place.
  const auto is_refuted = [&](const Span& span) {
    return span.tags < 2 && std::ranges::any_of(spans, [&](const Span& later) {
             return later.time_s > span.time_s && later.tags >= 2 && later.shift_px <= limit_px;
           });
  };
  // Tracking facts, section 3: the limit is 1 px.
  const auto is_off = [&](const Span& span) {
    return span.shift_px > limit_px && !is_refuted(span);
  };
  const auto first = std::ranges::find_if(spans, is_off);
  if (first == spans.end()) return std::nullopt;
  const auto worst = std::ranges::max_element(spans, {}, &Span::shift_px);
  // The push happened between two looks; before the first look its time is unknown.
  const std::string since =
      first == spans.begin()
          ? fmt::format("before {:.1f} s", std::max(0.0, first->time_s))
          : fmt::format("between {:.1f} s and {:.1f} s", std::prev(first)->time_s, first->time_s);
  constexpr double kNear_px = 20;
  // All tags are nearly where a picture turned by 180 degrees has them, so the camera was not
  // pushed.
  const bool is_turned = worst->tags >= 2 && worst->turned_px < std::min(kNear_px, worst->shift_px);
  return Issue{
      IssueCode::CameraMoved,
      fmt::format("camera {} moved {}: from then on its floor tags are elsewhere, most {:.1f} px "
                  "at {:.1f} s (limit {:.1f} px); {}",
                  camera, since, worst->shift_px, worst->time_s, limit_px,
                  is_turned ? "its pictures are turned by 180 degrees: take the file as the camera "
                              "wrote it, or hang it as it was"
                            : "fix the camera, calibrate its place again"),
      {},
      first->time_s,
      {}};
}

std::optional<Issue> unchecked(const std::vector<Span>& spans, const std::string& camera,
                               double duration_s) {
  constexpr const char* kWhatToDo =
      "a moved camera would not be noticed; keep the floor tags free, lit and in the picture";
  const auto last =
      // Two tags or more, because a single one may have moved by itself.
      std::ranges::find_if(spans.rbegin(), spans.rend(), [](const Span& s) { return s.tags >= 2; });
  if (last != spans.rend() && last->time_s >= duration_s - kTail_s) return std::nullopt;
  const bool is_part = last != spans.rend();
  const bool sees_one = !spans.empty() && (!is_part || last != spans.rbegin());
  const std::string seen = sees_one ? "only one of its floor tags" : "none of its floor tags";
  const std::string when = is_part ? fmt::format("after {:.1f} s", last->time_s) : "in the run";
  return Issue{IssueCode::CameraUnchecked,
               fmt::format("camera {} saw {} {}: {}", camera, seen, when, kWhatToDo),
               {},
               is_part ? std::optional(last->time_s) : std::nullopt,
               {}};
}

/// Files beyond these limits were refused earlier; the checks show how close to the limits they
/// are.
void check_calibrations(const Rig& rig, const CameraSetup& setup, std::vector<Check>& checks) {
  const CameraLimits lens;
  const PlaceLimits limits;
  const auto within = [&](const Question& question, double value, double limit, bool is_within) {
    checks.push_back(answered(question, setup.name,
                              is_within ? Check::Outcome::Passed : Check::Outcome::Failed, value,
                              limit));
  };
  const auto model = rig.models.find(setup.model_file);
  if (model != rig.models.end()) {
    const double most_px = rms_limit_px(model->second.model, lens);
    within(kLens, model->second.rms_px, most_px, model->second.rms_px <= most_px);
  }
  const auto found = rig.places.find(setup.place_file);
  if (found == rig.places.end()) return;
  const PlaceCalibration& place = found->second;
  const double most_px = rms_limit_px(place, limits);
  within(kPlace, place.rms_px, most_px, place.rms_px <= most_px);
  within(kLeftOut, 1000 * place.worst_left_out_m, 1000 * limits.left_out_m,
         place.worst_left_out_m <= limits.left_out_m);
}

void check_place(const Rig& rig, const CameraSetup& setup, std::vector<Issue>& issues,
                 std::vector<Check>& checks) {
  const std::size_t first = issues.size();
  for (Issue& doubt : doubts_of_place(rig, setup))
    issues.push_back(std::move(doubt));
  checks.push_back(answered(kEdited, setup.name, outcome_of(issues, first, IssueCode::Extrinsics)));
  checks.push_back(
      answered(kSurvey, setup.name, outcome_of(issues, first, IssueCode::SurveyChanged)));
}

}  // namespace

void check_camera(const CameraRecord& record, const TrackedCamera& camera, const Rig& rig,
                  const TrackOptions& options, std::vector<Issue>& issues,
                  std::vector<Check>& checks) {
  const double duration = instant_s(options.span.cycles);
  // Looks with one tag are kept: they cannot prove that the camera stayed, but they can show that
  // it moved.
  const std::vector<Span> spans = spans_of(record, camera, rig, duration, options.limits.moved_px);
  const auto setup = std::ranges::find(rig.cameras, camera.name, &CameraSetup::name);
  if (setup != rig.cameras.end()) {
    check_calibrations(rig, *setup, checks);
    check_place(rig, *setup, issues, checks);
  }
  const std::size_t first = issues.size();
  if (auto issue = moved(spans, camera.name, options.limits.moved_px))
    issues.push_back(std::move(*issue));
  if (auto issue = unchecked(spans, camera.name, duration)) issues.push_back(std::move(*issue));
  if (spans.empty()) {
    checks.push_back(not_asked(kMoved, camera.name, "none of its floor tags was seen"));
  } else {
    checks.push_back(
        answered(kMoved, camera.name, outcome_of(issues, first, IssueCode::CameraMoved),
                 std::ranges::max(spans, {}, &Span::shift_px).shift_px, options.limits.moved_px));
  }
  const auto last =
      std::ranges::find_if(spans.rbegin(), spans.rend(), [](const Span& s) { return s.tags >= 2; });
  checks.push_back(answered(
      kWatched, camera.name, outcome_of(issues, first, IssueCode::CameraUnchecked),
      last == spans.rend() ? std::nullopt : std::optional(std::max(0.0, duration - last->time_s)),
      kTail_s));
}

}  // namespace swarmsmith
