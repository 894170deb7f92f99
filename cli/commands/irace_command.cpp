#include "cli/commands/irace_command.h"

#include <filesystem>
#include <optional>

#include "base/log.h"
#include "base/plain_text.h"
#include "cli/commands/commands.h"
#include "cli/irace/ablation_way.h"
#include "cli/irace/irace_actions.h"
#include "cli/irace/irace_console.h"
#include "cli/irace/irace_run.h"
#include "console/wrapped.h"
#include "coordinator/campaign/irace_campaign.h"
#include "coordinator/campaign/programs.h"
#include "irace_core/files/command_line.h"
#include "irace_core/files/options.h"
#include "irace_core/files/scenario_text.h"
#include "irace_core/files/setup.h"

namespace swarmsmith::cli {
namespace {

/// Prints the errors. The exit code of irace is 1 for all errors.
ExitCode complain(Output& output, const std::vector<Error>& errors) {
  for (const Error& error : errors)
    print_error(output, error);
  return ExitCode::Failed;
}

/// Reads our own flags, so that they hold from the first line on.
void read_flags(const IraceSettings& settings, Output& output) {
  output.json = settings.is_on("--json");
  output.verbose = settings.is_on("--verbose");
  if (settings.is_on("--no-color")) output.color = false;
  // irace's lines say what the user wants to know, and errors are explained.
  if (output.verbose) {
    set_log_level(LogLevel::Debug);
  } else {
    set_default_log_level(LogLevel::None);
  }
}

const ProgramCommand& this_command() {
  for (const ProgramCommand& command : commands()) {
    if (command.run_words == run_irace) return command;
  }
  throw std::logic_error("irace is not a command");
}

void print_help(Output& output) {
  const ProgramCommand& command = this_command();
  output.out << command.summary << "\nUsage: swarmsmith irace [OPTIONS]\n\n"
             << irace_option_help() << '\n'
             << wrapped(command.details) << '\n';
}

/// The store is not a copy of R's log file, so .Rdata in its name becomes .db.
std::filesystem::path store_file(std::filesystem::path log_file) {
  const std::string ending = log_file.extension().string();
  if (ending == ".Rdata" || ending == ".RData" || ending == ".rda")
    log_file.replace_extension(".db");
  return log_file;
}

/// The store of the finished run that --psrace and --ablation begin from.
Expected<std::filesystem::path> finished_store(const IraceCommandLine& line,
                                               const IraceSetup& setup) {
  const IraceSetting* store = line.settings.find("--store");
  const auto text = line.settings.text("--store");
  if (text && !text->empty()) return absolute_path(*text, store->folder);
  if (!setup.log_file.empty()) return store_file(setup.log_file);
  return bad_input("names no run: give the log file of a finished run (--log-file NAME)",
                   "--log-file");
}

/// The place of --store, else of the log file, else a temporary place.
Expected<StorePlace> place_of(Output& output, const IraceCommandLine& line,
                              const IraceSetup& setup) {
  if (const IraceSetting* store = line.settings.find("--store")) {
    const auto text = line.settings.text("--store");
    if (text && !text->empty()) return StorePlace::at(absolute_path(*text, store->folder));
  }
  if (!setup.log_file.empty()) {
    const std::filesystem::path file = store_file(setup.log_file);
    if (file != setup.log_file && file.filename() != "irace.db") {
      print_note(output, "the store is " + file.string() + ": an SQLite file in place of R's " +
                             setup.log_file.string());
    }
    return StorePlace::at(file);
  }
  return StorePlace::temporary();
}

std::string instances_text(const std::string& what, const std::vector<std::string>& instances) {
  std::string text = "# " + counted(instances.size(), what + " instance") + "\n";
  for (const std::string& instance : instances)
    text += "#   " + instance + "\n";
  return text;
}

ExitCode check(Output& output, const IraceSetup& setup) {
  const Campaign campaign = campaign_of(setup, setup.seed.value_or(1));
  const IraceFileNames names{.parameters = setup.parameter_file.string(),
                             .training = setup.training_file.string(),
                             .training_folder = setup.training_folder.string(),
                             .configurations = setup.configurations_file.string()};
  output.out << "# " << irace_date() << ": Checking scenario\n## irace scenario:\n"
             << print_irace_scenario(setup, IraceVersion::V4, names).text
             << (uses_capping(setup.race) ? "# capping is on\n" : "# capping is off\n")
             << instances_text("training", setup.training) << instances_text("test", setup.test)
             << "## end of irace scenario\n## parameters:\n"
             << setup.parameter_text << "## end of parameters\n";
  return check_target(output, setup, campaign);
}

/// Runs an action that needs a finished run.
ExitCode after_run(Output& output, const IraceCommandLine& line, const IraceSetup& setup) {
  const auto finished = finished_store(line, setup);
  if (!finished) return fail(output, ExitCode::Failed, finished.error());
  const IraceSlots slots{.workers = line.settings.number("--workers"), .parallel = setup.parallel};
  return line.action == IraceAction::Ablation
             ? ablate(output, line.settings, setup, *finished, slots)
             : race_again(output, line.settings, setup, *finished, slots);
}

ExitCode carry_out(Output& output, const IraceCommandLine& line) {
  auto setup = read_irace_setup(line, surroundings_of_process());
  if (!setup) return complain(output, setup.error());
  if (const auto action = line.settings.text("--on-failure")) {
    if (*action != "stop" && *action != "reject") {
      return fail(output, ExitCode::Failed,
                  {ErrorKind::BadInput, "must be stop or reject, found \"" + *action + "\"",
                   "--on-failure"});
    }
    setup->rejects_failures = *action == "reject";
  }
  output.quiet = setup->quiet;
  for (const std::string& warning : setup->warnings)
    print_note(output, "warning: " + warning);
  if (const auto faults = check_programs(campaign_of(*setup, 1)); !faults.empty())
    return complain(output, faults);
  if (line.action == IraceAction::Check) return check(output, *setup);
  const auto workers = line.settings.number("--workers");
  if (workers && *workers < 1) {
    return fail(output, ExitCode::Failed,
                {ErrorKind::BadInput,
                 "must be 1 or more: irace runs its target on this machine (without workers, "
                 "`swarmsmith run` serves others)",
                 "--workers"});
  }
  if (line.action == IraceAction::PsRace || line.action == IraceAction::Ablation)
    return after_run(output, line, *setup);
  const auto place = place_of(output, line, *setup);
  if (!place) return fail(output, ExitCode::Failed, place.error());
  const IraceSlots slots{.workers = workers, .parallel = setup->parallel};
  if (line.action == IraceAction::OnlyTest) {
    const bool is_named = !line.settings.text("--store").value_or("").empty();
    return only_test(output, *setup, line.only_test, *place, is_named, slots);
  }
  return run_scenario(output, *setup, *place, slots);
}

}  // namespace

std::vector<DeclaredOption> irace_declared() {
  std::vector<DeclaredOption> options;
  for (const IraceOption& option : irace_options()) {
    if (option.long_switch.empty() || option.meaning == IraceMeaning::Gone) continue;
    DeclaredOption declared{.help = irace_explanation(option)};
    if (!option.short_switch.empty()) declared.names.emplace_back(option.short_switch);
    declared.names.emplace_back(option.long_switch);
    if (option.takes_value()) declared.value = irace_placeholder(option.kind);
    declared.kind = declared.value;
    if (option.kind == IraceKind::Choice) declared.choices = irace_words(option);
    if (option.kind == IraceKind::Bool) declared.choices = {"0", "1"};
    options.push_back(std::move(declared));
  }
  return options;
}

ExitCode run_irace(const std::vector<std::string>& given, Output& output) {
  std::vector<std::string> words = given;
  // R's irace has a program of this name.
  if (!words.empty() && words.front() == "ablation") {
    words.front() = "--ablation";
    auto ours = words_of_r_ablation(std::move(words));
    if (!ours) return fail(output, ExitCode::Failed, ours.error());
    words = std::move(*ours);
  }
  const auto line = read_irace_command_line(words, std::filesystem::current_path());
  if (!line) return complain(output, line.error());
  read_flags(line->settings, output);
  for (const std::string& warning : line->warnings)
    print_note(output, "warning: " + warning);
  switch (line->action) {
    case IraceAction::Help:
      print_help(output);
      return ExitCode::Done;
    case IraceAction::Version:
      return run_program({"version"}, output);
    case IraceAction::Init:
      return write_templates(output);
    case IraceAction::Run:
    case IraceAction::Check:
    case IraceAction::OnlyTest:
    case IraceAction::PsRace:
    case IraceAction::Ablation:
      break;
  }
  return carry_out(output, *line);
}

}  // namespace swarmsmith::cli
