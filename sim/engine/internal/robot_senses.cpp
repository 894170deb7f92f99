#include "sim/engine/internal/robot_senses.h"

#include <algorithm>
#include <cmath>

#include "sim/control/labeler.h"
#include "sim/control/lidar_clustering.h"
#include "sim/engine/internal/float32.h"
#include "sim/engine/internal/lidar.h"
#include "sim/engine/internal/light.h"

namespace swarmsmith {
namespace {

std::uint8_t noisy_channel(std::uint8_t value, double noise) {
  // As a whole number first: on black and on white floors nobody could guess the way of a branch.
  const double raised = value + noise + 0.5;
  return static_cast<std::uint8_t>(std::clamp(static_cast<int>(raised), 0, 255));
}

/// Whether this robot has trouble for the whole run, and so how often it misses a neighbour.
double miss_rate_of_run(const NeighbourSensing& sensing, const Rng& run, int robot) {
  if (sensing.weak_share == 0) return sensing.miss_rate;
  Rng lot = run.split("weak neighbours", static_cast<std::uint64_t>(robot));
  return lot.bernoulli(sensing.weak_share) ? sensing.weak_miss_rate : sensing.miss_rate;
}

}  // namespace

RobotSenses::RobotSenses(const World& world, const Arena& arena, const Profile& profile, int robot,
                         const Rng& run)
    : world_(&world),
      arena_(&arena),
      profile_(&profile),
      robot_(robot),
      motion_(world.body(robot)),
      proximity_rays_(world, robot, profile.proximity.range_m),
      proximity_noise_(profile.proximity, run, robot),
      distorts_proximity_(profile.float32_wire || profile.proximity.touch_is_nothing),
      ground_hold_{.beats = driver_beats(profile.timing.driver_sub_steps, run, robot),
                   .next = profile.timing.driver_sub_steps == 0 ? Beats::kNever : 0},
      neighbour_hold_{
          .beats = Beats(profile.neighbours.every_sub_steps, run, "neighbour beats", robot),
          .next = profile.neighbours.every_sub_steps == 0 ? Beats::kNever : 0},
      neighbour_miss_rate_(miss_rate_of_run(profile.neighbours, run, robot)) {
  const GroundColorSensing& ground = profile.ground_color;
  if (ground.sd > 0) ground_noise_ = NoiseStream(run, "ground", robot);
  if (ground.bias_sd > 0) {
    ground_bias_ = ground.bias_sd * NoiseStream(run, "ground bias", robot).normal(0);
  }
  if (profile.lidar.half_width_m > 0) lidar_noise_ = NoiseStream(run, "lidar", robot);
  if (neighbour_miss_rate_ > 0) neighbour_misses_ = NoiseStream(run, "neighbour misses", robot);
  readings_.neighbours.reserve(static_cast<std::size_t>(world.robots()));
  floor_ = floor_at(arena, floor_place_);
  read_at_beat(0);
}

void RobotSenses::read_at_beat(std::int64_t now) {
  const std::int64_t cycle = cycle_.number;
  if (has_beat(Sensor::GroundColor, ground_hold_, now)) ground_color();
  if (has_beat(Sensor::Neighbours, neighbour_hold_, now)) neighbours();
  cycle_.number = cycle;
}

bool RobotSenses::has_beat(Sensor sensor, Hold& hold, std::int64_t now) {
  if (hold.next != now) return false;
  hold.next = hold.beats.after(now);
  cycle_.number = hold.readings++;
  held_ = held_ | sensor;
  computed_ = computed_.without(sensor);
  return true;
}

void RobotSenses::distort(std::span<double> proximity) const {
  for (double& reading : proximity) {
    if (profile_->proximity.touch_is_nothing && std::isinf(reading)) reading = HUGE_VAL;
    if (profile_->float32_wire) reading = as_float32(reading);
  }
}

bool RobotSenses::is_due(Sensor sensor) {
  if (computed_.has(sensor)) return false;
  computed_ = computed_ | sensor;
  return true;
}

const ProximityReadings& RobotSenses::proximity() {
  if (is_due(Sensor::Proximity)) {
    proximity_rays_.cast(readings_.proximity_m);
    proximity_noise_.apply(readings_.proximity_m, cycle_.number);
    if (distorts_proximity_) distort(readings_.proximity_m);
  }
  return readings_.proximity_m;
}

FrontProximity RobotSenses::front_proximity() {
  if (computed_.has(Sensor::Proximity)) return Senses::front_proximity();
  proximity_rays_.cast(front_m_);
  const auto front = std::span(front_m_).first<kFrontSensors>();
  proximity_noise_.apply(front, cycle_.number);
  if (distorts_proximity_) distort(front);
  return front;
}

const Rgb& RobotSenses::ground_color() {
  Rgb& ground = readings_.ground_color;
  if (!is_due(Sensor::GroundColor)) return ground;
  const Body& body = world_->body(robot_);
  const Point place = {body.x + kGroundSensorAhead_m * body.cos,
                       body.y + kGroundSensorAhead_m * body.sin};
  if (place != floor_place_) {  // robots often stand
    floor_place_ = place;
    floor_ = floor_at(*arena_, place);
  }
  const GroundColorSensing& sensing = profile_->ground_color;
  if (sensing.sd > 0 || sensing.bias_sd > 0) {
    blur(floor_, ground);
  } else {
    ground = floor_;
  }
  if (sensing.labeler) ground = nearest_label(ground, sensing.labels);
  return ground;
}

void RobotSenses::blur(const Rgb& floor, Rgb& ground) const {
  const double sd = profile_->ground_color.sd;
  const auto first = static_cast<std::uint64_t>(cycle_.number) * 3;
  const auto channel = [&](std::uint8_t value, std::uint64_t number) {
    const double noise = sd > 0 ? sd * ground_noise_.normal(first + number) : 0;
    return noisy_channel(value, ground_bias_ + noise);
  };
  ground.r = channel(floor.r, 0);
  ground.g = channel(floor.g, 1);
  ground.b = channel(floor.b, 2);
}

std::span<const Neighbour> RobotSenses::neighbours() {
  if (!is_due(Sensor::Neighbours)) return readings_.neighbours;
  if (profile_->neighbours.source == NeighbourSensing::Source::Camera) {
    find_neighbours(*world_, robot_, room_, readings_.neighbours);
    if (profile_->float32_wire) {
      for (Neighbour& seen : readings_.neighbours) {
        seen = {as_float32(seen.distance_m), as_float32(seen.direction_x),
                as_float32(seen.direction_y)};
      }
    }
  } else {
    turret_ranges_m_.resize(kLidarRays);
    scan_turrets(*world_, robot_, turret_ranges_m_);
    add_lidar_noise(turret_ranges_m_, profile_->lidar.half_width_m, lidar_noise_, cycle_.number);
    round_scan(turret_ranges_m_);
    cluster_lidar(turret_ranges_m_, readings_.neighbours);
  }
  if (neighbour_miss_rate_ > 0) drop_missed_neighbours();
  return readings_.neighbours;
}

void RobotSenses::drop_missed_neighbours() {
  // The number at an index decides on the cycle's k-th neighbour; there are never as many as rays.
  const std::uint64_t first = static_cast<std::uint64_t>(cycle_.number) * kLidarRays;
  std::vector<Neighbour>& neighbours = readings_.neighbours;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    if (neighbour_misses_.at(first + k).bernoulli(neighbour_miss_rate_)) continue;
    neighbours[kept++] = neighbours[k];
  }
  neighbours.resize(kept);
}

