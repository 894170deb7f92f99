#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "sim/control/reference_model.h"
#include "sim/control/used_senses.h"

namespace swarmsmith {

/// What a robot's drivers deliver, one message each. A scan or ready neighbours: the same feed.
enum class Feed { Proximity, Ground, Neighbours, Light };
inline constexpr std::size_t kFeeds = 4;
inline constexpr std::array<Feed, kFeeds> kAllFeeds = {Feed::Proximity, Feed::Ground,
                                                       Feed::Neighbours, Feed::Light};
constexpr std::size_t index_of(Feed feed) {
  return static_cast<std::size_t>(feed);
}

/// `proximity`, `ground`, `neighbours` or `light`.
std::string_view name_of(Feed feed);

/// A value a feed.
template <class T>
using PerFeed = std::array<T, kFeeds>;

/// Which of them a controller needs.
PerFeed<bool> feeds_of(const UsedSenses& used);

/// The readings of one cycle as control software gets them; of sensors that it does not need
/// nothing is known.
struct Sensed {
  double time_s = 0;  ///< since the start of the run
  ProximityReadings proximity_m{};
  Rgb ground;
  std::vector<Neighbour> neighbours;
  LightReadings light_lux{};
};

/// Control software's view of them. `sensed` must outlive the object.
class SensedSenses final : public Senses {
 public:
  explicit SensedSenses(const Sensed& sensed) : sensed_(&sensed) {}

  const ProximityReadings& proximity() override { return sensed_->proximity_m; }
  const Rgb& ground_color() override { return sensed_->ground; }
  std::span<const Neighbour> neighbours() override { return sensed_->neighbours; }
  const LightReadings& light() override { return sensed_->light_lux; }
  double time_s() override { return sensed_->time_s; }

 private:
  const Sensed* sensed_;
};

}  // namespace swarmsmith
