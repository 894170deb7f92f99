#include "tracking/observing/observations.h"

#include <array>
#include <iterator>
#include <utility>

namespace swarmsmith {

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
