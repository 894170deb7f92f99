#include "tracking/robots/robot_logs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tracking/robots/film_rate.h"

namespace swarmsmith {
namespace {

/// How much earlier than its command a motion may seem to begin: half a cycle. The start, and the
/// moment between two pictures when a speed begins to change, are not known more precisely.
constexpr double kEarly_s = 0.05;

/// A node that was stopped for longer is lost; cycles are late by far less.
constexpr double kFarOff_s = 60;

Verdict verdict_of(RunVerdict verdict) {
  return *verdict_from_name(name_of(verdict));
}

/// The data on one robot.
struct Known {
  const TrackedRobot& robot;
  const RobotLog* log;    ///< may be null
  const RobotNote* note;  ///< may be null
};

class Judge {
 public:
  Judge(const RunLog& run, const TrackedRun& tracked, RobotFindings& findings)
      : run_(run), tracked_(tracked), findings_(findings) {}

  void judge(const Known& known) {
    judge_node(known);
    if (known.log == nullptr) {
      findings_.latencies.emplace_back(std::nullopt);
      findings_.reality.emplace_back(std::nullopt);
      return;
    }
    judge_length(known);
    judge_clock(known);
    const Latency latency = judge_motion(known);
    const auto number = static_cast<std::size_t>(&known.robot - tracked_.robots.data());
    findings_.latencies.emplace_back(latency);
    const Reality& reality = *findings_.reality.emplace_back(
        reality_of({tracked_, run_.mission, number, *known.log}, latency));
    judge_treads(known, reality);
  }

  /// Called once all robots were judged, because they share the film.
  void judge_film() {
    constexpr double kTolerance_s = 0.2;
    Check check{.name = "film beside the robots' logs",
                .limit = kTolerance_s,
                .unit = "s",
                .catches = "a film that plays too fast or too slowly"};
    const FilmRate found = film_rate(told_, run_.start.time_s.value_or(0));
    if (told_.empty() || !found.rate) {
      check.outcome = Check::Outcome::NotRun;
      check.reason = told_.empty() ? "there is no log of a robot" : found.reason;
    } else {
      check.value = found.off_s;
      findings_.logs_confirm_clock = found.off_s <= kTolerance_s;
      if (!findings_.logs_confirm_clock) {
        check.outcome = Check::Outcome::Failed;
        findings_.issues.push_back(
            {IssueCode::FilmTooFast,
             fmt::format("the film plays {:.3g} times as fast as robots move by their own logs, "
                         "and is {:.1f} s off at the end of the run (limit {:.1f} s); give the "
                         "camera's times as a sidecar, or mend the rate of the file",
                         *found.rate, found.off_s, kTolerance_s)});
      }
    }
    findings_.checks.push_back(std::move(check));
  }

 private:
  void add(IssueCode code, const Known& known, std::string text,
           std::optional<double> from_s = std::nullopt) {
    findings_.issues.push_back(
        {code, known.robot.name + ": " + std::move(text), known.robot.name, from_s, {}});
  }

  double duration_s() const { return run_.mission.cycles * kControlPeriod_s; }

  /// Takes the worse verdict of log and note, with the reasons of both.
  void judge_node(const Known& known) {
    std::optional<Verdict> verdict;
    std::vector<std::string> reasons;
    const auto hear = [&](Verdict said, const std::vector<std::string>& why) {
      verdict = std::max(verdict.value_or(Verdict::Valid), said);
      for (const std::string& reason : why) {
        if (std::ranges::find(reasons, reason) == reasons.end()) reasons.push_back(reason);
      }
    };
    if (known.log != nullptr && known.log->record.head.end) {
      const RunEnd& end = *known.log->record.head.end;
      hear(verdict_of(end.verdict), end.reasons);
    }
    if (known.note != nullptr && known.note->verdict) {
      hear(*known.note->verdict, known.note->reasons);
    }
    if (!verdict) {
      if (known.log != nullptr) judge_without_end(known);
      return;
    }
    if (*verdict == Verdict::Valid) return;
    add(*verdict == Verdict::Invalid ? IssueCode::RobotInvalid : IssueCode::RobotDegraded, known,
        fmt::format(
            "its node says that its run is {}: {}", name_of(*verdict),
            reasons.empty() ? "it gives no reason" : fmt::format("{}", fmt::join(reasons, "; "))));
  }

