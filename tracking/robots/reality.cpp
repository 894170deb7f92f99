#include "tracking/robots/reality.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "base/math.h"
#include "base/overloaded.h"
#include "tracking/robots/delays.h"

namespace swarmsmith {
namespace {

/// A robot may touch things that are nearer than this.
constexpr double kRoom_m = 0.03;
constexpr std::int64_t kLeastCycles = 50;

/// The distance from the centre to the farthest corner.
double radius_of(const Outline& outline) {
  return std::visit(
      Overloaded{[](const CircleOutline& circle) { return circle.radius_m; },
                 [](const BoxOutline& box) { return hypot(box.length_m, box.width_m) / 2; },
                 [](const PolygonOutline& polygon) {
                   double radius_m = 0;
                   for (const Point& corner : polygon.corners)
                     radius_m = std::max(radius_m, hypot(corner.x, corner.y));
                   return radius_m;
                 }},
      outline);
}

double distance_to(const Wall& wall, Point point) {
  const double dx = wall.to.x - wall.from.x;
  const double dy = wall.to.y - wall.from.y;
  const double px = point.x - wall.from.x;
  const double py = point.y - wall.from.y;
  const double length2 = dx * dx + dy * dy;
  const double share = length2 == 0 ? 0 : std::clamp((px * dx + py * dy) / length2, 0.0, 1.0);
  return hypot(px - share * dx, py - share * dy);
}

/// Whether the robot touches neither a wall nor another robot at an instant.
bool is_free_at(const RobotOfRun& of, std::span<const Pose> poses) {
  const Point own = poses[of.robot].position();
  const double reach_m = radius_of(of.mission.robot.body.outline) + kRoom_m;
  const auto is_near = [&](const Pose& pose, double radius_m) {
    return hypot(pose.x - own.x, pose.y - own.y) < reach_m + radius_m;
  };
  for (const Wall& wall : of.mission.arena.walls) {
    if (distance_to(wall, own) < reach_m) return false;
  }
  for (const Obstacle& obstacle : of.mission.arena.obstacles) {
    if (is_near(obstacle.pose, radius_of(obstacle.outline))) return false;
  }
  for (std::size_t other = 0; other < poses.size(); ++other) {
    if (other != of.robot && is_near(poses[other], reach_m - kRoom_m)) return false;
  }
  return true;
}

/// For each instant, whether the robot is free; index 0 is the start.
std::vector<bool> free_instants(const RobotOfRun& of) {
  if (of.run.starts.size() != of.run.robots.size()) return {};  // initial positions are unknown
  std::vector<bool> free{is_free_at(of, of.run.starts)};
  for (int instant = 0; instant < of.run.trajectory.instants(); ++instant)
    free.push_back(is_free_at(of, of.run.trajectory.at(instant)));
  return free;
}

std::vector<std::pair<int, double>> states_of(const RunRecord& record) {
  std::map<int, double> seconds;
  for (std::size_t i = 0; i < record.rows.size(); ++i) {
    const bool is_last = i + 1 == record.rows.size();
    seconds[record.rows[i].state] +=
        is_last ? record.head.period_s : record.rows[i + 1].clock_s - record.rows[i].clock_s;
  }
  return {seconds.begin(), seconds.end()};
}

std::optional<double> period_of(const RunRecord& record) {
  if (record.rows.empty()) return std::nullopt;
  const LogRow& first = record.rows.front();
  const LogRow& last = record.rows.back();
  if (last.cycle - first.cycle < kLeastCycles) return std::nullopt;
  return (last.clock_s - first.clock_s) / static_cast<double>(last.cycle - first.cycle);
}

}  // namespace

double begin_of(const RunRecord& record) {
  return record.head.start_clock_s + record.head.clock_offset_s.value_or(0);
}

std::vector<TimedCommand> commands_of(const RunRecord& record) {
  // A robot starts when its own clock reaches the start time.
  const double begin_s = begin_of(record);
  std::vector<TimedCommand> commands;
  commands.reserve(record.rows.size());
  for (const LogRow& row : record.rows)
    commands.push_back({row.clock_s - begin_s, row.command.left_mps, row.command.right_mps});
  return commands;
}

Reality reality_of(const RobotOfRun& of, const Latency& latency) {
  const std::vector<bool> free = free_instants(of);
  const auto is_free = [&](double from_s, double to_s) {
    const auto first = static_cast<std::size_t>(std::max(0.0, std::floor(from_s / 0.1)));
    const auto last = static_cast<std::size_t>(std::max(0.0, std::ceil(to_s / 0.1)));
    if (from_s < 0 || last >= free.size()) return false;
    return std::all_of(free.begin() + static_cast<std::ptrdiff_t>(first),
                       free.begin() + static_cast<std::ptrdiff_t>(last) + 1,
                       [](bool one) { return one; });
  };
  const TrackedRobot& robot = of.run.robots[of.robot];
  const std::vector<Sample>& samples = robot.samples;
  const std::vector<TimedCommand> commands = commands_of(of.log.record);
  Slip slip = slip_of(commands, samples, latency.seconds, is_free);
  std::vector<double> delays_s;
  // A latency that varies much is not given as a number, but single commands still show it.
  const bool follows = latency.agreement.value_or(0) >= kLeastAgreement && !latency.beyond;
  slip.way.is_against = slip.way.is_against && follows && robot.has_heading;
  if (follows && slip.turn.gain)
    delays_s = delays_of(commands, samples, latency.seconds, *slip.turn.gain, is_free);
  return {.latency = latency,
          .slip = std::move(slip),
          .delays_s = std::move(delays_s),
          .neighbours = neighbours_of(of),
          .period_s = period_of(of.log.record),
          .states_s = states_of(of.log.record)};
}

}  // namespace swarmsmith
