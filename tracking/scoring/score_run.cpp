#include "tracking/scoring/score_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/plain_text.h"
#include "tracking/scoring/border.h"
#include "tracking/scoring/run_patches.h"

namespace swarmsmith {
namespace {

/// "15.0 mm", "1.2 m".
std::string length_text(double metres) {
  return metres < 1 ? fmt::format("{:.1f} mm", 1000 * metres) : fmt::format("{:.1f} m", metres);
}

constexpr Question kBorder{"border at the end", "mm", "a robot that may be on the other side"};
constexpr Question kPatches{"places of the patches", "",
                            "colour patches that do not fit the mission"};

/// A robot nearer to a border than this many sigmas may be on the other side.
constexpr double kSigmas = 3;

/// The reason why a run cannot be scored, whatever was seen in it.
std::optional<Error> misfit(const TrackedRun& run, const Mission& mission) {
  const auto wrong = [&](const std::string& text) {
    return error_of(IssueCode::Config, text, mission.name);
  };
  if (!mission.arena.objects.empty() || std::holds_alternative<ObjectsOn>(mission.rule)) {
    return wrong(
        "the mission has movable objects, which this program cannot track; "
        "score it by hand");
  }
  if (run.trajectory.robots != mission.robots) {
    return wrong(fmt::format("the mission has {}, and {} were tracked",
                             counted(mission.robots, "robot"), run.trajectory.robots));
  }
  if (run.trajectory.instants() != mission.cycles) {
    return wrong(fmt::format("the mission has {}, and {} were tracked",
                             counted(mission.cycles, "cycle"), run.trajectory.instants()));
  }
  return std::nullopt;
}

/// Computes the distances to the borders at the end, and adds an issue for each robot whose side is
/// uncertain.
void measure_borders(const TrackedRun& run, const Mission& mission, const Arena& arena,
                     ScoredRun& scored) {
  const std::span<const Pose> last = run.trajectory.at(run.trajectory.instants() - 1);
  for (std::size_t i = 0; i < run.robots.size(); ++i) {
    const TrackedRobot& robot = run.robots[i];
    const auto nearest = nearest_border(mission.rule, arena, last[i].position());
    if (!nearest) {
      scored.borders.emplace_back(std::nullopt);
      if (is_scored_at_the_end(mission))
        scored.checks.push_back(not_asked(kBorder, robot.name, "its score has no border here"));
      continue;
    }
    const bool is_inside = nearest->here != 0;
    const double sigma_m = robot.sigmas.back().sigma_m;
    const bool is_close = nearest->distance_m < kSigmas * sigma_m;
    scored.borders.emplace_back(BorderDistance{
        is_inside ? nearest->distance_m : -nearest->distance_m, nearest->name, is_close, sigma_m});
    scored.checks.push_back(answered(kBorder, robot.name,
                                     is_close ? Check::Outcome::Warned : Check::Outcome::Passed,
                                     1000 * nearest->distance_m, 1000 * kSigmas * sigma_m));
    if (!is_close) continue;
    scored.issues.push_back(
        {IssueCode::TooCloseToCall,
         fmt::format(
             "{} ends {} from the border of the {}, and is known to {} (3 sigma): it counts "
             "{:g} and may count {:g}; look at the last frame",
             robot.name, length_text(nearest->distance_m), nearest->name,
             length_text(kSigmas * sigma_m), nearest->here, nearest->beyond),
         robot.name});
  }
}

/// Whether an issue makes a score less certain; some warnings are only for information.
bool degrades(IssueCode code) {
  return code != IssueCode::Outliers && code != IssueCode::UnknownTags &&
         code != IssueCode::FilmOdd;
}

void judge(ScoredRun& scored) {
  for (const Issue& issue : scored.issues) {
    const bool is_invalid = is_error(issue.code);
    if (!is_invalid && !degrades(issue.code)) continue;
    scored.verdict = std::max(scored.verdict, is_invalid ? Verdict::Invalid : Verdict::Degraded);
    scored.reasons.push_back(std::string(name_of(issue.code)) + ": " + issue.text);
    if (issue.code == IssueCode::TagAsCentre) scored.biased = true;
  }
}

}  // namespace

bool is_scored_at_the_end(const Mission& mission) {
  return is_scored_at_the_end(mission.rule);
}

Expected<ScoredRun> score_run(const TrackedRun& run, const Mission& mission,
                              const std::optional<std::vector<Patch>>& patches,
                              const std::vector<Issue>& before, const std::vector<Check>& asked) {
  if (std::optional<Error> error = misfit(run, mission)) return Unexpected(std::move(*error));
  Expected<std::vector<Patch>> laid = run_patches(mission, patches);
  if (!laid) return Unexpected(std::move(laid.error()));
  const Instance instance{.starts = run.starts, .patches = std::move(*laid)};
  ScoredRun scored{.patches = instance.patches,
                   .score = score_of(mission, instance, run.trajectory),
                   .issues = before,
                   .checks = asked};
  scored.issues.insert(scored.issues.end(), run.issues.begin(), run.issues.end());
  scored.checks.insert(scored.checks.end(), run.checks.begin(), run.checks.end());
  if (!mission.shuffled.places.empty()) {
    // Wrong patches were refused earlier.
    const auto places = static_cast<double>(mission.shuffled.places.size());
    scored.checks.push_back(answered(kPatches, "", Check::Outcome::Passed,
                                     static_cast<double>(scored.patches.size()), places));
  }
  measure_borders(run, mission, arena_of(mission, instance), scored);
  judge(scored);
  return scored;
}

}  // namespace swarmsmith
