#include "sim/engine/profile.h"

namespace swarmsmith {

std::vector<Rgb> GroundColorSensing::default_labels() {
  std::vector<Rgb> labels;
  labels.reserve(std::size(kNamedColors));
  for (const NamedColor& named : kNamedColors)
    labels.push_back(named.color);
  return labels;
}

}  // namespace swarmsmith
