#include "tracking/live/live_tracker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/median.h"
#include "tracking/observing/observe.h"

namespace swarmsmith {
namespace {

constexpr double kTrail_s = 5;
constexpr double kRateOver_s = 2;
/// Shorter gaps are interpolated without an issue (tracking facts, section 8).
constexpr double kLost_s = 0.5;
constexpr double kScaleTolerance = 0.05;
/// The same limit as in tracking (TrackLimits::moved_px).
constexpr double kMoved_px = 1;
/// Floor tags are searched only a few times per second.
constexpr double kReferenceSeen_s = 1;

TagSearchOptions options_of(const Rig& rig) {
  TagSearchOptions options;
  for (const RobotSetup& robot : each_tag(rig.robots))
    options.expected.insert(robot.tag);
  for (const ReferenceTag& reference : rig.references) {
    options.expected.insert(reference.tag);
    options.still.insert(reference.tag);
  }
  return options;
}

OverlayTag::Kind kind_of(const Rig& rig, int tag) {
  for (const RobotSetup& robot : each_tag(rig.robots))
    if (robot.tag == tag) return OverlayTag::Kind::Robot;
  for (const ReferenceTag& reference : rig.references)
    if (reference.tag == tag) return OverlayTag::Kind::Reference;
  return OverlayTag::Kind::Unknown;
}

}  // namespace

Expected<LiveTracker> LiveTracker::of(Rig rig, CameraSetup camera, std::optional<Arena> arena) {
  auto detector = TagDetector::of_family(rig.family);
  if (!detector.has_value()) return Unexpected(detector.error());
  TagSearch search(std::move(*detector), options_of(rig));
  return LiveTracker(std::move(search), std::move(rig), std::move(camera), std::move(arena));
}

LiveTracker::LiveTracker(TagSearch search, Rig rig, CameraSetup camera, std::optional<Arena> arena)
    : search_(std::move(search)),
      rig_(std::move(rig)),
      camera_(std::move(camera)),
      arena_(std::move(arena)),
      view_(rig_.view_of(camera_)),
      known_(rig_.robots.size()) {
  const auto place = rig_.places.find(camera_.place_file);
  if (place == rig_.places.end()) return;
  for (const PlaceCalibration::Seen& seen : place->second.tags)
    calibrated_.emplace(seen.tag.tag, seen.corners);
}

void LiveTracker::note_floor_tag(const Detection& seen, double time_s) {
  references_seen_s_[seen.tag] = time_s;
  if (calibrated_.contains(seen.tag)) floor_looks_[seen.tag].emplace_back(time_s, seen.corners);
}

/// Uses means over a second, because a single picture is noisy.
std::optional<double> LiveTracker::camera_shift(double time_s) {
  std::vector<double> shifts;
  for (auto& [tag, looks] : floor_looks_) {
    while (!looks.empty() && time_s - looks.front().first > kReferenceSeen_s)
      looks.pop_front();
    if (looks.empty()) continue;
    ImagePoint mean;
    for (const auto& [seen_s, corners] : looks) {
      mean.u += middle_of(corners).u / static_cast<double>(looks.size());
      mean.v += middle_of(corners).v / static_cast<double>(looks.size());
    }
    const ImagePoint was = middle_of(calibrated_.at(tag));
    shifts.push_back(std::hypot(mean.u - was.u, mean.v - was.v));
  }
  if (shifts.empty()) return std::nullopt;
  return upper_median(std::move(shifts));
}

LiveState LiveTracker::look_at(const GrayImage& image, std::int64_t frame, double time_s) {
  LiveState state;
  state.frame = frame;
  state.time_s = time_s;
  frame_times_.push_back(time_s);
  while (time_s - frame_times_.front() > kRateOver_s)
    frame_times_.pop_front();
  if (frame_times_.size() > 1)
    state.frames_per_s =
        static_cast<double>(frame_times_.size() - 1) / (time_s - frame_times_.front());
  // A calibration is valid for one image size; with another size, everything would be drawn at the
  // wrong place.
  if (view_.has_value() && view_->camera.size != ImageSize{image.width, image.height}) {
    state.issues.push_back(fmt::format(
        "the camera's calibration is for {} x {} pixels, but its pictures have {} x {}: "
        "only tags are shown",
        view_->camera.size.width, view_->camera.size.height, image.width, image.height));
    view_.reset();
  }
  const std::vector<Detection> seen = search_.find(image, time_s);
  for (const Detection& each : seen) {
    state.tags.push_back({each.tag, each.corners, kind_of(rig_, each.tag)});
    if (state.tags.back().kind == OverlayTag::Kind::Reference) note_floor_tag(each, time_s);
  }
  if (view_.has_value()) state.camera_shift_px = camera_shift(time_s);
  state.references = static_cast<int>(rig_.references.size());
  for (const auto& [tag, seen_s] : references_seen_s_)
    if (time_s - seen_s <= kReferenceSeen_s) ++state.references_seen;
  for (std::size_t robot = 0; robot < rig_.robots.size(); ++robot) {
    const double exposed_s = exposed_at(camera_, time_s, 0, image.height);
    place(robot, seen, exposed_s, state);
  }
  add_issues(seen, state);
  return state;
}

void LiveTracker::place(std::size_t robot, const std::vector<Detection>& seen, double time_s,
                        LiveState& state) {
  Known& known = known_[robot];
  const std::vector<RobotSetup> tags = each_tag(rig_.robots[robot]);
  // If a tag is seen twice, the one with the larger margin comes first and is used; an issue
  // reports the duplicate. If a robot has several tags, the first one that is seen is used.
  const auto tag_seen = [&](const RobotSetup& tag) {
    return std::ranges::find(seen, tag.tag, &Detection::tag);
  };
  const auto shown_tag = std::ranges::find_if(
      tags, [&](const RobotSetup& tag) { return tag_seen(tag) != seen.end(); });
  const RobotSetup& setup = shown_tag == tags.end() ? tags.front() : *shown_tag;
  const auto found = tag_seen(setup);
  if (found != seen.end()) {
    known.seen_s = time_s;
    if (view_.has_value()) {
      const TagPose tag = tag_pose(*view_, found->corners, setup.edge_m, setup.height_m);
      known.scale = tag.scale;
      known.pose = robot_pose(tag.pose, rig_.offset_of(setup).value_or(TagOffset{}));
      known.trail.emplace_back(time_s, Point{known.pose->x, known.pose->y});
    }
  }
  while (!known.trail.empty() && time_s - known.trail.front().first > kTrail_s)
    known.trail.pop_front();
  LiveRobot shown{setup.name,          setup.tag, setup.height_m, known.pose, known.seen_s,
                  found != seen.end(), {}};
  for (const auto& [at_s, point] : known.trail)
    shown.trail.push_back(point);
  state.robots.push_back(std::move(shown));
}

void LiveTracker::add_issues(const std::vector<Detection>& seen, LiveState& state) const {
  if (!view_.has_value() && state.issues.empty())
    state.issues.push_back(
        fmt::format("camera {} is not calibrated: only tags are shown", camera_.name));
  if (state.camera_shift_px.value_or(0) > kMoved_px)
    state.issues.push_back(fmt::format(
        "the camera moved: its floor tags are {:.1f} px off where they were calibrated; "
        "fix it and calibrate its place again",
        *state.camera_shift_px));
  for (std::size_t i = 0; i < rig_.robots.size(); ++i) {
    const LiveRobot& robot = state.robots[i];
    const std::string who = fmt::format("{} (tag {})", robot.name, robot.tag);
    if (!robot.seen_s.has_value())
      state.issues.push_back(who + " has not been seen yet");
    else if (state.time_s - *robot.seen_s > kLost_s)
      state.issues.push_back(
          fmt::format("{} has not been seen for {:.1f} s", who, state.time_s - *robot.seen_s));
    if (!robot.is_seen || !robot.pose.has_value()) continue;
    if (!rig_.offset_of(rig_.robots[i]).has_value())
      state.issues.push_back(who + " has no offset calibration: its tag is used as its centre");
    if (std::abs(known_[i].scale - 1) > kScaleTolerance)
      state.issues.push_back(fmt::format(
          "{}: the tag looks {:.0f} % too {}; check its edge and height", who,
          100 * std::abs(known_[i].scale - 1), known_[i].scale > 1 ? "large" : "small"));
    if (arena_.has_value() && !is_inside(*arena_, {robot.pose->x, robot.pose->y}))
      state.issues.push_back(who + " is outside of the walls");
  }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const bool again = i > 0 && seen[i - 1].tag == seen[i].tag;
    if (again && (i < 2 || seen[i - 2].tag != seen[i].tag))
      state.issues.push_back(fmt::format("tag {} is visible more than once", seen[i].tag));
    if (!again && kind_of(rig_, seen[i].tag) == OverlayTag::Kind::Unknown)
      state.issues.push_back(fmt::format("tag {} does not belong to a robot", seen[i].tag));
  }
}

}  // namespace swarmsmith
