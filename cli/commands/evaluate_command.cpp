#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

#include "analysis/statistics/summary.h"
#include "base/suggestion.h"
#include "base/text/json.h"
#include "cli/commands/commands.h"
#include "cli/output/progress_text.h"
#include "cli/replay/evaluation_plan.h"
#include "cli/replay/recording.h"
#include "cli/replay/score_keeper.h"
#include "console/counter.h"
#include "sim/engine/simulate.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"
#include "storage/answer.h"

namespace swarmsmith::cli {
namespace {

struct EvaluateOptions : EvaluateArguments {
  RecordingArguments recording;
};

/// Mean and interval, for people.
void write_summary(std::ostream& out, const std::vector<double>& scores) {
  const MeanInterval summary = mean_interval(scores);
  const auto shown = [](double value) {
    char buffer[32];
    const int size = std::snprintf(buffer, sizeof buffer, "%.6g", value);
    return std::string(buffer, static_cast<std::size_t>(size));
  };
  out << "mean " << shown(summary.mean);
  if (scores.size() > 1) {
    out << "  95 % interval " << shown(summary.mean - summary.half_width) << " to "
        << shown(summary.mean + summary.half_width);
  }
  out << "  n " << scores.size() << "\n";
}

/// Adds a counter of the cycles, for runs that take seconds; for shorter runs it is not worth its
/// cost.
Recorder with_counter(Recorder recorder, const Mission& mission, Counter& counter) {
  constexpr std::int64_t kLongRun = 500'000;  // robots times cycles
  if (std::int64_t{mission.robots} * mission.cycles < kLongRun) return recorder;
  const Sensors sensors = recorder.sensors;
  return {[observe = std::move(recorder.observe), &mission, &counter](const Snapshot& now) {
            counter.tell(now.cycle, mission.cycles);
            if (observe) observe(now);
          },
          sensors};
}

/// A run as it is printed.
struct Told {
  const EvaluationJob* job = nullptr;
  std::int64_t seed = 0;
  double score = 0;
  std::optional<ScoreKeeper::Kept> kept;  ///< empty: the score is only printed
};

using How = ScoreKeeper::Kept::How;

std::string as_json(const Told& told) {
  JsonObject object;
  if (const CandidateId candidate = told.job->candidate) {
    object.add("design", design_of(candidate))
        .add("candidate", candidate)
        .add("source", told.job->profile.name);
  } else if (!told.job->name.empty()) {
    object.add("machine", told.job->name);
  }
  object.add("seed", told.seed).add("score", told.score);
  if (told.kept) {
    constexpr const char* kHow[] = {"new", "known", "conflict"};
    object.add("id", to_string(told.kept->key))
        .add("stored", kHow[static_cast<std::size_t>(told.kept->how)]);
  }
  return object.text() + "\n";
}

std::string as_line(const Told& told) {
  std::string text;
  if (const CandidateId candidate = told.job->candidate) {
    text = to_string(design_of(candidate)) + "  " + to_string(candidate) + "  " +
           told.job->profile.name + "  ";
  } else if (!told.job->name.empty()) {
    text += told.job->name + "  ";
  }
  text += "seed " + std::to_string(told.seed) + "  score " + json_number(told.score);
  if (told.kept && told.kept->how == How::New) text += "  stored as " + to_string(told.kept->key);
  if (told.kept && told.kept->how == How::Known)
    text += "  was stored as " + to_string(told.kept->key);
  return text + "\n";
}

/// The error for two different scores of the same evaluation.
Error conflict_of(const Told& told) {
  return {ErrorKind::Conflict,
          "seed " + std::to_string(told.seed) + " gives score " + json_number(told.score) +
              ", and the store holds " + json_number(told.kept->stored) +
              " or another last state; both are kept, the first one counts. Another version of the "
              "program made one of them, or a machine computes wrongly",
          to_string(told.kept->key)};
}

std::int64_t runs_of(const EvaluationPlan& plan) {
  std::size_t runs = 0;
  for (const EvaluationJob& job : plan.jobs)
    runs += job.seeds.size();
  return static_cast<std::int64_t>(runs);
}

ScorePlace place_of(const EvaluationJob& job, std::int64_t seed) {
  return {.candidate = job.candidate, .source = job.profile.name, .instance = {}, .seed = seed};
}

std::vector<ScorePlace> places_of(const EvaluationPlan& plan) {
  std::vector<ScorePlace> places;
  for (const EvaluationJob& job : plan.jobs)
    for (const std::int64_t seed : job.seeds)
      places.push_back(place_of(job, seed));
  return places;
}

/// Runs the jobs one after the other, and prints each run.
class Evaluation {
 public:
  Evaluation(const EvaluationPlan& plan, const RecordingArguments& recording, Output& output)
      : plan_(plan),
        recording_(recording),
        output_(output),
        answer_(recording.takes_standard_output() ? output.err : output.out),
        counter_(output, "simulated", "runs"),
        of_(runs_of(plan)) {}

