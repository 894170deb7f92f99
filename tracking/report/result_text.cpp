#include "tracking/report/result_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/plain_text.h"
#include "base/text/json.h"
#include "base/text/toml_text.h"
#include "sim/mission/trajectory_csv.h"
#include "tracking/rig/calibration_limits.h"
#include "tracking/robots/reality_text.h"

namespace swarmsmith {
namespace {

std::string latency_text(const Latency& latency) {
  if (!latency.seconds) return "latency cannot be determined: " + latency.reason;
  return fmt::format("latency {:.0f} ms +- {:.1f} ms, from its commands to its motion",
                     1000 * *latency.seconds, 1000 * latency.error_s);
}

std::string robot_text(const RobotFinding& robot, std::size_t width) {
  const TrackedRobot& tracked = *robot.tracked;
  std::string text =
      fmt::format("  {:<{}}  tag {:>3}  seen {:>5.1f} %  longest gap {:.2f} s  sigma {}",
                  tracked.name, width, tracked.tag, 100 * robot.share(CycleKind::Measured),
                  tracked.longest_gap_s, millimetres(tracked.sigma.sigma_m));
  if (const auto missing = robot.cycles(CycleKind::Missing); missing > 0)
    text += fmt::format("  {} missing", counted(missing, "cycle"));
  if (robot.border != nullptr) {
    text += fmt::format("  {} {} its border{}", millimetres(std::abs(robot.border->signed_m)),
                        robot.border->signed_m >= 0 ? "inside" : "outside",
                        robot.border->too_close ? ": too close to call" : "");
  }
  text += "\n";
  const auto add = [&](const std::string& line) {
    text += fmt::format("  {:<{}}  ", "", width) + line + "\n";
  };
  if (robot.latency != nullptr) add(latency_text(*robot.latency));
  if (robot.reality != nullptr) add(reality_text(*robot.reality));
  return text;
}

std::string named(const Check& check) {
  return check.subject.empty() ? check.name : check.name + ", " + check.subject;
}

/// A line for a check: "  warned   longest gap, rvr1: 0.83 s, at most 1 s; it catches a robot that
/// was hidden".
std::string check_line(const Check& check) {
  std::string text = fmt::format("  {:<7}  {}", name_of(check.outcome), named(check));
  if (!check.reason.empty()) text += ": " + check.reason;
  if (check.value) text += ": " + value_text(check);
  if (check.limit) text += ", " + limit_text(check);
  return text + "; it catches " + check.catches + "\n";
}

/// Checks that could not be done for the same reason, in one line: "  not checked: motion as
/// commanded, end of the robot's log (rvr1, rvr2): the run log names no log of it".
std::string unasked_lines(const std::vector<Check>& checks) {
  struct Line {
    std::vector<std::string> names, subjects;
  };
  std::vector<std::pair<std::string, Line>> lines;
  const auto add = [](std::vector<std::string>& words, const std::string& word) {
    if (!word.empty() && std::ranges::find(words, word) == words.end()) words.push_back(word);
  };
  for (const Check& check : checks) {
    if (check.outcome != Check::Outcome::NotRun) continue;
    auto line = std::ranges::find(lines, check.reason, &std::pair<std::string, Line>::first);
    if (line == lines.end()) line = lines.insert(lines.end(), {check.reason, {}});
    add(line->second.names, check.name);
    add(line->second.subjects, check.subject);
  }
  std::string text;
  for (const auto& [reason, line] : lines) {
    text += fmt::format("  not checked: {}", fmt::join(line.names, ", "));
    if (!line.subjects.empty()) text += fmt::format(" ({})", fmt::join(line.subjects, ", "));
    text += ": " + reason + "\n";
  }
  return text;
}

std::string checks_text(const std::vector<Check>& checks, bool all) {
  std::string text;
  for (const auto outcome : kWorstFirst) {
    if (!all && outcome == Check::Outcome::Passed) continue;
    if (!all && outcome == Check::Outcome::NotRun) {
      text += unasked_lines(checks);
      continue;
    }
    for (const Check& check : checks)
      if (check.outcome == outcome) text += check_line(check);
  }
  const auto passed = std::ranges::count(checks, Check::Outcome::Passed, &Check::outcome);
  return text + fmt::format("  {} of {} checks passed{}\n", passed, checks.size(),
                            all ? "" : "; --checks lists them");
}

/// The verdict as text: "VALID; not checked: length of the film", "VALID by A. Person (DEGRADED
/// measured)".
std::string verdict_text(const RunFindings& run) {
  const ScoredRun& scored = run.scored;
  std::string text(name_of(run.verdict()));
  if (const VerdictOverride* by_person = overriding(run.overrides))
    text += fmt::format(" by {} ({} measured)", by_person->who, name_of(scored.verdict));
  if (scored.biased) text += ", BIASED (tags taken for centres)";
  const std::vector<std::string> missing = unasked(scored.checks);
  if (!missing.empty()) text += fmt::format("; not checked: {}", fmt::join(missing, ", "));
  return text;
}

JsonObject robot_json(const RobotFinding& robot) {
  const auto of = [](const auto* thing, auto part) {
    return thing == nullptr ? std::nullopt : std::optional(std::invoke(part, *thing));
  };
  const Latency none;
  const Latency& latency = robot.latency == nullptr ? none : *robot.latency;
  return JsonObject()
      .add("name", robot.tracked->name)
      .add("tag", robot.tracked->tag)
      .add("measured", robot.share(CycleKind::Measured))
      .add("missing_cycles", robot.cycles(CycleKind::Missing))
      .add("longest_gap_s", robot.tracked->longest_gap_s)
      .add("sigma_m", robot.tracked->sigma.sigma_m)
      .add("border_m", of(robot.border, &BorderDistance::signed_m))
      .add("too_close", robot.border != nullptr && robot.border->too_close)
      .add("latency_s", latency.seconds)
      .add("latency_error_s", latency.seconds ? std::optional(latency.error_s) : std::nullopt)
      .add("latency_reason", latency.reason)
      .add("agreement", latency.agreement)
      .add("reality", of(robot.reality, reality_json));
}

JsonObject check_json(const Check& check) {
  return JsonObject()
      .add("name", check.name)
      .add("subject", check.subject)
      .add("outcome", name_of(check.outcome))
      .add("value", check.value)
      .add("limit", check.limit)
      .add("unit", check.unit)
      .add("catches", check.catches)
      .add("reason", check.reason);
}

}  // namespace

std::string score_text(const std::optional<double>& score) {
  return score ? number_text(*score) : "no score";
}

std::string result_text(const RunFindings& run, bool all_checks) {
  const ScoredRun& scored = run.scored;
  std::string text = fmt::format("{}: {}, score {}, {}\n", run.log.name, run.log.mission.name,
                                 score_text(scored.score), verdict_text(run));
  std::size_t width = 4;
  for (const RobotFinding& robot : run.robots)
    width = std::max(width, robot.tracked->name.size());
  for (const RobotFinding& robot : run.robots)
    text += robot_text(robot, width);
  for (const std::string& reason : scored.reasons)
    text += "  because " + reason + "\n";
  for (const Issue& issue : scored.issues) {
    const std::string line = std::string(name_of(issue.code)) + ": " + issue.text;
    const bool is_said = std::ranges::find(scored.reasons, line) != scored.reasons.end();
    if (!is_said) text += "  " + line + "\n";
  }
  return text + checks_text(scored.checks, all_checks);
}

void add_result(JsonObject& object, const RunFindings& run) {
  const auto issue_json = [](const Issue& issue) {
    return JsonObject().add("code", name_of(issue.code)).add("text", issue.text);
  };
  object.add("name", run.log.name)
      .add("mission", run.log.mission.name)
      .add("score", run.scored.score)
      .add("verdict", name_of(run.verdict()))
      .add("measured_verdict", name_of(run.scored.verdict))
      .add("biased", run.scored.biased)
      .add("reasons", run.scored.reasons)
      .add("robots", json_list(run.robots, robot_json))
      .add("issues", json_list(run.scored.issues, issue_json))
      .add("not_checked", unasked(run.scored.checks))
      .add("checks", json_list(run.scored.checks, check_json));
}

std::string trajectory_csv(const TrackedRun& tracked) {
  std::string text(kTrajectoryColumns);
  text += ",kind,sigma_m,sigma_rad";
  text += kCsvLineEnd;
  const auto add = [&](int cycle, std::span<const Pose> poses) {
    const auto at = static_cast<std::size_t>(std::max(cycle, 1) - 1);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const TrackedRobot& robot = tracked.robots[i];
      append_pose_cells(text, cycle, static_cast<int>(i), poses[i]);
      text += fmt::format(",{},", name_of(robot.cycles[at]));
      append_number(text, robot.sigmas[at].sigma_m);
      text += ',';
      append_number(text, robot.sigmas[at].sigma_rad);
      text += kCsvLineEnd;
    }
  };
  add(0, tracked.starts);
  for (int instant = 0; instant < tracked.trajectory.instants(); ++instant)
    add(instant + 1, tracked.trajectory.at(instant));
  return text;
}

}  // namespace swarmsmith
