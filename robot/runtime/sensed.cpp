#include "robot/runtime/sensed.h"

namespace swarmsmith {

PerFeed<bool> feeds_of(const UsedSenses& used) {
  PerFeed<bool> feeds{};
  feeds[index_of(Feed::Proximity)] = used.proximity;
  feeds[index_of(Feed::Ground)] = used.ground_color;
  feeds[index_of(Feed::Neighbours)] = used.neighbours;
  feeds[index_of(Feed::Light)] = used.light;
  return feeds;
}

}  // namespace swarmsmith
