#include <algorithm>
#include <filesystem>
#include <memory>
#include <random>

#include "base/suggestion.h"
#include "base/text/toml_text.h"
#include "base/text/whole_file.h"
#include "cli/commands/commands.h"
#include "cli/commands/import_results.h"
#include "console/terminal.h"
#include "coordinator/campaign/campaign_file.h"
#include "coordinator/campaign/campaign_text.h"
#include "coordinator/campaign/irace_campaign.h"
#include "irace_core/files/command_line.h"
#include "irace_core/files/setup.h"
#include "sim/control/flavour_file.h"

namespace swarmsmith::cli {
namespace {

namespace fs = std::filesystem;

struct ImportOptions : ImportArguments {
  std::string out;
};

/// The first lines of a campaign file: where it came from, and what can be changed in it.
std::string heading(const fs::path& scenario, const Campaign& campaign) {
  return "# The race of irace's scenario " + scenario.string() +
         ",\n"
         "# by `swarmsmith import`. Parameters, instances and options are all in this file; the\n"
         "# programs are named by their paths. Every key: docs/campaign-file.md\n"
         "#   swarmsmith check campaign.toml    what it will do\n"
         "#   swarmsmith run campaign.toml      runs it; kill it at any time, the same command "
         "continues\n" +
         normalised_text(campaign);
}

/// The table [workers], which the normalised text leaves out.
std::string workers_text(const Campaign& campaign) {
  if (!campaign.local_workers) return "";
  return "\n[workers]\nlocal = " + std::to_string(*campaign.local_workers) + "\n";
}

ExitCode import_scenario(const ImportOptions& arguments, Output& output) {
  const std::vector<std::string> words{"--scenario", arguments.file};
  const SetupSurroundings surroundings = surroundings_of_process();
  const auto line = read_irace_command_line(words, surroundings.folder);
  const auto setup = line ? read_irace_setup(*line, surroundings)
                          : IraceSetupOrErrors(tl::unexpected(line.error()));
  if (!setup) {
    for (const Error& error : setup.error())
      print_error(output, error);
    return ExitCode::Usage;
  }
  for (const std::string& warning : setup->warnings)
    print_note(output, "warning: " + warning);
  // The same range as irace's seeds: an exported folder contains the seed, and R has no larger
  // integers.
  const std::uint64_t drawn = 1 + std::random_device()() % 2'147'483'647;
  if (!setup->seed) {
    print_note(output, "the scenario has no seed; the campaign gets " + std::to_string(drawn));
  }
  const Campaign campaign = campaign_of(*setup, drawn);
  const std::vector<Error> faults = check_budget(campaign);
  for (const Error& fault : faults)
    print_error(output, {fault.kind, fault.message, {}});
  if (!faults.empty()) return ExitCode::Usage;
  const std::string text = heading(setup->scenario_file, campaign) + workers_text(campaign);
  if (arguments.out.empty()) {
    write_data(output, text);
    return ExitCode::Done;
  }
  if (auto written = write_whole_file(arguments.out, text); !written) {
    return fail(output, ExitCode::Failed, written.error());
  }
  print_note(output, "wrote " + arguments.out);
  return ExitCode::Done;
}

/// Results are added to a store; a scenario becomes a campaign file.
ExitCode run_import(const ImportOptions& arguments, Output& output) {
  if (!arguments.into.empty()) {
    if (arguments.out.empty()) return import_into_store(arguments, output);
    return fail(output, ExitCode::Usage,
                Error{ErrorKind::BadInput, "is for scenarios; --into names the store", "--output"});
  }
  const std::string ending = fs::path(arguments.file).extension().string();
  const bool has_store_words = !arguments.flavour.empty() || !arguments.missions.empty() ||
                               !arguments.method.empty() || !arguments.source.empty() ||
                               !arguments.name.empty() || !arguments.costs_of.empty() ||
                               arguments.replace;
  if (ending == ".csv" || ending == ".Rdata" || has_store_words) {
    return fail(
        output, ExitCode::Usage,
        Error{ErrorKind::BadInput, "no store given; add --into results.db", arguments.file});
  }
  return import_scenario(arguments, output);
}

}  // namespace

CommandRun declare_import(Options& options) {
  auto arguments = std::make_shared<ImportOptions>();
  options.text("FILE", arguments->file,
               "A scenario of irace; with --into scores or machines (.csv), machines (one text per "
               "line, or genomes), or a log of irace (.Rdata)",
               Options::Need::Required);
  options.text("-o,--output FILE", arguments->out,
               "Campaign file to write from a scenario (default: standard output)");
  options.text("--into STORE", arguments->into,
               "Store to import into; made if needed for machines and logs; scores need a store "
               "with their designs");
  options.text("--flavour FLAVOUR|FILE", arguments->flavour,
               "Flavour of machines whose file names none, or of a log's configurations: " +
                   joined(flavour_names()) + ", or a file");
  options.texts("--mission MISSION|FILE", arguments->missions,
                "Mission of rows that name none; OLD=NEW renames one; a mission file in place of a "
                "name describes the mission, and alone it is that of all rows; repeatable");
  options.text("--method METHOD", arguments->method,
               "Method of machines that name none (default: the flavour), or of a log (irace)");
  options.text("--name NAME", arguments->name,
               "Name of the campaign that machines or a log become");
  options.text("--source SOURCE", arguments->source,
               "Source of scores that name none, such as real");
  options.texts("--cost-of MISSION", arguments->costs_of,
                "Mission whose scores in the file are costs (smaller is better)");
  options.flag("--replace", arguments->replace,
               "Replace stored scores of the same candidate, source, seed and instance");
  return [arguments](Output& output) { return run_import(*arguments, output); };
}

}  // namespace swarmsmith::cli
