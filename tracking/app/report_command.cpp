#include <memory>

#include "base/text/whole_file.h"
#include "console/terminal.h"
#include "tracking/app/commands.h"
#include "tracking/app/run_analysis.h"
#include "tracking/app/run_store.h"
#include "tracking/app/written_files.h"
#include "tracking/report/quality.h"

namespace swarmsmith {
namespace {

struct ReportArguments {
  std::string run;
  std::string store;
  std::string file;
};

/// Writes the report to the named file, or to standard output if the file is "-".
ExitCode write(const std::string& text, const ReportArguments& arguments, Output& output) {
  if (output.json || arguments.file == "-") {
    write_data(output, text + (text.ends_with('\n') ? "" : "\n"));
    return ExitCode::Done;
  }
  const std::string file = arguments.file.empty() ? arguments.run + ".html" : arguments.file;
  if (const auto written = write_whole_file(file, text); !written)
    return fail(output, ExitCode::Failed, written.error());
  print_note(output, "wrote " + file);
  return ExitCode::Done;
}

/// Computes everything again from the stored sightings, which gives the stored results.
ExitCode run(const ReportArguments& arguments, Output& output) {
  if (output.json && !arguments.file.empty()) {
    return fail(output, ExitCode::Usage,
                "--json prints the report as JSON; name no file, or leave --json out");
  }
  const std::string file =
      arguments.file.empty() && !output.json ? arguments.run + ".html" : arguments.file;
  if (const auto flaw = flaw_of_output(file)) return fail(output, ExitCode::Failed, *flaw);
  const auto kept = kept_run(arguments.store, arguments.run);
  if (!kept) return fail(output, kept.error());
  const RealScoreRow& before = kept->rows.score;
  const auto again = analyse_again(kept->rows);
  if (!again) return fail(output, again.error());
  RunFindings run = again->findings();
  if (run.scored.score != before.score || name_of(run.scored.verdict) != before.verdict) {
    print_note(output,
               "The stored score or verdict differs; another version of this program made it (" +
                   before.program + "); `swarmsmith track rescore " + arguments.run +
                   "` updates it.");
  }
  run.overrides = kept->overrides;
  run.program = before.program;
  return write(output.json ? quality_json(run) : quality_html(run), arguments, output);
}

}  // namespace

CommandRun declare_track_report(Options& options) {
  auto arguments = std::make_shared<ReportArguments>();
  options.text("RUN", arguments->run, "A real run: r7", Options::Need::Required);
  options.text("--store STORE", arguments->store, "Store that has it (else SWARMSMITH_STORE)");
  options.text("-o,--output FILE", arguments->file,
               "HTML file to write (default: RUN.html; - prints)");
  return [arguments](Output& output) { return run(*arguments, output); };
}

}  // namespace swarmsmith