const LightReadings& RobotSenses::light() {
  if (is_due(Sensor::LightRing)) readings_.light_lux = light_ring(*world_, *arena_, robot_);
  return readings_.light_lux;
}

void RobotSenses::read_motion(Sensors sensors) {
  const Body& body = world_->body(robot_);
  const auto wants = [&](Sensor sensor) { return sensors.has(sensor) && is_due(sensor); };
  if (wants(Sensor::Velocity)) readings_.velocity_mps = motion_.velocity(body, cycle_.acted);
  if (wants(Sensor::Accelerometer)) {
    readings_.acceleration_g = motion_.acceleration(body, cycle_.acted);
  }
  if (wants(Sensor::Gyroscope)) readings_.spin_radps = motion_.spin(body);
  if (wants(Sensor::Imu)) readings_.orientation = MotionSensors::orientation(body);
  if (wants(Sensor::Locator)) readings_.position_m = motion_.position(body);
  if (wants(Sensor::Quaternion)) readings_.rotation = motion_.rotation(body);
}

void RobotSenses::read_lidar() {
  readings_.lidar_m.resize(kLidarRays);
  const bool within_limits = scan_surroundings(*world_, robot_, readings_.lidar_m);
  if (!within_limits || profile_->lidar.half_width_m > 0)
    add_lidar_noise(readings_.lidar_m, profile_->lidar.half_width_m, lidar_noise_, cycle_.number);
  round_scan(readings_.lidar_m);
}

void RobotSenses::round_scan(std::span<double> ranges_m) const {
  if (!profile_->float32_wire) return;
  for (double& range : ranges_m)
    range = as_float32(range);
}

const Readings& RobotSenses::read(Sensors sensors) {
  read_motion(sensors);
  if (sensors.has(Sensor::GroundColor)) ground_color();
  if (sensors.has(Sensor::Proximity)) proximity();
  if (sensors.has(Sensor::Neighbours)) neighbours();
  if (sensors.has(Sensor::LightRing)) light();
  if (sensors.has(Sensor::FrontLight) && is_due(Sensor::FrontLight)) {
    readings_.front_light_lux = front_light(*world_, *arena_, robot_);
  }
  if (sensors.has(Sensor::Lidar) && is_due(Sensor::Lidar)) read_lidar();
  return readings_;
}

}  // namespace swarmsmith
