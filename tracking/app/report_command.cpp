#include <memory>

#include "base/text/whole_file.h"
#include "console/terminal.h"
#include "tracking/app/commands.h"
#include "tracking/app/run_analysis.h"
#include "tracking/app/run_checks.h"
#include "tracking/app/run_store.h"
#include "tracking/app/score_arguments.h"
#include "tracking/report/quality.h"
#include "tracking/scoring/real_run_rows.h"

namespace swarmsmith::cli {
namespace {

struct ReportArguments {
  std::string run;
  std::string store;
  std::string file;
};

/// What people said of a run, oldest first.
OrRefusal<std::vector<VerdictOverride>> overrides_of(StoreReader& store, const std::string& run) {
  std::vector<VerdictOverride> overrides;
  const auto end = store.query(
      "SELECT verdict, who, reason FROM v_real_overrides WHERE id = " + sql_text(run) +
          " ORDER BY number",
      {}, [](const std::vector<std::string>&) {},
      [&](const std::vector<StoreReader::Cell>& cells) {
        overrides.push_back({verdict_from_name(cells[0].text).value_or(Verdict::Invalid),
                             cells[1].text, cells[2].text});
      });
  if (!end) return refused(ExitCode::Store, end.error());
  return overrides;
}

/// Written where a person wants it; standard output when the file is "-".
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

/// All is done again from the stored sightings, which gives what was stored.
ExitCode run(const ReportArguments& arguments, Output& output) {
  if (output.json && !arguments.file.empty()) {
    return fail(output, ExitCode::Usage,
                "--json prints the report as JSON; name no file, or leave --json out");
  }
  const std::string name = store_word(arguments.store);
  if (name.empty())
    return fail(output, ExitCode::Usage, "no store; name it with --store or SWARMSMITH_STORE");
  const auto store = read_store(name);
  if (!store) return fail(output, store.error());
  const auto rows = find_run(**store, arguments.run);
  if (!rows) return fail(output, rows.error());
  const auto overrides = overrides_of(**store, arguments.run);
  if (!overrides) return fail(output, overrides.error());
  auto stored = stored_run(*rows);
  if (!stored) return fail(output, Refusal{ExitCode::Store, stored.error()});
  if (auto errors = settle_names(stored->log, stored->rig); !errors.empty())
    return fail(output, Refusal{ExitCode::Store, std::move(errors)});
  const Rig rig = rig_of_run(stored->rig, stored->log);
  const auto analysis =
      analyse(stored->observations, rig, stored->rig, stored->log, rows->score.biased);
  if (!analysis) return fail(output, analysis.error());
  if (analysis->scored.score != rows->score.score ||
      name_of(analysis->scored.verdict) != rows->score.verdict) {
    print_note(output,
               "The stored score or verdict differs; another version of this program made it (" +
                   rows->score.program + "); `swarmsmith track rescore " + arguments.run +
                   "` updates it.");
  }
  const ReportedRun reported{.rig = rig,
                             .log = stored->log,
                             .observations = stored->observations,
                             .tracked = analysis->tracked,
                             .scored = analysis->scored,
                             .patches = analysis->scored.patches,
                             .overrides = *overrides,
                             .program = rows->score.program};
  return write(output.json ? quality_json(reported) : quality_html(reported), arguments, output);
}

}  // namespace

Run declare_track_report(Options& options) {
  auto arguments = std::make_shared<ReportArguments>();
  options.text("RUN", arguments->run, "A real run: r7", Options::Need::Required);
  options.text("--store STORE", arguments->store, "Store that has it (else SWARMSMITH_STORE)");
  options.text("-o,--output FILE", arguments->file,
               "HTML file to write (default: RUN.html; - prints)");
  return [arguments](Output& output) { return run(*arguments, output); };
}

}  // namespace swarmsmith::cli
