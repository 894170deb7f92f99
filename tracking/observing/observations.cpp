#include "tracking/observing/observations.h"

#include <array>
#include <iterator>
#include <utility>

namespace swarmsmith {

std::string_view name_of(TimeSource source) {
  static constexpr std::array<std::string_view, 3> kNames = {"sidecar", "container", "frame rate"};
  return kNames.at(static_cast<std::size_t>(source));
}

Observations joined_observations(std::vector<CameraObservations> cameras) {
  Observations all;
  for (CameraObservations& each : cameras) {
    const int number = static_cast<int>(all.cameras.size());
    for (Sighting& sighting : each.sightings)
      sighting.camera = number;
    all.cameras.push_back(std::move(each.record));
    all.sightings.insert(all.sightings.end(), each.sightings.begin(), each.sightings.end());
    std::move(each.issues.begin(), each.issues.end(), std::back_inserter(all.issues));
  }
  return all;
}

}  // namespace swarmsmith