  ExitCode run() {
    if (!plan_.store.empty()) {
      auto keeper = ScoreKeeper::open(plan_.store);
      if (!keeper) return fail(output_, ExitCode::Store, keeper.error());
      keeper_ = std::move(*keeper);
      if (const auto room = keeper_->check_room(places_of(plan_)); !room) {
        return fail(output_, ExitCode::Usage,
                    room.error().message +
                        ": give fewer seeds, or add --no-store to print the scores only");
      }
    }
    const EvaluationJob& first = plan_.jobs.front();
    auto recording = Recording::start(recording_, first.mission, first.controller, output_);
    if (!recording) {
      return fail(output_, exit_code_of_recording(recording.error()), recording.error());
    }
    for (const EvaluationJob& job : plan_.jobs) {
      if (job.keeps_profile) keeper_->keep_profile(job.profile);
      for (std::size_t i = 0; i < job.seeds.size(); ++i)
        run_one(job, i, recording->recorder());
      // Commits after each design, so that little is lost if this process is stopped.
      if (!keeper_) continue;
      if (auto written = keeper_->commit(); !written) {
        return fail(output_, ExitCode::Store, written.error());
      }
    }
    counter_.tell(of_, of_);
    const auto written =
        recording->finish({plan_.machine, "seed " + std::to_string(first.seeds.front()),
                           "score " + score_text(scores_.empty() ? 0 : scores_.front())},
                          first.instances.front());
    if (!written) return fail(output_, ExitCode::Failed, written.error());
    if (!output_.json && plan_.jobs.size() == 1 && !scores_.empty())
      write_summary(answer_, scores_);
    if (!output_.json && plan_.jobs.size() > 1) write_summaries();
    return output_.out.good() && !conflicts_ && !rejected_ ? ExitCode::Done : ExitCode::Failed;
  }

 private:
  /// One line per job, because there are too many runs above to read.
  void write_summaries() {
    answer_ << "\n";
    for (const auto& [job, scores] : by_job_) {
      if (const CandidateId candidate = job->candidate)
        answer_ << to_string(design_of(candidate)) << "  " << to_string(candidate) << "  "
                << job->profile.name << "  ";
      else
        answer_ << job->name << "  ";
      write_summary(answer_, scores);
    }
  }

  void run_one(const EvaluationJob& job, std::size_t i, Recorder recorder) {
    Counter cycles(output_, "simulated", "cycles of seed " + std::to_string(job.seeds[i]));
    const auto begin = std::chrono::steady_clock::now();
    Measured result = simulate({.controller = job.controller,
                                .flavour = job.flavour,
                                .profile = job.profile,
                                .mission = job.mission,
                                .instance = job.instances[i],
                                .seed = job.seeds[i]},
                               with_counter(std::move(recorder), job.mission, cycles));
    result.wall_us = std::chrono::duration_cast<std::chrono::microseconds>(
                         std::chrono::steady_clock::now() - begin)
                         .count();
    if (!std::isfinite(result.score)) return reject(job, job.seeds[i], result.score);
    scores_.push_back(result.score);
    if (by_job_.empty() || by_job_.back().first != &job)
      by_job_.emplace_back(&job, std::vector<double>());
    by_job_.back().second.push_back(result.score);
    Told told{.job = &job, .seed = job.seeds[i], .score = result.score, .kept = {}};
    if (keeper_) told.kept = keeper_->keep(place_of(job, told.seed), result);
    if (of_ > 1) counter_.tell(static_cast<std::int64_t>(scores_.size()), of_);
    if (output_.json) {
      output_.out << as_json(told);
    } else {
      answer_ << as_line(told);
    }
    if (!told.kept || told.kept->how != How::Conflict) return;
    conflicts_ = true;
    print_error(output_, conflict_of(told));
  }

