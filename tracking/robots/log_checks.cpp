#include <algorithm>
#include <array>
#include <cmath>

#include "tracking/robots/robot_logs.h"

namespace swarmsmith {
namespace {

using Outcome = Check::Outcome;

constexpr Question kOwnLog{"log of this run", "", "a log of another run, robot or machine"};
/// The value of this check is the share of cycles that were lost.
constexpr Question kNode{"robot's own verdict", "%", "a robot that stood still or skipped cycles"};
constexpr Question kDriver{"driver watched", "s",
                           "treads that did not obey: a driver that was silent, dead, replaced, "
                           "contradicted or late"};
constexpr Question kEnd{"end of the robot's log", "s", "a node that died, a file that was cut"};
constexpr Question kClock{"clock of the robot", "ms", "a robot that began earlier or later"};
constexpr Question kLatency{"latency of the treads", "ms",
                            "treads that react late, whatever their driver says"};
constexpr Question kWay{"way of what was told", "% off",
                        "treads with another speed, whatever their driver says"};
constexpr Question kMotion{"motion as commanded", "",
                           "logs or tags that were swapped, a robot that was held, a wrong start"};

/// The worst outcome of a robot's issues with some codes.
Outcome worst_of(const std::vector<Issue>& issues, const std::string& robot,
                 std::initializer_list<IssueCode> codes) {
  auto worst = Outcome::Passed;
  for (std::size_t i = 0; i < issues.size(); ++i) {
    if (issues[i].robot != robot) continue;
    for (const IssueCode code : codes)
      worst = std::max(worst, outcome_of(std::span(issues).subspan(i, 1), 0, code));
  }
  return worst;
}

/// The value of this check is the longest time for which the treads were not known to obey.
Check driver_check(const RobotLog& log) {
  const std::string& robot = log.robot;
  if (!log.record.head.end) return not_asked(kDriver, robot, "its log has no end");
  const RunEnd& end = *log.record.head.end;
  if (!end.driven) {
    return not_asked(kDriver, robot,
                     "its log does not say whether the driver was watched: it is an older one, or "
                     "no node's");
  }
  if (!*end.driven) {
    return not_asked(kDriver, robot, "its driver did not say what the treads do (`driven`)");
  }
  constexpr std::array kOutcomes = {Outcome::Passed, Outcome::Warned, Outcome::Failed};
  const Outcome outcome = kOutcomes.at(static_cast<std::size_t>(end.driver));
  const double limit_s = outcome == Outcome::Failed ? kDriverGone_s : kDriverOff_s;
  // The time off explains the outcome only if both are on the same side of the limit; treads can
  // disobey in other ways.
  const bool is_why = (end.driver_off_s > limit_s) == (outcome != Outcome::Passed);
  return is_why ? answered(kDriver, robot, outcome, end.driver_off_s, limit_s)
                : answered(kDriver, robot, outcome);
}

void ask_treads(const std::string& robot, const Reality& reality, std::vector<Check>& checks) {
  const auto outcome = [](bool is_wrong) { return is_wrong ? Outcome::Warned : Outcome::Passed; };
  const Latency& latency = reality.latency;
  checks.push_back(latency.seconds ? answered(kLatency, robot, outcome(is_late(latency)),
                                              1000 * *latency.seconds, 1000 * kLateTreads_s)
                                   : not_asked(kLatency, robot, latency.reason));
  // Beyond the limit by less than the error, a check passes.
  checks.back().limit_is_least = false;
  const Gain& way = reality.slip.way;
  checks.push_back(way.gain ? answered(kWay, robot,
                                       way.is_against ? Outcome::Failed : outcome(is_off(way)),
                                       100 * std::fabs(*way.gain - 1), 100 * kWayOff)
                            : not_asked(kWay, robot, way.reason));
  checks.back().limit_is_least = false;
}

/// All checks of one robot that has a log.
void ask(const RobotLog& log, const std::optional<Latency>& latency,
         const std::optional<Reality>& reality, const RunLog& run, const std::vector<Issue>& issues,
         std::vector<Check>& checks) {
  const std::string& robot = log.robot;
  const RunRecord& record = log.record;
  const double last_s = record.rows.empty() ? 0 : record.rows.back().sensed.time_s;
  const double duration_s = run.mission.cycles * kControlPeriod_s;
  checks.push_back(driver_check(log));
  checks.push_back(answered(kEnd, robot, worst_of(issues, robot, {IssueCode::LogShort}),
                            std::max(0.0, duration_s - last_s), kLostAtTheEnd_s));
  const std::optional<double> offset_s = record.head.clock_offset_s;
  checks.push_back(offset_s
                       ? answered(kClock, robot, worst_of(issues, robot, {IssueCode::ClockOffset}),
                                  1000 * std::fabs(*offset_s), 1000 * kClockOffset_s)
                       : not_asked(kClock, robot, "its log says no clock offset"));
  const Outcome motion = worst_of(issues, robot, {IssueCode::MotionUnlikeLog});
  if (latency && latency->agreement) {
    checks.push_back(answered(kMotion, robot, motion, *latency->agreement, kLeastAgreement));
    checks.back().limit_is_least = true;
  } else if (motion != Outcome::Passed) {
    checks.push_back(answered(kMotion, robot, motion));
  } else {
    checks.push_back(not_asked(kMotion, robot, latency ? latency->reason : "it has no commands"));
  }
  if (reality) ask_treads(robot, *reality, checks);
}

void ask_node(const std::string& robot, const RobotLog* log, const RobotNote* note,
              const RunLog& run, const std::vector<Issue>& issues, std::vector<Check>& checks) {
  const Outcome outcome =
      worst_of(issues, robot, {IssueCode::RobotInvalid, IssueCode::RobotDegraded});
  if (log != nullptr) {
    const LogCounts counts = log_counts(log->record);
    const double lost = static_cast<double>(counts.held + counts.skipped) / run.mission.cycles;
    const double limit = outcome == Outcome::Failed ? kInvalidShare : kDegradedShare;
    // The node may have other reasons for its verdict.
    const bool is_why = (lost > limit) == (outcome != Outcome::Passed);
    checks.push_back(is_why ? answered(kNode, robot, outcome, 100 * lost, 100 * limit)
                            : answered(kNode, robot, outcome));
  } else if (note != nullptr && note->verdict) {
    checks.push_back(answered(kNode, robot, outcome));
  } else {
    checks.push_back(not_asked(kNode, robot, "the run log has neither its verdict nor its log"));
  }
}

}  // namespace

std::vector<Check> checks_of_logs(const TrackedRun& run, const Observations& observations,
                                  const RunLog& log, const RobotFindings& findings) {
  std::vector<Check> checks;
  for (std::size_t i = 0; i < run.robots.size(); ++i) {
    const std::string& robot = run.robots[i].name;
    const auto own = std::ranges::find(observations.logs, robot, &RobotLog::robot);
    const auto note = std::ranges::find(log.notes, robot, &RobotNote::robot);
    const bool has_log = own != observations.logs.end();
    const Outcome kept =
        worst_of(observations.issues, robot, {IssueCode::LogForeign, IssueCode::LogUnreadable});
    ask_node(robot, has_log ? &*own : nullptr, note == log.notes.end() ? nullptr : &*note, log,
             findings.issues, checks);
    const std::string none =
        kept == Outcome::Failed ? "its log is not of this run" : "the run log names no log of it";
    if (has_log || kept != Outcome::Passed) {
      checks.push_back(answered(kOwnLog, robot, kept));
    } else {
      checks.push_back(not_asked(kOwnLog, robot, none));
    }
    if (has_log) {
      ask(*own, i < findings.latencies.size() ? findings.latencies[i] : std::nullopt,
          i < findings.reality.size() ? findings.reality[i] : std::nullopt, log, findings.issues,
          checks);
      continue;
    }
    const std::string why = kept == Outcome::Warned ? "its log cannot be read" : none;
    for (const Question& question : {kDriver, kEnd, kClock, kMotion, kLatency, kWay})
      checks.push_back(not_asked(question, robot, why));
  }
  return checks;
}

}  // namespace swarmsmith
