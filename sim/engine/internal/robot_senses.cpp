#include "sim/engine/internal/robot_senses.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/control/labeler.h"
#include "sim/control/lidar_clustering.h"
#include "sim/engine/internal/float32.h"
#include "sim/engine/internal/lidar.h"
#include "sim/engine/internal/light.h"
#include "sim/robot/robot_fields.h"

namespace swarmsmith {
namespace {

std::uint8_t noisy_channel(std::uint8_t value, double noise) {
  // Converted to an integer first: on black and on white floors a branch would be unpredictable.
  const double raised = value + noise + 0.5;
  return static_cast<std::uint8_t>(std::clamp(static_cast<int>(raised), 0, 255));
}

/// The grey level of white, as in gray_level.
constexpr double kMostGray = 255'000;

/// The rate at which this robot misses neighbours; it depends on whether the robot is weak for the
/// whole run.
double miss_rate_of_run(const NeighbourSensing& sensing, const Rng& run, int robot) {
  if (sensing.weak_share == 0) return sensing.miss_rate;
  Rng lot = run.split("weak neighbours", static_cast<std::uint64_t>(robot));
  return lot.bernoulli(sensing.weak_share) ? sensing.weak_miss_rate : sensing.miss_rate;
}

/// Adds uniform noise within the half-width to the values, then limits them to [0, 1]. Each random
/// number of the stream, from the `first` one on, gives four numbers of 16 bits.
void blur_strengths(std::span<double> values, double half_width, const NoiseStream& noise,
                    std::uint64_t first) {
  if (half_width > 0) {
    constexpr double kStep = 0x1.0p-16;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i % 4 == 0) bits = noise.at(first + i / 4).next();
      const double share = (static_cast<double>(bits & 0xffffU) + 0.5) * kStep;
      bits >>= 16U;
      values[i] += half_width * (2 * share - 1);
    }
  }
  for (double& value : values)
    value = std::clamp(value, 0.0, 1.0);
}

/// The first number of a cycle for blur_strengths.
std::uint64_t first_of_cycle(std::int64_t cycle, std::size_t values) {
  return static_cast<std::uint64_t>(cycle) * (numbers_per_cycle(values) / 4);
}

/// Length to which proximity rays must be computed.
double ray_range_m(const ProximityRing& ring, const Profile& profile) {
  return ring.reading == ProximityRing::Reading::Strength ? ring.reach_m
                                                          : profile.proximity.range_m;
}

}  // namespace

RobotSenses::RobotSenses(const World& world, const Arena& arena, const Profile& profile, int robot,
                         const Rng& run, bool splits_ground)
    : world_(&world),
      arena_(&arena),
      profile_(&profile),
      robot_(robot),
      sight_(world, arena.wall_height_m),
      motion_(world.body(robot)),
      proximity_rays_(world, robot, ray_range_m(world.robot().proximity, profile)),
      proximity_noise_(profile.proximity, run, robot, world.proximity_ring().count),
      distorts_proximity_(profile.float32_wire || profile.proximity.touch_is_nothing),
      is_vote_(world.robot().ground.reading == GroundSensor::Reading::Vote),
      ground_sensor_(world.robot().ground.places.front()),
      ground_hold_{.beats = driver_beats(profile.timing.driver_sub_steps, run, robot),
                   .next = profile.timing.driver_sub_steps == 0 ? Beats::kNever : 0},
      neighbour_hold_{
          .beats = Beats(profile.neighbours.every_sub_steps, run, "neighbour beats", robot),
          .next = profile.neighbours.every_sub_steps == 0 ? Beats::kNever : 0},
      neighbour_miss_rate_(miss_rate_of_run(profile.neighbours, run, robot)),
      splits_ground_(splits_ground) {
  const GroundColorSensing& ground = profile.ground_color;
  if (ground.sd > 0 || ground.half_width > 0) ground_noise_ = NoiseStream(run, "ground", robot);
  if (ground.bias_sd > 0) {
    ground_bias_ = ground.bias_sd * NoiseStream(run, "ground bias", robot).normal(0);
  }
  if (profile.lidar.half_width_m > 0) lidar_noise_ = NoiseStream(run, "lidar", robot);
  if (neighbour_miss_rate_ > 0) neighbour_misses_ = NoiseStream(run, "neighbour misses", robot);
  if (profile.light.half_width > 0) light_noise_ = NoiseStream(run, "light", robot);
  if (profile.proximity.half_width > 0) strength_noise_ = NoiseStream(run, "strength", robot);
  readings_.neighbours.reserve(static_cast<std::size_t>(world.robots()));
  floor_ = floor_at(arena, floor_place_);
  read_at_beat(0);
}

