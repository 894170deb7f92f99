#include "tracking/overlay/overlay_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/math.h"
#include "sim/mission/score.h"

namespace swarmsmith {
namespace {

constexpr double kTrail_s = 5;
/// Time for which an issue of a single instant is shown.
constexpr double kIssueShown_s = 1;

/// The tile on which a robot is, as in CoverageScorer.
std::optional<std::size_t> tile_of(const Coverage& rule, const Pose& robot) {
  const double tiles = rule.tiles;
  const double column = robot.x * tiles / rule.side_m + 0.5 * tiles;
  const double row = robot.y * tiles / rule.side_m + 0.5 * tiles;
  if (!(column >= 0 && column < tiles && row >= 0 && row < tiles)) return std::nullopt;
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(rule.tiles) +
         static_cast<std::size_t>(column);
}

Pose between(const Pose& a, const Pose& b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
          wrap_angle(a.theta + share * wrap_angle(b.theta - a.theta))};
}

bool concerns(const Issue& issue, double time_s) {
  if (!issue.from.has_value()) return false;
  return *issue.from <= time_s &&
         time_s <= std::max(issue.to.value_or(0), *issue.from + kIssueShown_s);
}

}  // namespace

OverlayRun::OverlayRun(const TrackedRun& run, const Rig& rig, Mission mission,
                       std::vector<Issue> issues)
    : mission_(std::move(mission)), issues_(std::move(issues)), cycles_(run.trajectory.instants()) {
  for (std::size_t i = 0; i < run.robots.size(); ++i) {
    const TrackedRobot& tracked = run.robots[i];
    Robot robot{tracked.name, 0, {run.starts.at(i)}, tracked.cycles};
    for (const RobotSetup& setup : rig.robots)
      if (setup.name == tracked.name) robot.height_m = setup.height_m;
    for (int instant = 0; instant < cycles_; ++instant)
      robot.poses.push_back(run.trajectory.at(instant)[i]);
    robots_.push_back(std::move(robot));
  }
  const auto* const coverage = std::get_if<Coverage>(&mission_.rule);
  if (coverage != nullptr)
    visits_.resize(static_cast<std::size_t>(coverage->tiles) *
                   static_cast<std::size_t>(coverage->tiles));
  Scorer scorer(mission_.rule, mission_.arena);
  for (int instant = 0; instant < cycles_; ++instant) {
    std::vector<Point> places;
    for (const Pose& pose : run.trajectory.at(instant)) {
      places.push_back({pose.x, pose.y});
      if (coverage == nullptr) continue;
      if (const auto tile = tile_of(*coverage, pose)) visits_[*tile].push_back(instant + 1);
    }
    scorer.observe(places);
    scores_.push_back(scorer.score());
  }
}

double OverlayRun::duration_s() const {
  return cycles_ * kControlPeriod_s;
}

OverlayMoment OverlayRun::at(double time_s) const {
  OverlayMoment moment;
  moment.time_s = time_s;
  for (const Issue& issue : issues_)
    if (concerns(issue, time_s))
      moment.issues.push_back(std::string(name_of(issue.code)) + " " +
                              (issue.robot.empty() ? "" : issue.robot + ": ") + issue.text);
  if (time_s < 0 || cycles_ == 0) return moment;
  const double place = std::min(time_s / kControlPeriod_s, static_cast<double>(cycles_));
  // A frame at an instant shows this instant, however the clock's offset was rounded.
  const auto done = static_cast<int>(std::floor(place + 1e-6));
  const auto before = static_cast<std::size_t>(done);
  const auto after = static_cast<std::size_t>(std::min(done + 1, cycles_));
  const double share = std::clamp(place - done, 0.0, 1.0);
  const auto oldest =
      static_cast<std::size_t>(std::max(0, done - static_cast<int>(kTrail_s / kControlPeriod_s)));
  for (const Robot& robot : robots_) {
    OverlayRobot shown;
    shown.name = robot.name;
    shown.height_m = robot.height_m;
    shown.pose = between(robot.poses[before], robot.poses[after], share);
    const std::size_t cycle = share > 1e-6 ? after : before;
    shown.kind = robot.kinds.at(cycle == 0 ? 0 : cycle - 1);
    for (std::size_t i = oldest; i <= before; ++i)
      shown.trail.push_back({robot.poses[i].x, robot.poses[i].y});
    shown.trail.push_back({shown.pose.x, shown.pose.y});
    moment.robots.push_back(std::move(shown));
  }
  if (done > 0) moment.score = scores_[before - 1];
  for (const std::vector<int>& visits : visits_) {
    const auto next = std::upper_bound(visits.begin(), visits.end(), done);
    // At the first instant all tiles have age 0, visited or not.
    const int last = next == visits.begin() ? std::min(1, done) : *std::prev(next);
    moment.tile_ages_s.push_back((done - last) * kControlPeriod_s);
  }
  return moment;
}

}  // namespace swarmsmith
