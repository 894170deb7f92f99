#include <algorithm>
#include <memory>
#include <utility>

#include "base/id.h"
#include "base/plain_text.h"
#include "base/text/json.h"
#include "tracking/app/commands.h"
#include "tracking/app/robot_files.h"
#include "tracking/app/run_analysis.h"
#include "tracking/app/run_checks.h"
#include "tracking/app/run_options.h"
#include "tracking/app/run_plan.h"
#include "tracking/app/run_store.h"
#include "tracking/app/same_film.h"
#include "tracking/app/score_arguments.h"
#include "tracking/detection/tag_detector.h"
#include "tracking/observing/observe.h"
#include "tracking/report/result_text.h"
#include "tracking/scoring/real_run_rows.h"

namespace swarmsmith {
namespace {

struct RescoreArguments {
  std::vector<std::string> runs;
  std::string store;
  std::string arena;
  std::string log;
  StartArguments begin;
  bool all_checks = false;
};

/// Reads a corrected run log. Measurements from the pictures are kept, because the pictures are not
/// available.
OrRefusal<RunLog> mended_log(const std::string& file, const RunLog& before) {
  auto read = read_run_log(file);
  if (!read) return refused(std::move(read.error()));
  RunLog log = std::move(*read);
  if (log.videos.empty()) log.videos = before.videos;
  if (log.mission.name.empty()) log.mission = before.mission;
  if (log.notes.empty()) log.notes = before.notes;
  if (log.recorded.empty()) log.recorded = before.recorded;
  if (log.layout.source == RunLayout::Source::None && log.mission.name == before.mission.name)
    log.layout = before.layout;
  if (!log.start.time_s && log.start.sync == RunStart::Sync::None) log.start = before.start;
  if (log.videos.size() != before.videos.size()) {
    return refused(error_of(IssueCode::Config,
                            "the run has " + counted(before.videos.size(), "video") + ", the log " +
                                std::to_string(log.videos.size()),
                            file));
  }
  for (std::size_t i = 0; i < log.videos.size(); ++i) {
    if (log.videos[i].camera.empty()) log.videos[i].camera = before.videos[i].camera;
    if (log.videos[i].camera == before.videos[i].camera) continue;
    return refused(error_of(IssueCode::Config,
                            "video " + std::to_string(i + 1) + " of the run is from camera \"" +
                                before.videos[i].camera + "\", the log says \"" +
                                log.videos[i].camera + "\"",
                            file));
  }
  if (log.layout.source != RunLayout::Source::Measured) return log;
  if (before.layout.source != RunLayout::Source::Measured) {
    return refused(error_of(IssueCode::LayoutMissing,
                            "the patches of this run were not measured while its video was here; "
                            "add them with [[patch]], or score the video again",
                            file));
  }
  log.layout = before.layout;
  return log;
}

/// Reads the robots' logs that a corrected run log names; if a file is missing, the stored log is
/// kept if it still belongs to the run.
void read_logs_again(const RunLog& log, const std::string& file,
                     const std::optional<RanMachine>& machine, Observations& observations) {
  RobotFiles files = read_robot_files(log, std::filesystem::path(file).parent_path(), machine);
  for (const Issue& issue : std::exchange(files.issues, {})) {
    const auto stored = std::ranges::find(observations.logs, issue.robot, &RobotLog::robot);
    if (issue.code != IssueCode::LogUnreadable || stored == observations.logs.end()) {
      files.issues.push_back(issue);
    } else {
      take_log(std::move(*stored), log, machine, files);
    }
  }
  observations.logs = std::move(files.logs);
  std::erase_if(observations.issues, [](const Issue& issue) {
    return issue.code == IssueCode::LogUnreadable || issue.code == IssueCode::LogForeign;
  });
  observations.issues.insert(observations.issues.end(), files.issues.begin(), files.issues.end());
}

/// When a tag was seen depends on what the arena file says of the camera's stamps, exposure and
/// readout.
void time_again(const Rig& before, const Rig& now, Observations& observations) {
  for (Sighting& seen : observations.sightings) {
    // A damaged store may name a camera that does not exist.
    if (seen.camera < 0 || seen.camera >= std::ssize(observations.cameras)) continue;
    const CameraRecord& record = observations.cameras[static_cast<std::size_t>(seen.camera)];
    const CameraSetup* was = before.setup_of(record.camera);
    const CameraSetup* is = now.setup_of(record.camera);
    const auto frame = static_cast<std::size_t>(std::max<std::int64_t>(seen.frame, 0));
    if (was == nullptr || is == nullptr || frame >= record.frame_times.size()) continue;
    if (was->stamped_at == is->stamped_at && was->exposure_s == is->exposure_s &&
        was->readout_s == is->readout_s)
      continue;
    seen.time_s =
        exposed_at(*is, record.frame_times[frame], middle_of(seen.corners).v, record.size.height);
  }
}

/// A run that was scored again.
struct Again {
  AnalysedRun run;
  RealRunRows rows;
};

OrRefusal<Again> score_again(const RescoreArguments& arguments, const RealRunRows& before) {
  auto stored = stored_run(before);
  if (!stored) return refused(std::move(stored.error()));
  std::string arena_text = before.arena_file;
  if (!arguments.arena.empty()) {
    auto arena = read_arena_file(arguments.arena);
    if (!arena) return tl::unexpected(std::move(arena.error()));
    arena_text = std::move(arena->text);
    time_again(stored->rig, arena->rig, stored->observations);
    stored->rig = std::move(arena->rig);
  }
  CandidateId candidate = before.candidate;
  if (!arguments.log.empty()) {
    auto log = mended_log(arguments.log, stored->log);
    if (!log) return tl::unexpected(std::move(log.error()));
    stored->log = std::move(*log);
    if (auto named = check_source(stored->log, store_word(arguments.store)); !named)
      return tl::unexpected(std::move(named.error()));
    std::optional<RanMachine> machine;
    RunLog ran = stored->log;
    if (ran.design.empty() && ran.candidate.empty() && candidate)
      ran.candidate = to_string(candidate);
    if (!ran.design.empty() || !ran.candidate.empty()) {
      const auto control = control_of(store_word(arguments.store), ran);
      if (!control) return tl::unexpected(control.error());
      if (auto fits = check_mission(*control, ran, store_word(arguments.store)); !fits)
        return tl::unexpected(std::move(fits.error()));
      candidate = control->candidate;
      machine = control->machine;
    }
    read_logs_again(stored->log, arguments.log, machine, stored->observations);
  }
  std::vector<Error> errors = take_start(arguments.begin, stored->log);
  for (Error& error : settle_names(stored->log, stored->rig))
    errors.push_back(std::move(error));
  if (!errors.empty()) return refused(std::move(errors));
  errors =
      faults_of_rig(rig_of_run(stored->rig, stored->log), stored->log.mission, before.score.biased);
  for (Error& error : faults_of_points(stored->log))
    errors.push_back(std::move(error));
  if (!errors.empty()) return refused(std::move(errors));
  auto run = analyse(std::move(stored->observations), stored->rig, std::move(stored->log),
                     before.score.biased);
  if (!run) return tl::unexpected(std::move(run.error()));
  RealRunRows rows = run->rows(arena_text, candidate);
  return Again{std::move(*run), std::move(rows)};
}

/// What a person has said of the scoring before, if that no longer counts.
std::optional<std::string> void_override(const KeptRun& before, const RunFindings& run,
                                         const std::string& word) {
  const VerdictOverride* by_person = overriding(before.overrides);
  if (by_person == nullptr || overriding(run.overrides) != nullptr) return std::nullopt;
  return "The verdict " + std::string(name_of(by_person->verdict)) + " by " + by_person->who +
         " no longer counts: inputs or result are not those that " + by_person->who +
         " saw. If it still holds, repeat it: `swarmsmith track override " + word + " --store " +
         command_word(before.store) + "`.";
}

void print_again(const std::string& word, const KeptRun& before, const RunFindings& run,
                 bool all_checks, Output& output) {
  const RealScoreRow& score = before.rows.score;
  const auto no_longer = void_override(before, run, word);
  if (output.json) {
    JsonObject object;
    object.add("run", word)
        .add("before", JsonObject().add("score", score.score).add("verdict", before.verdict()));
    add_result(object, run);
    if (no_longer) object.add("override", *no_longer);
    output.out << object.text() << "\n";
    return;
  }
  output.out << word << " was: score " << score_text(score.score) << ", " << before.verdict()
             << "\n"
             << word << " is now: " << result_text(run, all_checks);
  if (no_longer) print_note(output, *no_longer);
}

ExitCode rescore_one(const RescoreArguments& arguments, const std::string& word, Output& output) {
  const auto kept = kept_run(arguments.store, word);
  if (!kept) return fail(output, kept.error());
  const auto again = score_again(arguments, kept->rows);
  if (!again) return fail(output, again.error());
  auto store = open_store(kept->store, StoreAtRest::IfMissing::Refuse);
  if (!store) return fail(output, store.error());
  // With the start that it had, it is no more doubtful than before.
  if (again->rows.key != kept->rows.key) {
    if (const auto other =
            check_same_film(again->run, again->rows.key, kept->store, kept->id, output);
        !other)
      return fail(output, other.error());
  }
  const auto written = (*store)->rescore_real_run(kept->id, again->rows);
  store->reset();
  if (!written) return fail(output, ExitCode::Store, written.error());
  // Read again, because the store decides whether an override still counts after this scoring.
  const auto now = kept_run(kept->store, word);
  if (!now) return fail(output, now.error());
  RunFindings findings = again->run.findings();
  findings.overrides = now->overrides;
  print_again(word, *kept, findings, arguments.all_checks, output);
  return findings.verdict() == Verdict::Invalid ? ExitCode::InvalidRun : ExitCode::Done;
}

/// Scores all runs, even if one fails; the first failure decides the exit code.
ExitCode run(const RescoreArguments& arguments, Output& output) {
  if (const auto store = named_store(arguments.store); !store) return fail(output, store.error());
  if (arguments.begin.are_given() && arguments.runs.size() > 1) {
    return fail(output, ExitCode::Usage,
                wrong_option("a start is that of one run; name one RUN", "--start"));
  }
  ExitCode code = ExitCode::Done;
  for (const std::string& word : arguments.runs) {
    const ExitCode one = rescore_one(arguments, word, output);
    if (code == ExitCode::Done) code = one;
  }
  return code;
}

}  // namespace

CommandRun declare_track_rescore(Options& options) {
  auto arguments = std::make_shared<RescoreArguments>();
  options.words("RUN", arguments->runs, "Runs of the store: r7", Options::Need::Required);
  options.text("--store STORE", arguments->store, "The store (else SWARMSMITH_STORE)");
  options.text("--arena FILE", arguments->arena,
               "Arena file with the calibrations to use now (default: those of the store)");
  options.text("--run FILE", arguments->log, "Run log to use now (default: that of the store)");
  arguments->begin.declare(options);
  options.flag("--checks", arguments->all_checks,
               "List all checks of the run: number, limit, what each catches");
  return [arguments](Output& output) { return run(*arguments, output); };
}

}  // namespace swarmsmith
