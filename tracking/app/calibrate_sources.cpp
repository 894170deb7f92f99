#include "tracking/app/calibrate_sources.h"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>

#include "base/median.h"
#include "base/suggestion.h"
#include "base/text/whole_file.h"
#include "console/counter.h"
#include "tracking/app/run_checks.h"
#include "tracking/app/sidecar_file.h"
#include "tracking/geometry/tag_pose.h"
#include "tracking/motion/repeats.h"
#include "tracking/motion/track_run.h"
#include "tracking/observing/observe.h"
#include "tracking/rig/picture_size.h"

namespace swarmsmith {
namespace {

/// Checks whether a tag has its declared size and height: an error beyond the limit for runs, and
/// only a note for a smaller difference.
std::optional<Error> wrong_size(const RobotSetup& robot, double camera_height_m,
                                std::vector<double> scales, Output& output) {
  const TrackLimits limits;
  const double scale = upper_median(std::move(scales));
  const double off = std::abs(scale - 1);
  if (off <= limits.scale_warning) return std::nullopt;
  // The height at which a tag with the declared edge would look like this one.
  const double height = camera_height_m - (camera_height_m - robot.height_m) / scale;
  const std::string text = fmt::format(
      "tag {} of \"{}\": its edge measures {:.1f} mm, but {:.1f} mm are declared ({:+.1f} %, limit "
      "{:.0f} "
      "%): either its `edge` (the black border) is {:.1f} mm, or its `height` is {:.3f} m and not "
      "{:.3f} m; measure both",
      robot.tag, robot.name, scale * robot.edge_m * 1000, robot.edge_m * 1000, 100 * (scale - 1),
      100 * limits.scale_tolerance, scale * robot.edge_m * 1000, height, robot.height_m);
  if (off > limits.scale_tolerance) return error_of(IssueCode::TagSize, text, "");
  print_note(output, "note: " + text);
  return std::nullopt;
}

}  // namespace

Expected<void> for_each_picture(const std::vector<std::string>& words, const OnPicture& look,
                                Output& output) {
  std::optional<ImageSize> size;
  Counter counter(output, "looked at", "pictures");
  const bool one = words.size() == 1;
  for (std::size_t i = 0; i < words.size(); ++i) {
    auto frames = FrameSource::open(words[i]);
    if (!frames) return Unexpected(frames.error());
    const SourceInfo info = (*frames)->info();
    if (!size) size = info.size;
    if (*size != info.size) {
      return Unexpected(
          error_of(IssueCode::CalibrationSize,
                   fmt::format("this is {}x{}, but the pictures before are {}x{}; all "
                               "pictures of a calibration must have the same size",
                               info.size.width, info.size.height, size->width, size->height),
                   words[i]));
    }
    for (std::int64_t done = 1;; ++done) {
      const auto more = (*frames)->next();
      if (!more) return Unexpected(more.error());
      if (!*more) break;
      // A person chose single pictures; frames of a video are similar to each other.
      const PictureSource source{words[i], (*frames)->frame().file.empty()};
      const auto wanted = look(source, **frames);
      if (!wanted) return Unexpected(wanted.error());
      if (one) counter.tell(done, std::max(done, info.expected_frames));
      if (!*wanted) break;
    }
    if (!one)
      counter.tell(static_cast<std::int64_t>(i) + 1, static_cast<std::int64_t>(words.size()));
  }
  return {};
}

Expected<std::vector<TagSample>> tag_path(const std::string& video, const Rig& rig,
                                          const CameraSetup& camera, const RobotSetup& robot,
                                          Output& output) {
  const auto view = rig.view_of(camera);
  if (!view) {
    return Unexpected(error_of(IssueCode::Config,
                               "camera \"" + camera.name +
                                   "\" is not calibrated yet; first `swarmsmith track calibrate "
                                   "camera`, then `swarmsmith track calibrate arena`",
                               rig.file));
  }
  auto frames = FrameSource::open(video);
  if (!frames) return Unexpected(frames.error());
  const SourceInfo& info = (*frames)->info();
  const auto fits =
      check_picture_size(camera.model_file, view->camera.size, info.size, info.oddities, video);
  if (!fits) return Unexpected(fits.error());
  auto sidecar = times_beside(video);
  if (!sidecar) return Unexpected(sidecar.error());
  auto clock = FrameClock::of(info, std::move(*sidecar));
  if (!clock) return Unexpected(clock.error());
  ObserveOptions options;
  options.family = rig.family;
  options.search.expected = {robot.tag};
  Counter counter(output, "looked at", "pictures of " + video);
  const auto seen = observe({camera, **frames, std::move(*clock), ""}, options,
                            [&](std::int64_t done, std::int64_t of, const auto&) {
                              counter.tell(done, std::max(done, of));
                            });
  if (!seen) return Unexpected(seen.error());
  std::vector<TagSample> path;
  std::vector<double> scales;
  const Observations observations{{seen->record}, seen->sightings, {}, {}};
  const Repeats repeats = repeats_of(observations, 0, std::span(&robot, 1));
  for (const Sighting& sighting : seen->sightings) {
    if (sighting.tag != robot.tag || repeats.again.at(static_cast<std::size_t>(sighting.frame)))
      continue;
    const TagPose pose = tag_pose(*view, sighting.corners, robot.edge_m, robot.height_m);
    path.push_back({sighting.time_s, pose.pose});
    scales.push_back(pose.scale);
  }
  if (path.empty()) {
    return Unexpected(error_of(IssueCode::RobotMissing,
                               fmt::format("tag {} of \"{}\" was never seen; check its number and "
                                           "the family in the arena file, and the light",
                                           robot.tag, robot.name),
                               video));
  }
  if (const auto wrong = wrong_size(robot, view->place.centre().z, std::move(scales), output))
    return Unexpected(*wrong);
  return path;
}

Expected<CameraSetup> camera_of(const Rig& rig, const std::string& name,
                                const std::string& option) {
  std::vector<std::string> names;
  for (const CameraSetup& camera : rig.cameras) {
    if (camera.name == name || (name.empty() && rig.cameras.size() == 1)) return camera;
    names.push_back(camera.name);
  }
  if (!name.empty()) return Unexpected(unknown("camera", name, names, rig.file));
  return Unexpected(error_of(
      IssueCode::Config,
      "the arena has several cameras; choose one with " + option + "; it has: " + joined(names),
      rig.file));
}

std::string beside(const std::string& arena_file, const std::string& file) {
  return (std::filesystem::path(arena_file).parent_path() / file).string();
}

std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  gmtime_r(&now, &parts);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", parts.tm_year + 1900, parts.tm_mon + 1,
                     parts.tm_mday, parts.tm_hour, parts.tm_min, parts.tm_sec);
}

void print_cautions(Output& output, const std::vector<std::string>& cautions) {
  for (const std::string& caution : cautions)
    print_note(output, "note: " + caution);
}

}  // namespace swarmsmith