void RobotSenses::remember(Sensors sensors) {
  const Robot& robot = world_->robot();
  if (sensors.has(Sensor::GroundColor) && robot.ground.reading == GroundSensor::Reading::Vote) {
    remembered_ = remembered_ | Sensor::GroundColor;
  }
  if (sensors.has(Sensor::Neighbours) &&
      robot.neighbours.source == NeighbourSensor::Source::Radio) {
    remembered_ = remembered_ | Sensor::Neighbours;
  }
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

ProximityReadings RobotSenses::proximity() {
  const Ring& ring = world_->proximity_ring();
  if (is_due(Sensor::Proximity)) {
    if (world_->robot().proximity.reading == ProximityRing::Reading::Strength) {
      read_strengths();
    } else {
      proximity_rays_.cast(proximity_m_);
      proximity_noise_.apply(std::span(proximity_m_).first(ring.count), cycle_.number);
      if (distorts_proximity_) distort(std::span(proximity_m_).first(ring.count));
    }
  }
  return std::span(proximity_m_).first(ring.readings);
}

void RobotSenses::read_strengths() {
  const ProximityRing& robot = world_->robot().proximity;
  const Ring& ring = world_->proximity_ring();
  proximity_rays_.cast(proximity_m_);
  for_each_reading(ring.readings, [&](std::size_t i) {
    const double d = proximity_m_[i];
    const double strength =
        d <= robot.reach_m ? robot.law[0] + (robot.law[1] + robot.law[2] * d) * d : 0;
    proximity_m_[i] = std::clamp(strength, 0.0, 1.0);
  });
  blur_strengths(std::span(proximity_m_).first(ring.count), profile_->proximity.half_width,
                 strength_noise_, first_of_cycle(cycle_.number, ring.count));
}

FrontProximity RobotSenses::front_proximity() {
  if (computed_.has(Sensor::Proximity) ||
      world_->robot().proximity.reading == ProximityRing::Reading::Strength)
    return Senses::front_proximity();
  proximity_rays_.cast(front_m_);
  const auto front = std::span(front_m_).first<kFrontSensors>();
  proximity_noise_.apply(front, cycle_.number);
  if (distorts_proximity_) distort(front);
  return front;
}

const Rgb& RobotSenses::ground_color() {
  Rgb& ground = readings_.ground_color;
  if (!is_due(Sensor::GroundColor)) return ground;
  if (is_vote_) {
    count_votes();
    return ground;
  }
  const Body& body = world_->body(robot_);
  const Point& sensor = ground_sensor_;
  Point place = {body.x + sensor.x * body.cos, body.y + sensor.x * body.sin};
  if (sensor.y != 0) place = {place.x - sensor.y * body.sin, place.y + sensor.y * body.cos};
  if (place != floor_place_) {  // robots often stand still
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

void RobotSenses::count_votes() {
  const GroundSensor& sensor = world_->robot().ground;
  const Body& body = world_->body(robot_);
  std::array<double, kMostGroundPoints> levels{};
  const std::size_t count = std::min(sensor.places.size(), levels.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Point& place = sensor.places[i];
    const Rgb floor = floor_at(*arena_, {body.x + place.x * body.cos - place.y * body.sin,
                                         body.y + place.x * body.sin + place.y * body.cos});
    levels[i] = gray_level(floor) / kMostGray;
  }
  blur_strengths(std::span(levels).first(count), profile_->ground_color.half_width, ground_noise_,
                 first_of_cycle(cycle_.number, kMostGroundPoints));
  if (splits_ground_) {
    const auto channel = [&](std::size_t index) {
      return noisy_channel(0, 255 * levels[std::min(index, count - 1)]);
    };
    readings_.ground_color = {channel(0), channel(1), channel(2)};
    return;
  }
  Votes now;
  for (std::size_t i = 0; i < count; ++i) {
    now.black += levels[i] < sensor.black_below ? 1 : 0;
    now.white += levels[i] > sensor.white_above ? 1 : 0;
  }
  if (votes_.empty()) votes_.resize(static_cast<std::size_t>(sensor.vote_ticks));
  // A ring over the last cycles; `remember` makes sure that each cycle votes.
  Votes& oldest = votes_[static_cast<std::size_t>(cycle_.number) % votes_.size()];
  vote_.black += now.black - oldest.black;
  vote_.white += now.white - oldest.white;
  oldest = now;
  Rgb& ground = readings_.ground_color;
  ground = {127, 127, 127};
  if (vote_.black > sensor.vote_majority) {
    ground = {0, 0, 0};
  } else if (vote_.white > sensor.vote_majority) {
    ground = {255, 255, 255};
  }
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
  if (world_->robot().neighbours.source == NeighbourSensor::Source::Radio) {
    receive_packets();
    return readings_.neighbours;
  }
  if (profile_->neighbours.source == NeighbourSensing::Source::Camera) {
    find_neighbours(*world_, sight_, robot_, room_, readings_.neighbours);
    if (profile_->float32_wire) {
      for (Neighbour& seen : readings_.neighbours) {
        seen = {as_float32(seen.distance_m), as_float32(seen.direction_x),
                as_float32(seen.direction_y)};
      }
    }
  } else {
    turret_ranges_m_.resize(kLidarRays);
    scan_turrets(*world_, sight_, robot_, turret_ranges_m_);
    add_lidar_noise(turret_ranges_m_, profile_->lidar.half_width_m, lidar_noise_, cycle_.number);
    round_scan(turret_ranges_m_);
    cluster_lidar(turret_ranges_m_, readings_.neighbours);
  }
  if (neighbour_miss_rate_ > 0) drop_missed_neighbours();
  readings_.neighbour_count = static_cast<int>(readings_.neighbours.size());
  return readings_.neighbours;
}

int RobotSenses::neighbour_count() {
  if (!computed_.has(Sensor::Neighbours)) neighbours();
  return readings_.neighbour_count;
}

/// Each robot within range sends one packet per cycle. A packet may be lost or blocked on its way;
/// otherwise it is kept until it reaches the age of the memory.
void RobotSenses::receive_packets() {
  const NeighbourSensor& radio = world_->robot().neighbours;
  std::vector<Neighbour>& known = readings_.neighbours;
  if (packets_.empty()) packets_.resize(static_cast<std::size_t>(radio.memory_ticks));
  int& oldest = packets_[static_cast<std::size_t>(cycle_.number) % packets_.size()];
  // Packets are kept in the order of their cycles, so the expired ones are the first.
  known.erase(known.begin(), known.begin() + oldest);
  int heard_now = 0;
  const auto take = [&](int other) {
    if (other == robot_ || world_->distance2(robot_, other) >= radio.range_m * radio.range_m)
      return;
    if (sight_.is_hidden(robot_, other, between_)) return;
    const Neighbour heard = neighbour_of(*world_, robot_, other);
    // The e-puck's reference model interprets a bearing of exactly 0 as no packet (epuck facts,
    // 4.1).
    if (heard.direction_y == 0 && heard.direction_x > 0) return;
    known.push_back(heard);
    ++heard_now;
  };
  // Sixteen random bits decide about each packet, so that four senders share one random number.
  const auto lost_below = static_cast<std::uint64_t>(std::lround(neighbour_miss_rate_ * 65'536));
  const int robots = world_->robots();
  const auto groups = static_cast<std::uint64_t>(robots + 3) / 4;
  const std::uint64_t first = static_cast<std::uint64_t>(cycle_.number) * groups;
  for (int group = 0; group < robots; group += 4) {
    // Most packets are lost. The loss is decided first, so that few positions are needed.
    std::uint64_t bits = neighbour_misses_.at(first + static_cast<std::uint64_t>(group) / 4).next();
    for (int other = group; other < std::min(group + 4, robots); ++other, bits >>= 16U) {
      if ((bits & 0xffffU) >= lost_below) take(other);
    }
  }
  oldest = heard_now;
  readings_.neighbour_count = heard_now;
}

void RobotSenses::drop_missed_neighbours() {
  // The number at an index decides about the k-th neighbour of the cycle; there are never more
  // neighbours than rays.
  const std::uint64_t first = static_cast<std::uint64_t>(cycle_.number) * kLidarRays;
  std::vector<Neighbour>& neighbours = readings_.neighbours;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    if (neighbour_misses_.at(first + k).bernoulli(neighbour_miss_rate_)) continue;
    neighbours[kept++] = neighbours[k];
  }
  neighbours.resize(kept);
}

LightReadings RobotSenses::light() {
  const Ring& ring = world_->light_ring();
  const auto readings = std::span(light_lux_).first(ring.readings);
  if (is_due(Sensor::LightRing)) {
    light_ring(*world_, *arena_, robot_, room_, readings);
    if (world_->robot().light.reading == LightRing::Reading::Strength) {
      blur_strengths(readings.first(ring.count), profile_->light.half_width, light_noise_,
                     first_of_cycle(cycle_.number, ring.count));
    }
  }
  return readings;
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
  if (sensors.has(Sensor::Proximity)) {
    const ProximityReadings proximity = this->proximity();
    readings_.proximity_m.assign(proximity.begin(), proximity.end());
  }
  if (sensors.has(Sensor::Neighbours)) neighbours();
  if (sensors.has(Sensor::LightRing)) {
    const LightReadings light = this->light();
    readings_.light_lux.assign(light.begin(), light.end());
  }
  if (sensors.has(Sensor::FrontLight) && is_due(Sensor::FrontLight)) {
    readings_.front_light_lux = front_light(*world_, *arena_, robot_);
  }
  if (sensors.has(Sensor::Lidar) && is_due(Sensor::Lidar)) read_lidar();
  return readings_;
}

}  // namespace swarmsmith
