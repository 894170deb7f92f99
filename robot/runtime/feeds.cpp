#include "robot/runtime/feeds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/assert.h"
#include "base/text/toml_text.h"
#include "sim/control/labeler.h"

namespace swarmsmith {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFullColor = 255;

/// A name such as "proximity sensor 3 (-90 degrees)".
std::string proximity_sensor(std::size_t index, const RingAngles& rays_deg) {
  return "proximity sensor " + std::to_string(index) + " (" + number_text(rays_deg.at(index)) +
         " degrees)";
}

std::string wrong_count(std::size_t came) {
  return "expected " + std::to_string(kRangeSensors) + " values, got " + std::to_string(came);
}

/// Rounded half up, in 0 to 255 (docs/robot-runtime.md, "Readings"). The scale is an option because
/// messages do not carry it (ROS facts, 3.5); the published driver sends 0 to 255 (ROS facts, 1.2).
std::uint8_t channel(double value, double scale) {
  const double scaled = std::floor(value * (kFullColor / scale) + 0.5);
  return static_cast<std::uint8_t>(std::clamp(scaled, 0.0, kFullColor));
}

}  // namespace

Feeds::Feeds(FeedSettings settings) : settings_(std::move(settings)) {
  SWARMSMITH_ASSERT(settings_.color_scale > 0 && settings_.proximity_range_m > 0 &&
                        settings_.rays_deg.size() == kRangeSensors,
                    "options were checked where they were read");
}

std::optional<Duration> Feeds::age(Feed feed, TimePoint now) const {
  if (of(feed).heard == 0) return std::nullopt;
  return now - of(feed).at;
}

void Feeds::accept(Feed feed, const Arrival& arrival) {
  State& state = states_[index_of(feed)];
  ++state.heard;
  // The age is counted from the arrival, by the node's clock: half of the messages have no stamp,
  // and stamps come from another clock.
  state.at = arrival.at;
  state.trouble.clear();
  state.stamp_ms.reset();
  // Only for the log.
  if (arrival.stamp_ns != 0) {
    const std::int64_t wall_ns = (arrival.at.time_since_epoch() + wall_offset_).count();
    state.stamp_ms = 1e-6 * static_cast<double>(wall_ns - arrival.stamp_ns);
  }
}

void Feeds::hear(const RangesMessage& message) {
  const std::vector<double>& ranges = message.ranges_m;
  if (ranges.size() != kRangeSensors) return refuse(Feed::Proximity, wrong_count(ranges.size()));
  // All values are checked before one is stored, so that a refused message leaves the last reading
  // whole. The published robots read NaN as a free path (ROS facts, 1.4); here one sensor that is
  // off makes the message unusable.
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (std::isnan(ranges[i]))
      return refuse(Feed::Proximity,
                    proximity_sensor(i, settings_.rays_deg) + " is missing: its value is NaN");
    // -infinity is a correct value: an obstacle too near to be measured (ROS facts, 1.2).
    if (std::isfinite(ranges[i]) && ranges[i] < 0)
      return refuse(Feed::Proximity, proximity_sensor(i, settings_.rays_deg) +
                                         " has the negative range " + std::to_string(ranges[i]) +
                                         " m");
  }
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    double& distance = sensed_.proximity_m[i];
    distance = ranges[i];
    // The same limits as in the simulator, whose modules take these infinities (reference_model.h).
    if (distance < kBlindZone_m) distance = -kInfinity;
    if (distance > settings_.proximity_range_m) distance = kInfinity;
  }
  accept(Feed::Proximity, message.arrival);
}

void Feeds::hear(const GroundColorMessage& message) {
  if (!(std::isfinite(message.r) && std::isfinite(message.g) && std::isfinite(message.b)))
    return refuse(Feed::Ground, "a colour that is not a number");
  const double scale = settings_.color_scale;
  // For the log: a wrong scale or label can be found there later.
  ground_as_sent_ = {message.r, message.g, message.b};
  sensed_.ground = nearest_label(
      {channel(message.r, scale), channel(message.g, scale), channel(message.b, scale)},
      settings_.labels);
  accept(Feed::Ground, message.arrival);
}

void Feeds::hear(const ScanMessage& message) {
  // The robots are found by the same function as in the simulator's lidar, from the same number of
  // rays.
  if (auto trouble = resample(message, settings_.lidar_turn_rad, rays_m_))
    return refuse(Feed::Neighbours, std::move(*trouble));
  cluster_lidar(rays_m_, sensed_.neighbours);
  accept(Feed::Neighbours, message.arrival);
}

void Feeds::hear(const NeighboursMessage& message) {
  for (const SeenRobot& robot : message.robots) {
    // Written so that NaN is refused. One bad neighbour makes the message unusable: without it, the
    // number of neighbours would be wrong.
    if (!(robot.distance_m >= 0 && std::isfinite(robot.distance_m) &&
          std::isfinite(robot.direction_x) && std::isfinite(robot.direction_y)))
      return refuse(Feed::Neighbours, "a neighbour whose place is not a number");
  }
  sensed_.neighbours.clear();
  for (const SeenRobot& robot : message.robots)
    sensed_.neighbours.push_back({robot.distance_m, robot.direction_x, robot.direction_y});
  accept(Feed::Neighbours, message.arrival);
}

void Feeds::hear(const LightMessage& message) {
  if (message.lux.size() != kRangeSensors)
    return refuse(Feed::Light, wrong_count(message.lux.size()));
  for (const double lux : message.lux) {
    if (!(lux >= 0)) return refuse(Feed::Light, "a light sensor is missing: NaN or negative lux");
  }
  for (std::size_t i = 0; i < message.lux.size(); ++i)
    // The sensor's highest reading in the reference model (thesis 4.2.6).
    sensed_.light_lux[i] = std::min(message.lux[i], kMostLight_lux);
  accept(Feed::Light, message.arrival);
}

}  // namespace swarmsmith
