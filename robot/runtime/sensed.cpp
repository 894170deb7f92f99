#include "robot/runtime/sensed.h"

namespace swarmsmith {

std::string_view name_of(Feed feed) {
  static constexpr PerFeed<std::string_view> kNames = {"proximity", "ground", "neighbours",
                                                       "light"};
  return kNames[index_of(feed)];
}

Sensor sensor_of(Feed feed) {
  static constexpr PerFeed<Sensor> kSensors = {Sensor::Proximity, Sensor::GroundColor,
                                               Sensor::Neighbours, Sensor::LightRing};
  return kSensors[index_of(feed)];
}

}  // namespace swarmsmith
