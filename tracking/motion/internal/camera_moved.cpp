#include "tracking/motion/internal/camera_moved.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "base/math.h"
#include "tracking/motion/resampling.h"

namespace swarmsmith {
namespace {

double shift_of(const TagCorners& a, const TagCorners& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += hypot(a[i].u - b[i].u, a[i].v - b[i].v);
  return sum / static_cast<double>(a.size());
}

/// Where the floor tags were when the camera's place was found.
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

}  // namespace

std::optional<Issue> camera_moved(const CameraRecord& record, const TrackedCamera& camera,
                                  const Rig& rig, const TrackOptions& options) {
  std::map<int, TagCorners> was = calibrated_corners(rig, camera.name);
  std::map<double, std::vector<double>> shifts;
  std::vector<ReferenceLook> looks = record.references;
  std::ranges::sort(looks, [](const ReferenceLook& a, const ReferenceLook& b) {
    return std::pair(a.time_s, a.tag) < std::pair(b.time_s, b.tag);
  });
  for (const ReferenceLook& look : looks) {
    const auto [before, is_first] = was.emplace(look.tag, look.corners);
    if (!is_first) shifts[look.time_s].push_back(shift_of(before->second, look.corners));
  }
  constexpr double kSpan_s = 5;
  double worst = 0;
  double worst_at = 0;
  std::optional<double> first;
  for (auto& [clock, of_tags] : shifts) {
    const double time = clock - camera.start_s;
    if (of_tags.size() < 2 || time < -kSpan_s || time > instant_s(options.span.cycles) + kSpan_s)
      continue;
    std::ranges::sort(of_tags);
    const double shift = of_tags[of_tags.size() / 2];
    if (shift <= options.limits.moved_px) continue;
    if (!first) first = time;
    if (shift <= worst) continue;
    worst = shift;
    worst_at = time;
  }
  if (!first) return std::nullopt;
  return Issue{
      IssueCode::CameraMoved,
      fmt::format("camera {} moved: from {:.1f} s on its floor tags are elsewhere, most {:.1f} px "
                  "at {:.1f} s (limit {:.1f} px); fix the camera, calibrate its place again",
                  camera.name, *first, worst, worst_at, options.limits.moved_px),
      {},
      *first,
      {}};
}

}  // namespace swarmsmith
