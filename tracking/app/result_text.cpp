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
                .issues = {}};
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

std::string text_of(const Result& result) {
  std::string text =
      fmt::format("{}: {}, score {}, {}{}\n", result.name, result.mission, score_text(result.score),
                  result.verdict, result.biased ? ", BIASED (tags taken for centres)" : "");
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
  return text;
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
  object.add("name", result.name)
      .add("mission", result.mission)
      .add("score", result.score)
      .add("verdict", result.verdict)
      .add("biased", result.biased)
      .add("reasons", result.reasons)
      .add("robots", json_list(result.robots, robot_json))
      .add("issues", json_list(result.issues, issue_json));
}

}  // namespace

std::string score_text(const std::optional<double>& score) {
  return score ? number_text(*score) : "no score";
}

std::string result_text(const RunLog& log, const RunAnalysis& analysis) {
  return text_of(result_of(log, analysis));
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