  /// A node that was killed has no verdict; its rows show how many cycles it lost.
  void judge_without_end(const Known& known) {
    const LogCounts counts = log_counts(known.log->record);
    const std::int64_t lost = counts.skipped + counts.held;
    const double share = static_cast<double>(lost) / run_.mission.cycles;
    const std::string end =
        "its log has no end: its node was killed, or the files were copied too early";
    if (share <= kDegradedShare) return add(IssueCode::RobotDegraded, known, end);
    add(share > kInvalidShare ? IssueCode::RobotInvalid : IssueCode::RobotDegraded, known,
        fmt::format(
            "{}; {} of {} cycles were skipped or held ({:.1f} %, at most {:g} % are allowed)", end,
            lost, run_.mission.cycles, 100 * share,
            100 * (share > kInvalidShare ? kInvalidShare : kDegradedShare)));
  }

  void judge_length(const Known& known) {
    const RunRecord& record = known.log->record;
    const double last_s = record.rows.empty() ? 0 : record.rows.back().sensed.time_s;
    if (last_s >= duration_s() - kLostAtTheEnd_s) return;
    add(IssueCode::LogShort, known,
        fmt::format(
            "its log ends at {:.1f} s of {:g} s; did the node end early, or is the file cut "
            "off? Copy it again and `rescore` with --run",
            last_s, duration_s()),
        last_s);
  }

  void judge_clock(const Known& known) {
    const auto offset_s = known.log->record.head.clock_offset_s;
    if (!offset_s || std::fabs(*offset_s) <= kClockOffset_s) return;
    add(IssueCode::ClockOffset, known,
        fmt::format("its clock was {:.0f} ms {} the operator's (at most {:.0f} ms): it began {} "
                    "than the others; synchronise clocks",
                    1000 * std::fabs(*offset_s), *offset_s > 0 ? "ahead of" : "behind",
                    1000 * kClockOffset_s, *offset_s > 0 ? "earlier" : "later"));
  }

  Latency judge_motion(const Known& known) {
    std::vector<TimedCommand> commands = commands_of(known.log->record);
    const Latency latency = latency_of(commands, known.robot.samples);
    told_.push_back({std::move(commands), known.robot.samples});
    const bool is_unlike = latency.agreement && *latency.agreement < kLeastAgreement;
    if (is_unlike) {
      add(IssueCode::MotionUnlikeLog, known,
          latency.reason + "; were tags or logs swapped, or was it held?");
    } else if (latency.seconds && *latency.seconds < -kEarly_s - 3 * latency.error_s) {
      add(IssueCode::MotionUnlikeLog, known,
          fmt::format("it moves {:.0f} ms before its commands; is the start of the run right?",
                      -1000 * *latency.seconds));
    } else if (!latency.seconds && latency.beyond) {
      add(IssueCode::MotionUnlikeLog, known, latency.reason);
    }
    return latency;
  }

  /// The treads' motion is checked here, because a driver's report on them may be wrong.
  void judge_treads(const Known& known, const Reality& reality) {
    if (is_late(reality.latency)) {
      add(IssueCode::MotionUnlikeLog, known,
          fmt::format("it moves {:.0f} ms after its commands (at most {:.0f} ms); is its driver "
                      "busy, or the start of the run wrong?",
                      1000 * *reality.latency.seconds, 1000 * kLateTreads_s));
    }
    const Gain& way = reality.slip.way;
    if (way.gain && way.is_against) {
      add(IssueCode::TagTurned, known,
          "the camera sees it drive backwards where it is commanded to drive ahead; is its tag "
          "turned by 180 degrees since it was calibrated, or do its treads turn the wrong way?");
    } else if (is_off(way)) {
      add(IssueCode::MotionUnlikeLog, known,
          fmt::format("it drives {:.0f} % of the way that is commanded ({:.0f} to {:.0f} % "
                      "are usual); is its driver's scale right?",
                      100 * *way.gain, 100 * (1 - kWayOff), 100 * (1 + kWayOff)));
    }
  }

