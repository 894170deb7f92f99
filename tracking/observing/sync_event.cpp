#include "tracking/observing/sync_event.h"

#include <fmt/format.h>

#include <vector>

namespace swarmsmith {
namespace {

/// For each frame of the camera, whether the tag is in it.
std::vector<bool> presence_of(int tag, const Observations& observations, int camera) {
  std::vector<bool> present(
      observations.cameras[static_cast<std::size_t>(camera)].frame_times.size());
  for (const Sighting& sighting : observations.sightings) {
    if (sighting.camera != camera || sighting.tag != tag) continue;
    present[static_cast<std::size_t>(sighting.frame)] = true;
  }
  return present;
}

/// The first frames of the periods of at least kSyncFrames in which the presence is `wanted`, each
/// after such a period in which it is not. Shorter periods belong to the period before them.
std::vector<std::size_t> changes_to(bool wanted, const std::vector<bool>& present) {
  std::vector<std::size_t> changes;
  std::optional<bool> state;
  for (std::size_t first = 0; first < present.size();) {
    std::size_t end = first;
    while (end < present.size() && present[end] == present[first])
      ++end;
    if (end - first >= kSyncFrames) {
      if (state && *state != wanted && present[first] == wanted) changes.push_back(first);
      state = present[first];
    }
    first = end;
  }
  return changes;
}

}  // namespace

Expected<double> sync_instant(const Observations& observations, int camera, const RunStart& start) {
  const bool is_hidden = start.sync == RunStart::Sync::Hidden;
  const CameraRecord& record = observations.cameras[static_cast<std::size_t>(camera)];
  const std::vector<std::size_t> changes =
      changes_to(!is_hidden, presence_of(start.sync_tag, observations, camera));
  const std::string event =
      fmt::format("tag {} was {}", start.sync_tag, is_hidden ? "covered" : "laid open");
  if (changes.empty()) {
    return Unexpected(error_of(
        IssueCode::Config,
        fmt::format("`sync`: {} at no time of the video (for {} frames at least); say when the run "
                    "begins by `start`",
                    event, kSyncFrames),
        record.file));
  }
  if (changes.size() > 1) {
    std::string times;
    for (const std::size_t frame : changes)
      times += fmt::format("{}{:.3f} s", times.empty() ? "" : ", ", record.frame_times[frame]);
    return Unexpected(error_of(IssueCode::Config,
                               fmt::format("`sync`: {} {} times, at {}; say by `start` which it is",
                                           event, changes.size(), times),
                               record.file));
  }
  const std::size_t frame = changes.front();
  return (record.frame_times[frame - 1] + record.frame_times[frame]) / 2;
}

}  // namespace swarmsmith
