#include "sim/engine/internal/robot_senses.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/engine/internal/normal_noise.h"
#include "sim/engine/internal/sensing.h"

namespace swarmsmith {
namespace {

/// The standard normal number with this index in the stream with this key.
double normal_at(std::uint64_t key, std::uint64_t index) {
  Rng rng(key + index);
  return NormalNoise::instance().draw(rng);
}

std::uint8_t noisy_channel(std::uint8_t value, double noise) {
  const double rounded = std::floor(value + noise + 0.5);
  return static_cast<std::uint8_t>(std::clamp(rounded, 0.0, 255.0));
}

}  // namespace

RobotSenses::RobotSenses(const World& world, const Arena& arena, const Profile& profile, int robot,
                         const Rng& run)
    : world_(&world),
      arena_(&arena),
      profile_(&profile),
      robot_(robot),
      proximity_noise_(run.split("proximity", static_cast<std::uint64_t>(robot)).key()),
      ground_noise_(run.split("ground", static_cast<std::uint64_t>(robot)).key()) {
  neighbours_.reserve(static_cast<std::size_t>(world.robots()));
  floor_ = floor_at(arena, floor_place_);
}

void RobotSenses::begin_cycle(const Cycle& cycle) {
  cycle_ = cycle;
  has_proximity_ = has_ground_ = has_neighbours_ = false;
}

const ProximityReadings& RobotSenses::proximity() {
  if (has_proximity_) return proximity_;
  has_proximity_ = true;
  const double range = profile_->proximity.range_m;
  proximity_ = ray_distances(*world_, robot_, range);
  for (std::size_t i = 0; i < proximity_.size(); ++i) {
    double& reading = proximity_[i];
    reading = limited(reading, range);
    if (profile_->proximity.sd_m == 0 || !std::isfinite(reading)) continue;
    const auto index = static_cast<std::uint64_t>(cycle_.number) * kProximitySensors + i;
    reading =
        limited(reading + profile_->proximity.sd_m * normal_at(proximity_noise_, index), range);
  }
  return proximity_;
}

Rgb RobotSenses::ground_color() {
  if (has_ground_) return ground_;
  has_ground_ = true;
  const Body& body = world_->body(robot_);
  const Point place = {body.x + kGroundSensorAhead_m * body.cos,
                       body.y + kGroundSensorAhead_m * body.sin};
  if (place != floor_place_) {  // robots often stand
    floor_place_ = place;
    floor_ = floor_at(*arena_, place);
  }
  ground_ = floor_;
  const double sd = profile_->ground_color.sd;
  if (sd != 0) {
    const auto index = static_cast<std::uint64_t>(cycle_.number) * 3;
    ground_.r = noisy_channel(ground_.r, sd * normal_at(ground_noise_, index));
    ground_.g = noisy_channel(ground_.g, sd * normal_at(ground_noise_, index + 1));
    ground_.b = noisy_channel(ground_.b, sd * normal_at(ground_noise_, index + 2));
  }
  return ground_;
}

std::span<const Neighbour> RobotSenses::neighbours() {
  if (!has_neighbours_) {
    has_neighbours_ = true;
    find_neighbours(*world_, robot_, neighbours_);
  }
  return neighbours_;
}

const LightReadings& RobotSenses::light() {
  return light_;
}

const Readings& RobotSenses::read(Sensors sensors) {
  if (sensors.has(Sensor::GroundColor)) readings_.ground_color = ground_color();
  if (sensors.has(Sensor::Proximity)) readings_.proximity_m = proximity();
  if (sensors.has(Sensor::Neighbours)) {
    const std::span<const Neighbour> seen = neighbours();
    readings_.neighbours.assign(seen.begin(), seen.end());
  }
  return readings_;
}

}  // namespace swarmsmith
