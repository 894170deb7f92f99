#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/math.h"
#include "base/plain_text.h"
#include "sim/control/reference_model.h"
#include "tracking/robots/reality.h"

namespace swarmsmith {
namespace {

/// A robot nearer than the range minus this is within the range despite the noise.
constexpr double kEdge_m = 0.05;
/// Largest distance between a seen neighbour and the robot: the robot moves between reading and
/// cycle, and a lidar sees the near side of it.
constexpr double kOff_m = 0.25;
constexpr double kBlock_s = 2;
constexpr std::int64_t kLeastChances = 50;
constexpr std::size_t kLeastBlocks = 5;
/// If more than this share of the seen neighbours do not exist, directions or logs are wrong.
constexpr double kMostPhantoms = 0.5;

/// Poses of all robots at a time of the run; none if the camera does not know the pose of one.
std::optional<std::vector<Pose>> poses_at(const TrackedRun& run, double time_s) {
  if (run.starts.size() != run.robots.size()) return std::nullopt;
  const double place = time_s / kControlPeriod_s;
  const auto last = static_cast<double>(run.trajectory.instants());
  if (last < 1 || place < 0 || place > last) return std::nullopt;
  const int before = std::min(static_cast<int>(place), run.trajectory.instants() - 1);
  const double share = place - before;
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < run.robots.size(); ++i) {
    if (run.robots[i].cycles[static_cast<std::size_t>(before)] == CycleKind::Missing) return {};
    const Pose& from = before == 0 ? run.starts[i] : run.trajectory.at(before - 1)[i];
    const Pose& to = run.trajectory.at(before)[i];
    poses.push_back({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y),
                     from.theta + share * wrap_angle(to.theta - from.theta)});
  }
  return poses;
}

/// Removes the nearest seen neighbour from `seen`, if it is near enough.
bool take(std::vector<Point>& seen, Point place) {
  const auto off = [&](Point point) { return hypot(point.x - place.x, point.y - place.y); };
  const auto nearest = std::ranges::min_element(seen, {}, off);
  if (nearest == seen.end() || off(*nearest) > kOff_m) return false;
  seen.erase(nearest);
  return true;
}

/// Chances to see a neighbour in a period, and how many were used.
struct Block {
  double there = 0;
  double seen = 0;
};

class Count {
 public:
  explicit Count(const RobotOfRun& of) : of_(of) {}

  void add(const LogRow& row, double age_s) {
    const double time_s = row.clock_s - begin_of(of_.log.record) - age_s;
    const auto poses = poses_at(of_.run, time_s);
    if (!poses) return;
    const Pose& own = (*poses)[of_.robot];
    const SinCos heading = sin_cos(own.theta);
    std::vector<Point> seen;
    for (const Neighbour& neighbour : row.sensed.neighbours) {
      const double x = neighbour.distance_m * neighbour.direction_x;
      const double y = neighbour.distance_m * neighbour.direction_y;
      seen.push_back(
          {own.x + heading.cos * x - heading.sin * y, own.y + heading.sin * x + heading.cos * y});
    }
    Block& block = blocks_[static_cast<std::int64_t>(std::floor(time_s / kBlock_s))];
    for (std::size_t other = 0; other < poses->size(); ++other) {
      if (other == of_.robot) continue;
      const Point place = (*poses)[other].position();
      // This comes before the check of the range: a neighbour that is seen at the edge of the range
      // is no chance, but no phantom either.
      const bool is_seen = take(seen, place);
      if (hypot(place.x - own.x, place.y - own.y) > kNeighbourRange_m - kEdge_m) continue;
      ++block.there;
      if (is_seen) ++block.seen;
    }
    phantoms_ += static_cast<std::int64_t>(seen.size());
    heard_ += static_cast<std::int64_t>(row.sensed.neighbours.size());
  }

  NeighboursSeen result() const {
    NeighboursSeen result;
    double there = 0;
    double seen = 0;
    std::size_t blocks = 0;
    for (const auto& [number, block] : blocks_) {
      there += block.there;
      seen += block.seen;
      if (block.there > 0) ++blocks;
    }
    result.there = static_cast<std::int64_t>(there);
    result.seen = static_cast<std::int64_t>(seen);
    result.phantoms = phantoms_;
    if (static_cast<double>(phantoms_) > kMostPhantoms * static_cast<double>(heard_)) {
      return {.reason = fmt::format(
                  "{} of the {} neighbours in its log are where no robot was; is its heading "
                  "calibrated (`calibrate robot --straight`)?",
                  phantoms_, heard_)};
    }
    if (result.there < kLeastChances || blocks < kLeastBlocks) {
      return {.reason = fmt::format(
                  "others were within {:.2f} m of it in {}, in {} of {:g} s, and {} in {} are "
                  "needed",
                  kNeighbourRange_m - kEdge_m, counted(result.there, "cycle"),
                  counted(blocks, "span"), kBlock_s, kLeastChances, kLeastBlocks)};
    }
    // The variance of a ratio estimator over blocks, as if the blocks were the sample: cycles that
    // follow each other are not independent.
    double squares = 0;
    for (const auto& [number, block] : blocks_)
      squares += std::pow(block.seen - seen / there * block.there, 2);
    const auto count = static_cast<double>(blocks);
    // No miss so far does not prove that there will never be one, so at least half a miss is
    // assumed.
    const double least =
        std::sqrt((seen + 0.5) * (there - seen + 0.5)) / (there + 1) / std::sqrt(there);
    result.error = std::max(std::sqrt(squares * count / (count - 1)) / there, least);
    return result;
  }

 private:
  const RobotOfRun& of_;
  std::map<std::int64_t, Block> blocks_;
  std::int64_t phantoms_ = 0;
  std::int64_t heard_ = 0;
};

}  // namespace

NeighboursSeen neighbours_of(const RobotOfRun& of) {
  if (of.log.neighbours) return *of.log.neighbours;
  Count count(of);
  bool is_heard = false;
  for (const LogRow& row : of.log.record.rows) {
    const auto& age_ms = row.age_ms[index_of(Feed::Neighbours)];
    if (row.act != Act::Step || !age_ms) continue;
    is_heard = true;
    count.add(row, *age_ms / 1000);
  }
  if (!is_heard) return {.reason = "its log has no neighbours: its machine does not look for them"};
  return count.result();
}

}  // namespace swarmsmith
