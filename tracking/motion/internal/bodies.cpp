#include "tracking/motion/internal/bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "base/assert.h"
#include "base/math.h"
#include "base/plain_text.h"
#include "sim/mission/footprint.h"
#include "tracking/motion/resampling.h"

namespace swarmsmith {
namespace {

/// Bodies may be this deep in each other: walls give way, and survey, heights and offsets have
/// errors.
constexpr double kDeep_m = 0.03;
/// Depths that last shorter than this in all are not counted: a wrong sample, or a carried robot.
constexpr int kLeastCycles = 10;

constexpr Question kBodies{"bodies beside each other", "mm",
                           "robots that are smaller than the mission's robot"};

/// The overlap of two extents along a line; negative for a gap.
double overlap_of(const Footprint::Extent& a, const Footprint::Extent& b) {
  return std::min(a.most - b.least, b.most - a.least);
}

/// The least overlap along the normals of the sides of `a`, and, for a circle, along the lines from
/// its middle to the corners of `b` and to its middle.
double least_overlap(const Footprint& a, const Footprint& b) {
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](double x, double y) {
    const double length = hypot(x, y);
    if (!(length > 0)) return;
    least = std::min(least,
                     overlap_of(a.along(x / length, y / length), b.along(x / length, y / length)));
  };
  const auto corners = a.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point& to = corners[(i + 1) % corners.size()];
    look(to.y - corners[i].y, corners[i].x - to.x);
  }
  if (!corners.empty()) return least;
  for (const Point& corner : b.corners())
    look(corner.x - a.centre().x, corner.y - a.centre().y);
  look(b.centre().x - a.centre().x, b.centre().y - a.centre().y);
  return least;
}

/// How far one of two bodies would have to move until they no longer overlap; 0 if they do not.
double depth_of(const Footprint& a, const Footprint& b) {
  return std::max(0.0, std::min(least_overlap(a, b), least_overlap(b, a)));
}

/// How far a body reaches beyond the face of a wall; 0 if it does not, or if its middle is outside.
double depth_in_walls(const Footprint& body, const Arena& arena) {
  double depth = 0;
  if (!is_inside(arena, body.centre())) return depth;
  for (const Wall& wall : arena.walls) {
    if (!crosses(body, wall)) continue;
    const double dx = wall.to.x - wall.from.x;
    const double dy = wall.to.y - wall.from.y;
    const double length = hypot(dx, dy);
    const Point normal{dy / length, -dx / length};
    const double face = wall.from.x * normal.x + wall.from.y * normal.y;
    const Footprint::Extent extent = body.along(normal.x, normal.y);
    const double middle = body.centre().x * normal.x + body.centre().y * normal.y;
    depth = std::max(depth, middle < face ? extent.most - face : face - extent.least);
  }
  return depth;
}

/// A robot and what it is inside of, over the run.
struct Pair {
  std::string who;  ///< "rvr1 and rvr2 were", "rvr1 was"
  std::string where;
  std::vector<double> depths;  ///< in cycles in which they overlap
  int deep_cycles = 0;         ///< deeper than the limit
  int first_cycle = 0;
  int last_cycle = 0;

  void look(int cycle, double depth_m) {
    if (!(depth_m > 0)) return;
    depths.push_back(depth_m);
    if (!(depth_m > kDeep_m)) return;
    if (deep_cycles++ == 0) first_cycle = cycle;
    last_cycle = cycle;
  }

  /// The depth that was reached or exceeded in `kLeastCycles`.
  double lasting_depth_m() const {
    if (depths.size() < kLeastCycles) return 0;
    std::vector<double> sorted = depths;
    const auto at = sorted.begin() + kLeastCycles - 1;
    std::nth_element(sorted.begin(), at, sorted.end(), std::greater());
    return *at;
  }
};

