#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/clock.h"
#include "robot/runtime/run_record.h"
#include "robot/runtime/scan.h"
#include "robot/runtime/sensed.h"
#include "robot/transport/messages.h"
#include "sim/robot/robot.h"

namespace swarmsmith {

/// How to interpret the measurements of a robot's drivers.
struct FeedSettings {
  double proximity_range_m = kProximityRange_m;     ///< farther obstacles are ignored
  RingAngles rays_deg = ProximityRing::rvr_ring();  ///< directions of the sensors
  double color_scale = 255;                         ///< the driver's value for full colour
  std::vector<Rgb> labels;    ///< the floor's colours (`nearest_label`); empty: no labeler
  double lidar_turn_rad = 0;  ///< angle of the lidar's zero from the robot's head,
                              ///< counter-clockwise
};

/// Converts drivers' messages to readings, each with the time of its arrival. An unusable message,
/// such as one with a sensor that is off, is ignored: its feed gets older, and keeps the reason.
class Feeds {
 public:
  explicit Feeds(FeedSettings settings);

  /// -infinity below 0.05 m, +infinity beyond the range. NaN means a missing sensor, not a free
  /// path.
  void hear(const RangesMessage& message);
  void hear(const GroundColorMessage& message);
  void hear(const ScanMessage& message);
  void hear(const NeighboursMessage& message);
  void hear(const LightMessage& message);

  /// The last readings of all feeds.
  const Sensed& sensed() const { return sensed_; }
  const RawColor& ground_as_sent() const { return ground_as_sent_; }
  /// The number of usable messages so far.
  std::int64_t heard(Feed feed) const { return of(feed).heard; }
  /// Time since the last usable message; nothing before the first.
  std::optional<Duration> age(Feed feed, TimePoint now) const;
  /// Arrival of the last usable message by the wall clock, minus its stamp; nothing without a
  /// stamp.
  std::optional<double> stamp_ms(Feed feed) const { return of(feed).stamp_ms; }
  /// The reason why the newest message is unusable; empty if it is usable.
  const std::string& trouble(Feed feed) const { return of(feed).trouble; }

  /// Sets the difference of the wall clock minus the steady one, for stamps.
  void set_wall_offset(Duration offset) { wall_offset_ = offset; }

 private:
  struct State {
    std::int64_t heard = 0;
    TimePoint at;
    std::optional<double> stamp_ms;
    std::string trouble;
  };

  const State& of(Feed feed) const { return states_[index_of(feed)]; }
  void refuse(Feed feed, std::string why) { states_[index_of(feed)].trouble = std::move(why); }
  void accept(Feed feed, const Arrival& arrival);

  FeedSettings settings_;
  Sensed sensed_;
  RawColor ground_as_sent_;
  PerFeed<State> states_{};
  RayRanges rays_m_{};
  Duration wall_offset_{};
};

}  // namespace swarmsmith
