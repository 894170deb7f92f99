#include "robot/runtime/sensed.h"

namespace swarmsmith {

std::string_view name_of(Feed feed) {
  static constexpr PerFeed<std::string_view> kNames = {"proximity", "ground", "neighbours",
                                                       "light"};
  return kNames[index_of(feed)];
}

PerFeed<bool> feeds_of(const UsedSenses& used) {
  PerFeed<bool> feeds{};
  feeds[index_of(Feed::Proximity)] = used.proximity;
  feeds[index_of(Feed::Ground)] = used.ground_color;
  feeds[index_of(Feed::Neighbours)] = used.neighbours;
  feeds[index_of(Feed::Light)] = used.light;
  return feeds;
}

}  // namespace swarmsmith