  /// A campaign would reject this score, so it is neither counted nor stored.
  void reject(const EvaluationJob& job, std::int64_t seed, double score) {
    rejected_ = true;
    if (output_.json)
      output_.out << as_json({.job = &job, .seed = seed, .score = score, .kept = {}});
    print_error(output_,
                {ErrorKind::BadInput,
                 std::string("the score is ") + (std::isnan(score) ? "not a number" : "infinite") +
                     ", and a campaign rejects such an evaluation",
                 "seed " + std::to_string(seed)});
  }

  const EvaluationPlan& plan_;
  const RecordingArguments& recording_;
  Output& output_;
  std::ostream& answer_;
  Counter counter_;
  std::int64_t of_;
  std::optional<ScoreKeeper> keeper_;
  std::vector<double> scores_;
  std::vector<std::pair<const EvaluationJob*, std::vector<double>>> by_job_;
  bool conflicts_ = false;
  bool rejected_ = false;
};

ExitCode run(const EvaluateOptions& arguments, Output& output) {
  const auto plan = plan_evaluations(arguments, output);
  if (!plan) {
    const Error& error = plan.error();
    const bool no_candidate = error.kind == ErrorKind::NotFound && error.where.empty();
    if (no_candidate) return fail(output, ExitCode::NoSuchId, error);
    const bool no_store = error.kind != ErrorKind::BadInput;
    return fail(output, no_store ? ExitCode::Store : ExitCode::Usage, error);
  }
  if (arguments.recording.any() && runs_of(*plan) > 1) {
    return fail(output, ExitCode::Usage,
                "tables and pictures show one run, and this would be " +
                    std::to_string(runs_of(*plan)) + ": name one machine and one seed");
  }
  return Evaluation(*plan, arguments.recording, output).run();
}

}  // namespace

CommandRun declare_evaluate(Options& options) {
  auto arguments = std::make_shared<EvaluateOptions>();
  options.text("MACHINE BEST|CANDIDATE|FILE", arguments->machine,
               "Text that begins with --nstates, --fsm-config, --nroot, --rootnode, --bt-config or "
               "--network, a file of such texts or of genomes, a candidate "
               "(c812), or best: "
               "the winner of each finished design",
               Options::Need::Required);
  options.text(
      "--flavour FLAVOUR|FILE", arguments->flavour,
      "Flavour of the machine (default: the candidate's or the file's); `swarmsmith flavour` "
      "lists the built-in ones");
  options.choice("--turn-clock", arguments->turn_clock, {"cycles", "seconds"},
                 "What turns of exploration are measured in (default: as the candidate or the file "
                 "says, else the flavour's)");
  options.text(
      "--profile PROFILE|FILE", arguments->profile,
      "Simulator profile: " + joined(profile_names()) +
          " or a file (default: the candidate's or the file's, else rvr or epuck, as the robot "
          "is)");
  options.text("--mission MISSION|FILE", arguments->mission,
               joined(mission_names()) + " or a file (default: the candidate's or the file's)");
  options.text("--campaign FILE", arguments->campaign,
               "Campaign file or store with flavour, profile and mission");
  options.texts("--design DESIGN", arguments->designs,
                "Design of the campaign (default: d1, if they differ only in repetition); with "
                "best repeatable (default: all)");
  options.text("--seeds SEEDS", arguments->seeds,
               "Seeds of the runs: 1-10 or 1,4,7-9 (default: the seeds of the tests in the file, "
               "else 1-10; for candidates one that no race or test of the store used)");
  options.text("--starts FILE", arguments->starts, "CSV of starting poses: seed,robot,x,y,theta");
  options.text("--patches FILE", arguments->patches, "CSV of coloured patches: seed,x,y,color");
  options.flag("--no-store", arguments->no_store,
               "Print the scores of candidates without storing them");
  arguments->store.declare(options, true);
  arguments->recording.declare(options);
  return [arguments](Output& output) { return run(*arguments, output); };
}

}  // namespace swarmsmith::cli
