#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "base/id.h"
#include "base/text/json.h"
#include "base/text/whole_file.h"
#include "robot/runtime/run_record.h"
#include "sim/engine/fitting.h"
#include "sim/files/profile_file.h"
#include "tracking/app/commands.h"
#include "tracking/app/run_analysis.h"
#include "tracking/app/run_plan.h"
#include "tracking/app/run_store.h"
#include "tracking/app/score_arguments.h"
#include "tracking/app/watch_run.h"
#include "tracking/app/written_files.h"
#include "tracking/profile/lab_profile.h"

namespace swarmsmith {
namespace {

struct ProfileArguments {
  std::vector<std::string> runs;
  std::string store;
  std::string arena;
  std::string base;
  std::string file;
};

/// The head of a robot's log, and the RUN of the command line that has it.
struct NamedLog {
  std::string word;
  LogHead head;
};

/// The robots of the runs that are used, and the reasons why other runs are not.
struct Collected {
  std::vector<Robot> models = {};  ///< of the missions, each once
  std::vector<MeasuredRobot> robots;
  std::vector<NamedLog> logs;  ///< of `robots`
  std::vector<std::string> left_out;
};

/// A run with its current results.
struct KnownRun {
  std::string word;  ///< of the command line
  std::string name;
  Verdict verdict = Verdict::Valid;
  AnalysedRun run;
};

bool is_of_store(const std::string& word) {
  return id_from_text<RealRunTag>(word).has_value();
}

/// Computes everything again from the stored sightings and logs. A person's override takes
/// precedence over the computed verdict.
OrRefusal<KnownRun> run_of_store(const ProfileArguments& arguments, const std::string& word) {
  const auto kept = kept_run(arguments.store, word);
  if (!kept) return tl::unexpected(kept.error());
  auto run = analyse_again(kept->rows);
  if (!run) return tl::unexpected(std::move(run.error()));
  const VerdictOverride* by_person = overriding(kept->overrides);
  const Verdict verdict = by_person == nullptr ? run->scored.verdict : by_person->verdict;
  return KnownRun{word, word + " " + kept->rows.name, verdict, std::move(*run)};
}

/// Analyses the film of a run log in the same way as `track score`.
OrRefusal<KnownRun> run_of_log(const ProfileArguments& arguments, const std::string& word,
                               Output& output) {
  ScoreArguments score;
  score.run = word;
  score.arena = arguments.arena;
  score.store = arguments.store;
  auto plan = plan_run(score);
  if (!plan) return tl::unexpected(std::move(plan.error()));
  auto run = watch_run(*plan, output);
  if (!run) return tl::unexpected(std::move(run.error()));
  return KnownRun{word, run->log.name, run->scored.verdict, std::move(*run)};
}

void add_run(const KnownRun& run, Collected& collected) {
  if (run.verdict == Verdict::Invalid) {
    collected.left_out.push_back(run.name + " is INVALID");
    return;
  }
  const Robot& model = run.run.log.mission.robot;
  if (std::ranges::find(collected.models, model) == collected.models.end())
    collected.models.push_back(model);
  const std::size_t before = collected.robots.size();
  std::vector<std::string> without;
  for (const RobotFinding& robot : run.run.findings().robots) {
    if (robot.reality != nullptr) {
      collected.robots.push_back({run.name, robot.tracked->name, *robot.reality});
      collected.logs.push_back({run.word, robot.log->record.head});
    } else {
      without.push_back(robot.tracked->name);
    }
  }
  if (collected.robots.size() == before) {
    collected.left_out.push_back(run.name + " has no readable log of a robot");
    return;
  }
  for (const std::string& robot : without)
    collected.left_out.push_back(run.name + ", " + robot + " has no readable log");
}

void print_figures(const LabProfile& profile, const Collected& collected, Output& output) {
  const auto factor = [](const LabFigure& figure) { return figure.unit == "ms" ? 1000.0 : 100.0; };
  if (output.json) {
    output.out << JsonObject()
                      .add("figures",
                           json_list(profile.figures,
                                     [](const LabFigure& figure) {
                                       const auto of = [&](double Pooled::*part) {
                                         return figure.value ? std::optional((*figure.value).*part)
                                                             : std::nullopt;
                                       };
                                       return JsonObject()
                                           .add("name", figure.name)
                                           .add("mean", of(&Pooled::mean))
                                           .add("low", of(&Pooled::low))
                                           .add("high", of(&Pooled::high))
                                           .add("spread", of(&Pooled::spread))
                                           .add("robots_in_runs",
                                                figure.value ? figure.value->count : 0)
                                           .add("basis", figure.basis)
                                           .add("reason", figure.reason);
                                     }))
                      .add("left_out", collected.left_out)
                      .add("profile", profile.text)
                      .text()
               << "\n";
    return;
  }
  for (const std::string& run : collected.left_out)
    output.out << "left out: " << run << "\n";
  for (const LabFigure& figure : profile.figures) {
    if (!figure.value) {
      output.out << figure.name << ": unknown, " << figure.reason << "\n";
      continue;
    }
    const double scale = factor(figure);
    output.out << fmt::format("{}: {:.1f} {} [{:.1f}, {:.1f}], spread {:.1f} {}, {}\n", figure.name,
                              scale * figure.value->mean, figure.unit, scale * figure.value->low,
                              scale * figure.value->high, scale * figure.value->spread, figure.unit,
                              figure.basis);
  }
}

ExitCode write(const ProfileArguments& arguments, const LabProfile& profile,
               const Collected& collected, Output& output) {
  if (!arguments.file.empty() && arguments.file != "-") {
    if (const auto written = write_whole_file(arguments.file, profile.text); !written)
      return fail(output, ExitCode::Failed, written.error());
  }
  if (arguments.file == "-" && !output.json) {
    output.out << profile.text;
    return ExitCode::Done;
  }
  print_figures(profile, collected, output);
  if (!arguments.file.empty()) {
    print_note(output, arguments.file +
                           ": use it in a campaign file with [simulator] profile = \"" +
                           arguments.file + "\"");
  }
  return ExitCode::Done;
}

/// A run counts only once; it may be in the store and have a run log, or have two numbers.
std::optional<std::string> same_run(const std::vector<NamedLog>& logs) {
  for (std::size_t i = 0; i < logs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (logs[i].head != logs[j].head) continue;
      return logs[j].word + " and " + logs[i].word + " have the same log of " + logs[i].head.robot +
             ", so they are one run; name it once";
    }
  }
  return std::nullopt;
}

/// The base, which must fit the robots of all runs.
Expected<std::string> base_of(const ProfileArguments& arguments, const Collected& collected) {
  std::string base = arguments.base;
  if (base.empty())
    base = usual_profile(collected.models.empty() ? rvr() : collected.models.front());
  const Profile profile = built_in_profile(base).value();
  for (const Robot& robot : collected.models) {
    if (const auto why = misfit(profile, robot))
      return bad_input(
          *why + "; give another --base" + profiles_text(robot) + ", or runs of another robot",
          "--base");
  }
  return base;
}

/// Refuses to overwrite a file, and to write a file whose name no campaign could use.
std::optional<Error> flaw_of(const std::string& file) {
  if (file.empty() || file == "-") return std::nullopt;
  const std::string name = std::filesystem::path(file).stem().string();
  if (!file.ends_with(".toml"))
    return Error{ErrorKind::BadInput, "a profile's file must end in .toml", file};
  if (built_in_profile(name)) {
    return Error{ErrorKind::BadInput,
                 "a profile gets its file's name, but `" + name +
                     "` is built in with other values; name another file",
                 file};
  }
  if (std::error_code none; std::filesystem::exists(file, none))
    return Error{ErrorKind::BadInput, "already exists; name another file", file};
  return flaw_of_output(file);
}

ExitCode run(const ProfileArguments& arguments, Output& output) {
  if (const auto flaw = flaw_of(arguments.file))
    return fail(output, exit_code_of_tracking(*flaw), *flaw);
  for (auto word = arguments.runs.begin(); word != arguments.runs.end(); ++word) {
    if (std::find(arguments.runs.begin(), word, *word) != word)
      return fail(output, ExitCode::Usage, {ErrorKind::BadInput, "is named twice", *word});
    if (!is_of_store(*word) && arguments.arena.empty()) {
      return fail(output, ExitCode::Usage,
                  {ErrorKind::BadInput, "is a run log: name its arena file with --arena", *word});
    }
  }
  Collected collected;
  for (const std::string& word : arguments.runs) {
    const auto known =
        is_of_store(word) ? run_of_store(arguments, word) : run_of_log(arguments, word, output);
    if (!known) return fail(output, known.error());
    add_run(*known, collected);
  }
  if (const auto flaw = same_run(collected.logs))
    return fail(output, ExitCode::Usage, {ErrorKind::BadInput, *flaw, ""});
  const auto base = base_of(arguments, collected);
  if (!base) return fail(output, ExitCode::Usage, base.error());
  const LabProfile profile =
      lab_profile({.robots = collected.robots, .base = *base, .program = track_program_name()});
  if (!profile.is_measured()) {
    std::string why = "these runs show nothing that a profile needs";
    for (const std::string& run : collected.left_out)
      why += "; " + run;
    for (const LabFigure& figure : profile.figures) {
      if (!collected.robots.empty() && !figure.value)
        why += "; " + figure.name + ": " + figure.reason;
    }
    return fail(output, ExitCode::Failed, Error{ErrorKind::BadInput, why, ""});
  }
  const std::string name =
      arguments.file.empty() || arguments.file == "-" ? "lab.toml" : arguments.file;
  if (const auto read = parse_profile(profile.text, name); !read)
    return fail_all(output, read.error());
  return write(arguments, profile, collected, output);
}

}  // namespace

CommandRun declare_track_profile(Options& options) {
  auto arguments = std::make_shared<ProfileArguments>();
  options.words("RUN", arguments->runs, "Runs of the store (r7), or run logs (run07.toml)",
                Options::Need::Required);
  options.text("-o,--output FILE", arguments->file,
               "Profile to write; never overwritten (- prints it)");
  options.text("--store STORE", arguments->store, "The store (else SWARMSMITH_STORE)");
  options.text("--arena FILE", arguments->arena, "Arena file of the run logs");
  options.choice("--base", arguments->base, profile_names(),
                 "Built-in profile for everything else (default: that of the robot)");
  return [arguments](Output& output) { return run(*arguments, output); };
}

}  // namespace swarmsmith
