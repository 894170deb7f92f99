#include "tracking/app/result_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text/json.h"
#include "base/text/toml_text.h"
#include "console/output.h"
#include "sim/mission/trajectory_csv.h"
#include "tracking/rig/calibration_limits.h"
#include "tracking/robots/reality_text.h"

namespace swarmsmith::cli {
namespace {

/// A robot as both kinds of answers speak of it.
struct RobotLine {
  std::string name;
  std::int64_t tag = 0;
  double measured = 0;  ///< share of its cycles
  std::int64_t cycles = 0;
  std::int64_t missing = 0;
  double longest_gap_s = 0;
  double sigma_m = 0;
  std::optional<double> border_m;
  bool too_close = false;
  std::optional<Latency> latency;  ///< of robots with a log
  std::optional<Reality> reality;  ///< likewise
};

struct Result {
  std::string name, mission, verdict;
  std::optional<double> score;
  bool biased = false;
  std::vector<std::string> reasons;
  std::vector<RobotLine> robots;
  std::vector<std::pair<std::string, std::string>> issues;  ///< code and sentence
  std::vector<Check> checks;
};

Result result_of(const RunLog& log, const RunAnalysis& analysis) {
  const ScoredRun& scored = analysis.scored;
  Result result{.name = log.name,
                .mission = log.mission.name,
                .verdict = std::string(name_of(scored.verdict)),
                .score = scored.score,
                .biased = scored.biased,
                .reasons = scored.reasons,
                .robots = {},
                .issues = {},
                .checks = scored.checks};
  for (std::size_t i = 0; i < analysis.tracked.robots.size(); ++i) {
    const TrackedRobot& robot = analysis.tracked.robots[i];
    RobotLine line{.name = robot.name, .tag = robot.tag};
    line.cycles = static_cast<std::int64_t>(robot.cycles.size());
    line.measured = static_cast<double>(std::ranges::count(robot.cycles, CycleKind::Measured)) /
                    static_cast<double>(std::max<std::int64_t>(line.cycles, 1));
    line.missing = std::ranges::count(robot.cycles, CycleKind::Missing);
    line.longest_gap_s = robot.longest_gap_s;
    line.sigma_m = robot.sigma.sigma_m;
    if (i < scored.borders.size() && scored.borders[i]) {
      line.border_m = scored.borders[i]->signed_m;
      line.too_close = scored.borders[i]->too_close;
    }
    if (i < scored.latencies.size()) line.latency = scored.latencies[i];
    if (i < scored.reality.size()) line.reality = scored.reality[i];
    result.robots.push_back(line);
  }
  for (const Issue& issue : scored.issues)
    result.issues.emplace_back(name_of(issue.code), issue.text);
  return result;
}

std::string latency_text(const Latency& latency) {
  if (!latency.seconds) return "latency cannot be told: " + latency.reason;
  return fmt::format("latency {:.0f} ms +- {:.1f} ms: its motion behind its commands",
                     1000 * *latency.seconds, 1000 * latency.error_s);
}

std::string robot_text(const RobotLine& robot, std::size_t width) {
  std::string text = fmt::format(
      "  {:<{}}  tag {:>3}  seen {:>5.1f} %  longest gap {:.2f} s  sigma {}", robot.name, width,
      robot.tag, 100 * robot.measured, robot.longest_gap_s, millimetres(robot.sigma_m));
  if (robot.missing > 0) text += fmt::format("  {} cycles missing", robot.missing);
  if (robot.border_m) {
    text += fmt::format("  {} {} its border{}", millimetres(std::abs(*robot.border_m)),
                        *robot.border_m >= 0 ? "inside" : "outside",
                        robot.too_close ? ": too close to call" : "");
  }
  text += "\n";
  if (robot.latency) {
    text += fmt::format("  {:<{}}  ", "", width) + latency_text(*robot.latency) + "\n";
  }
  if (robot.reality) {
    text += fmt::format("  {:<{}}  ", "", width) + reality_text(*robot.reality) + "\n";
  }
  return text;
}

std::string named(const Check& check) {
  return check.subject.empty() ? check.name : check.name + ", " + check.subject;
}

/// "  warned   longest gap, rvr1: 0.83 s, at most 1 s; it catches a robot that was hidden".
std::string check_line(const Check& check) {
  std::string text = fmt::format("  {:<7}  {}", name_of(check.outcome), named(check));
  if (!check.reason.empty()) text += ": " + check.reason;
  if (check.value) text += ": " + value_text(check);
  if (check.limit) text += ", " + limit_text(check);
  return text + "; it catches " + check.catches + "\n";
}

/// What could not be asked for one reason, in one line: "  not checked: motion as commanded, end of
/// the robot's log (rvr1, rvr2): the run log names no log of it".
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
  for (const auto outcome : {Check::Outcome::Failed, Check::Outcome::Warned, Check::Outcome::NotRun,
                             Check::Outcome::Passed}) {
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

/// "VALID; not checked: length of the film".
std::string verdict_text(const Result& result) {
  std::string text = result.verdict;
  if (result.biased) text += ", BIASED (tags taken for centres)";
  const std::vector<std::string> missing = unasked(result.checks);
  if (!missing.empty()) text += fmt::format("; not checked: {}", fmt::join(missing, ", "));
  return text;
}

std::string text_of(const Result& result, bool all_checks) {
  std::string text = fmt::format("{}: {}, score {}, {}\n", result.name, result.mission,
                                 score_text(result.score), verdict_text(result));
  std::size_t width = 4;
  for (const RobotLine& robot : result.robots)
    width = std::max(width, robot.name.size());
  for (const RobotLine& robot : result.robots)
    text += robot_text(robot, width);
  for (const std::string& reason : result.reasons)
    text += "  because " + reason + "\n";
  for (const auto& [code, sentence] : result.issues) {
    const std::string line = code + ": " + sentence;
    const bool is_said = std::ranges::find(result.reasons, line) != result.reasons.end();
    if (!is_said) text += "  " + line + "\n";
  }
  return text + checks_text(result.checks, all_checks);
}

void add_to(JsonObject& object, const Result& result) {
  const auto robot_json = [](const RobotLine& robot) {
    const Latency none;
    const Latency& latency = robot.latency ? *robot.latency : none;
    const auto error_s = latency.seconds ? std::optional(latency.error_s) : std::nullopt;
    return JsonObject()
        .add("name", robot.name)
        .add("tag", robot.tag)
        .add("measured", robot.measured)
        .add("missing_cycles", robot.missing)
        .add("longest_gap_s", robot.longest_gap_s)
        .add("sigma_m", robot.sigma_m)
        .add("border_m", robot.border_m)
        .add("too_close", robot.too_close)
        .add("latency_s", latency.seconds)
        .add("latency_error_s", error_s)
        .add("latency_reason", latency.reason)
        .add("agreement", latency.agreement)
        .add("reality", robot.reality ? std::optional(reality_json(*robot.reality)) : std::nullopt);
  };
  const auto issue_json = [](const std::pair<std::string, std::string>& issue) {
    return JsonObject().add("code", issue.first).add("text", issue.second);
  };
  const auto check_json = [](const Check& check) {
    return JsonObject()
        .add("name", check.name)
        .add("subject", check.subject)
        .add("outcome", name_of(check.outcome))
        .add("value", check.value)
        .add("limit", check.limit)
        .add("unit", check.unit)
        .add("catches", check.catches)
        .add("reason", check.reason);
  };
  object.add("name", result.name)
      .add("mission", result.mission)
      .add("score", result.score)
      .add("verdict", result.verdict)
      .add("biased", result.biased)
      .add("reasons", result.reasons)
      .add("robots", json_list(result.robots, robot_json))
      .add("issues", json_list(result.issues, issue_json))
      .add("not_checked", unasked(result.checks))
      .add("checks", json_list(result.checks, check_json));
}

}  // namespace

std::string score_text(const std::optional<double>& score) {
  return score ? number_text(*score) : "no score";
}

std::string result_text(const RunLog& log, const RunAnalysis& analysis, bool all_checks) {
  return text_of(result_of(log, analysis), all_checks);
}

void add_result(JsonObject& object, const RunLog& log, const RunAnalysis& analysis) {
  add_to(object, result_of(log, analysis));
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

}  // namespace swarmsmith::cli
