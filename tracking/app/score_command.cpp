#include <memory>

#include "base/id.h"
#include "base/output_file.h"
#include "base/plain_text.h"
#include "base/text/json.h"
#include "base/text/whole_file.h"
#include "tracking/app/commands.h"
#include "tracking/app/run_plan.h"
#include "tracking/app/run_store.h"
#include "tracking/app/same_film.h"
#include "tracking/app/watch_run.h"
#include "tracking/app/written_files.h"
#include "tracking/report/quality.h"
#include "tracking/report/result_text.h"

namespace swarmsmith {
namespace {

/// Opens the store again only now, because a campaign may have run while the video was read.
OrRefusal<RealRunWritten> keep(const RunPlan& plan, const AnalysedRun& run, Output& output) {
  auto store = open_store(plan.store, plan.if_missing);
  if (!store) return tl::unexpected(std::move(store.error()));
  const RealRunRows rows = run.rows(plan.arena_text, plan.candidate);
  if (!(*store)->is_new()) {
    if (auto other = check_same_film(run, rows.key, plan.store, std::nullopt, output); !other)
      return tl::unexpected(std::move(other.error()));
  }
  auto written = (*store)->add_real_run(rows);
  if (written) return *written;
  return refused(written.error().kind == ErrorKind::NotFound ? ExitCode::NoSuchId : ExitCode::Store,
                 written.error());
}

Expected<void> write_files(const ScoreArguments& arguments, const RunFindings& run) {
  if (!arguments.csv.empty()) {
    auto written = write_whole_file(arguments.csv, trajectory_csv(run.tracked));
    if (!written) return written;
  }
  if (arguments.report.empty()) return {};
  return write_whole_file(arguments.report, quality_html(run));
}

/// The next step for the user.
std::string next_step(const std::string& id, const std::string& store, Verdict verdict) {
  const std::string at = id + " --store " + command_word(store);
  if (verdict != Verdict::Invalid) return "Next: `swarmsmith track report " + at + "`.";
  return "Statistics leave out an INVALID score. Next: correct the cause and `swarmsmith track "
         "rescore " +
         at + "`; or film again; or decide yourself: `swarmsmith track override " + at +
         " --verdict valid --who NAME --reason TEXT`.";
}

void print_result(const RunPlan& plan, const RunFindings& run,
                  const std::optional<RealRunWritten>& written, bool all_checks, Output& output) {
  const std::string id = written ? to_string(written->id) : "";
  if (output.json) {
    JsonObject object;
    add_result(object, run);
    if (written) object.add("store", plan.store).add("run", id).add("new", written->is_new);
    output.out << object.text() << "\n";
    return;
  }
  output.out << result_text(run, all_checks);
  if (!written) {
    print_note(output, "The run is not stored; --into STORE keeps it.");
    return;
  }
  if (!written->is_new) {
    output.out << "It was already stored, as " << id << " in " << plan.store
               << "; nothing was added.\n";
    return;
  }
  output.out << "Stored as " << id << " in " << plan.store << ".\n";
  print_note(output, next_step(id, plan.store, run.scored.verdict));
}

ExitCode score(const ScoreArguments& arguments, Output& output) {
  const auto own = each_its_own_file({{"--csv", arguments.csv}, {"--report", arguments.report}});
  if (!own) return fail(output, ExitCode::Usage, own.error());
  for (const std::string& file : {arguments.csv, arguments.report}) {
    if (const auto flaw = flaw_of_output(file)) return fail(output, ExitCode::Failed, *flaw);
  }
  auto plan = plan_run(arguments);
  if (!plan) return fail(output, plan.error());
  const auto run = watch_run(*plan, output);
  if (!run) return fail(output, run.error());
  std::optional<RealRunWritten> written;
  if (!plan->store.empty()) {
    const auto kept = keep(*plan, *run, output);
    if (!kept) return fail(output, kept.error());
    written = *kept;
  }
  const RunFindings findings = run->findings();
  print_result(*plan, findings, written, arguments.all_checks, output);
  if (const auto files = write_files(arguments, findings); !files) {
    return fail(output, ExitCode::Failed, files.error());
  }
  const bool is_known = written && !written->is_new;
  const bool is_invalid = run->scored.verdict == Verdict::Invalid;
  return is_invalid && !is_known ? ExitCode::InvalidRun : ExitCode::Done;
}

}  // namespace

CommandRun declare_track_score(Options& options) {
  auto arguments = std::make_shared<ScoreArguments>();
  arguments->declare(options);
  return [arguments](Output& output) { return score(*arguments, output); };
}

}  // namespace swarmsmith
