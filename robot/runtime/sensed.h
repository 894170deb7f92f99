#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/assert.h"
#include "sim/control/reference_model.h"
#include "sim/control/used_senses.h"

namespace swarmsmith {

/// Enumerators have names in files and messages: `names_of` lists them in order.
template <class Enum>
std::string_view name_of(Enum value) requires requires {
  names_of(value);
}
{
  const auto names = names_of(value);
  SWARMSMITH_ASSERT(static_cast<std::size_t>(value) < names.size(), "each enumerator has a name");
  return names[static_cast<std::size_t>(value)];
}
template <class Enum>
std::optional<Enum> named(std::string_view name) {
  const auto names = names_of(Enum());
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Enum>(found - names.begin());
}

/// The inputs from a robot's drivers, one message each. Scans and finished neighbours are the same
/// feed.
enum class Feed { Proximity, Ground, Neighbours, Light };
inline constexpr std::size_t kFeeds = 4;
inline constexpr std::array<Feed, kFeeds> kAllFeeds = {Feed::Proximity, Feed::Ground,
                                                       Feed::Neighbours, Feed::Light};
constexpr std::size_t index_of(Feed feed) {
  return static_cast<std::size_t>(feed);
}

constexpr auto names_of(Feed) {
  return std::to_array<std::string_view>({"proximity", "ground", "neighbours", "light"});
}

/// One value per feed.
template <class T>
using PerFeed = std::array<T, kFeeds>;

/// The feeds that a controller needs.
PerFeed<bool> feeds_of(const UsedSenses& used);

/// Of each ring of a robot that nodes drive.
using EightReadings = std::array<double, kProximitySensors>;

/// The readings of one cycle, as control software receives them; readings of sensors that it does
/// not need are unknown.
struct Sensed {
  double time_s = 0;  ///< since the start of the run
  EightReadings proximity_m{};
  Rgb ground;
  std::vector<Neighbour> neighbours;
  EightReadings light_lux{};
};

/// Gives these readings to control software. `sensed` must outlive the object.
class SensedSenses final : public Senses {
 public:
  explicit SensedSenses(const Sensed& sensed) : sensed_(&sensed) {}

  ProximityReadings proximity() override { return sensed_->proximity_m; }
  const Rgb& ground_color() override { return sensed_->ground; }
  std::span<const Neighbour> neighbours() override { return sensed_->neighbours; }
  LightReadings light() override { return sensed_->light_lux; }
  double time_s() override { return sensed_->time_s; }

 private:
  const Sensed* sensed_;
};

}  // namespace swarmsmith