/// All robots that were measured in a cycle, against all that they may touch. Robots are compared
/// as the largest discs that lie in their outline: where two corners meet, real robots may be
/// rounder.
class Bodies {
 public:
  Bodies(const std::vector<RobotTrack>& tracks, const Arena& arena, const Outline& outline,
         const TrackedRun& run)
      : tracks_(tracks), arena_(arena), disc_(CircleOutline{inradius_of(outline)}), run_(run) {
    for (const Obstacle& obstacle : arena.obstacles)
      obstacles_.emplace_back(obstacle.outline, obstacle.pose);
  }

  std::vector<Pair> look() const {
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      const std::string& name = run_.robots[i].name;
      pairs.push_back({name + " was", "a wall"});
      look_at(i, pairs.back(),
              [&](int, const Footprint& body) { return depth_in_walls(body, arena_); });
      pairs.push_back({name + " was", "an obstacle"});
      look_at(i, pairs.back(), [&](int, const Footprint& body) {
        double depth = 0;
        for (const Footprint& obstacle : obstacles_)
          depth = std::max(depth, depth_of(body, obstacle));
        return depth;
      });
      for (std::size_t k = i + 1; k < tracks_.size(); ++k) {
        pairs.push_back({name + " and " + run_.robots[k].name + " were", "each other"});
        look_at(i, pairs.back(), [&](int cycle, const Footprint& body) {
          return is_measured(k, cycle) ? depth_of(body, body_of(k, cycle)) : 0;
        });
      }
    }
    return pairs;
  }

 private:
  template <class Depth>
  void look_at(std::size_t robot, Pair& pair, const Depth& depth) const {
    for (int cycle = 1; cycle <= run_.trajectory.instants(); ++cycle) {
      if (is_measured(robot, cycle)) pair.look(cycle, depth(cycle, body_of(robot, cycle)));
    }
  }

  bool is_measured(std::size_t robot, int cycle) const {
    return tracks_[robot].kinds[static_cast<std::size_t>(cycle)] == CycleKind::Measured;
  }

  Footprint body_of(std::size_t robot, int cycle) const {
    return {disc_, run_.trajectory.at(cycle - 1)[robot]};
  }

  const std::vector<RobotTrack>& tracks_;
  const Arena& arena_;
  Outline disc_;
  const TrackedRun& run_;
  std::vector<Footprint> obstacles_;
};

}  // namespace

void judge_bodies(const std::vector<RobotTrack>& tracks, const Arena& arena,
                  const TrackOptions& options, TrackedRun& run) {
  SWARMSMITH_ASSERT(tracks.size() == run.robots.size(), "each robot of the run has a track");
  const std::vector<Pair> pairs = Bodies(tracks, arena, options.body, run).look();
  const auto worst = std::ranges::max_element(pairs, {}, &Pair::lasting_depth_m);
  const double depth_m = worst == pairs.end() ? 0 : worst->lasting_depth_m();
  const bool is_deep = depth_m > kDeep_m;
  run.checks.push_back(answered(kBodies, "",
                                is_deep ? Check::Outcome::Warned : Check::Outcome::Passed,
                                1000 * depth_m, 1000 * kDeep_m));
  if (!is_deep) return;
  const auto others = std::ranges::count_if(pairs, [&](const Pair& pair) {
    return &pair != &*worst && pair.lasting_depth_m() > kDeep_m;
  });
  run.issues.push_back(
      {IssueCode::BodiesOverlap,
       fmt::format(
           "{} {:.0f} mm inside {} or more (limit {:.0f} mm) for {:.1f} s in all{}: robots "
           "cannot be there; is the mission's robot larger than those in the film? name the "
           "right one in the mission (`robot`), or measure `height` and offset of the tags",
           worst->who, 1000 * depth_m, worst->where, 1000 * kDeep_m,
           worst->deep_cycles * instant_s(1),
           others == 0
               ? ""
               : (others == 1 ? ", and so was " : ", and so were ") + counted(others, "other")),
       {},
       instant_s(worst->first_cycle),
       instant_s(worst->last_cycle)});
}

}  // namespace swarmsmith