  const RunLog& run_;
  const TrackedRun& tracked_;
  RobotFindings& findings_;
  std::vector<ToldAndSeen> told_;
};

/// Whether a row's times are of the run, and its clock agrees with its cycle; later computations
/// take as much memory and time as these times say.
bool is_within(const LogRow& row, const LogHead& head, const RunLog& run) {
  const double end_s = std::max(head.seconds, run.mission.cycles * kControlPeriod_s);
  return row.sensed.time_s >= 0 && row.sensed.time_s <= end_s + kFarOff_s &&
         std::fabs(row.clock_s - head.start_clock_s - row.sensed.time_s) <= kFarOff_s;
}

Issue foreign_issue(const RobotLog& log, const std::string& what) {
  return {
      IssueCode::LogForeign,
      fmt::format("{}: its log {} {}; it was left out: name the right file in the run log, then "
                  "`rescore` with --run",
                  log.robot, log.file, what),
      log.robot};
}

}  // namespace

bool is_late(const Latency& latency) {
  return latency.seconds && *latency.seconds - 3 * latency.error_s > kLateTreads_s;
}

bool is_off(const Gain& way) {
  return way.gain && std::fabs(*way.gain - 1) - 3 * way.error > kWayOff;
}

std::optional<Issue> misfit_of(const RobotLog& log, const RunLog& run,
                               const std::optional<RanMachine>& machine) {
  const LogHead& head = log.record.head;
  const auto foreign = [&](const std::string& what) { return foreign_issue(log, what); };
  if (head.run != run.name) return foreign("is of run " + head.run + ", this is " + run.name);
  if (head.robot != log.robot) return foreign("is of robot " + head.robot);
  if (machine && head.flavour != machine->flavour) {
    return foreign("is of a machine of flavour " + head.flavour + ", and one of " +
                   machine->flavour + " should have run");
  }
  if (machine && head.machine != machine->text) {
    return foreign("is of the machine `" + head.machine + "`, and `" + machine->text +
                   "` should have run");
  }
  if (head.lock_step) return foreign("was stepped by a simulated world, not by a clock");
  for (std::size_t i = 1; i < log.record.rows.size(); ++i) {
    const LogRow& row = log.record.rows[i];
    const LogRow& before = log.record.rows[i - 1];
    if (row.cycle > before.cycle && row.clock_s > before.clock_s) continue;
    return foreign(fmt::format("has cycle {} after cycle {}, at times that do not increase",
                               row.cycle, before.cycle));
  }
  for (const LogRow& row : log.record.rows) {
    if (is_within(row, head, run)) continue;
    return foreign(fmt::format(
        "has cycle {} at a time that is not of this run: {:g} s after the start, {:g} s by its "
        "clock",
        row.cycle, row.sensed.time_s, row.clock_s - head.start_clock_s));
  }
  return std::nullopt;
}

std::optional<Issue> other_machine(const RobotLog& log, const RobotLog& first) {
  const std::string& digest = log.record.head.machine_digest;
  if (digest == first.record.head.machine_digest) return std::nullopt;
  return foreign_issue(log, fmt::format("is of a machine with digest {}, and {} ran one with {}",
                                        digest, first.robot, first.record.head.machine_digest));
}

RobotFindings judge_robots(const TrackedRun& run, const std::vector<RobotLog>& logs,
                           const RunLog& log) {
  RobotFindings findings;
  Judge judge(log, run, findings);
  for (const TrackedRobot& robot : run.robots) {
    const auto own = std::ranges::find(logs, robot.name, &RobotLog::robot);
    const auto note = std::ranges::find(log.notes, robot.name, &RobotNote::robot);
    judge.judge(
        {robot, own == logs.end() ? nullptr : &*own, note == log.notes.end() ? nullptr : &*note});
  }
  judge.judge_film();
  return findings;
}

LogCounts log_counts(const RunRecord& record) {
  LogCounts counts;
  std::vector<double> late_ms;
  for (const LogRow& row : record.rows) {
    ++(row.act == Act::Hold ? counts.held : counts.stepped);
    late_ms.push_back(row.late_ms);
  }
  if (!record.rows.empty()) {
    counts.skipped = record.rows.back().cycle - static_cast<std::int64_t>(record.rows.size());
    std::ranges::sort(late_ms);
    counts.late_median_ms = late_ms[late_ms.size() / 2];
    counts.late_most_ms = late_ms.back();
  }
  if (record.head.end) {
    counts.stepped = record.head.end->stepped;
    counts.held = record.head.end->held;
    counts.skipped = record.head.end->skipped;
  }
  return counts;
}

}  // namespace swarmsmith
