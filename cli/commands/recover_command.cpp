#include "base/plain_text.h"
#include "base/shown_text.h"
#include "base/text/json.h"
#include "storage/recover.h"

#include <memory>
#include <optional>

#include "cli/commands/commands.h"
#include "coordinator/campaign/campaign_file.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/design/rebuild.h"
#include "coordinator/design/verify.h"

namespace swarmsmith::cli {
namespace {

struct RecoverArguments {
  std::string damaged;
  std::string out;
  std::string second;  ///< the same as a second argument
  std::string campaign;
  std::string without_key;
};

/// Facts that are printed at the end.
struct Report {
  std::vector<Rebuilt::Design> designs;  ///< with the ids of the new store
  std::vector<std::string> complaints;
  std::optional<Recovery::Without> without;
};

/// "100 whole rows; 3 pages and 2 rows cannot be read".
std::string table_text(const SalvagedTable& table) {
  std::string text = counted(table.rows, "row");
  if (table.tree_is_lost) text += " (where the table began is lost: there may have been more)";
  if (table.lost_pages == 0 && table.broken == 0) return text;
  text += "; lost: ";
  if (table.lost_pages > 0) text += counted(table.lost_pages, "page");
  if (table.lost_pages > 0 && table.broken > 0) text += ", ";
  if (table.broken > 0) text += counted(table.broken, "row");
  return text;
}

std::string design_text(const Rebuilt::Design& design) {
  std::string text = to_string(design.id) + ": ";
  if (design.missing == 0) {
    text += "whole, ";
  } else {
    text += counted(design.missing, "evaluation is", "evaluations are") + " missing after ";
  }
  text += counted(design.used, "experiment");
  if (design.ahead > 0) {
    text += "; " + counted(design.ahead, "score of later steps is", "scores of later steps are") +
            " kept";
  }
  if (design.unasked > 0) {
    text +=
        "; " + counted(design.unasked, "score of a test is", "scores of tests are") + " left out";
  }
  return text;
}

JsonObject table_json(const SalvagedTable& table) {
  return JsonObject()
      .add("name", table.name)
      .add("rows", table.rows)
      .add("lost_pages", table.lost_pages)
      .add("broken", table.broken)
      .add("tree_lost", table.tree_is_lost);
}

JsonObject design_json(const Rebuilt::Design& design) {
  return JsonObject()
      .add("design", design.id)
      .add("used", design.used)
      .add("missing", design.missing)
      .add("ahead", design.ahead)
      .add("unasked", design.unasked);
}

void write(Output& output, const Salvaged& found, const Report& report, const Recovery::End& end,
           const std::string& file) {
  if (output.json) {
    JsonObject object;
    object.add("store", file);
    if (report.without) object.add("without", report.without->evaluations);
    output.out << object.add("digest", end.digest)
                      .add("evaluations", end.evaluations)
                      .add("schema", found.schema)
                      .add("header_damaged", found.header_is_damaged)
                      .add("unplaced", found.unplaced)
                      .add("orphans", end.orphans)
                      .add("without_parent", end.without_parent)
                      .add("changed", found.changed_evaluations)
                      .add("doubt", end.doubt)
                      .add("tables", json_list(found.tables, table_json))
                      .add("designs", json_list(report.designs, design_json))
                      .add("complaints", report.complaints)
                      .text()
               << "\n";
    return;
  }
  if (found.header_is_damaged) {
    output.out << "the header is damaged; the pages look like schema " << found.schema << "\n";
  }
  for (const SalvagedTable& table : found.tables) {
    if (table.rows > 0 || table.lost_pages > 0 || table.broken > 0 || table.tree_is_lost)
      output.out << table.name << ": " << table_text(table) << "\n";
  }
  if (found.unplaced > 0)
    output.out << counted(found.unplaced, "row") << " might belong to several tables\n";
  if (found.changed_evaluations > 0) {
    output.out << counted(found.changed_evaluations,
                          "evaluation was changed after it was written, and was",
                          "evaluations were changed after they were written, and were")
               << " left out\n";
  }
  if (end.orphans > 0) {
    output.out << counted(end.orphans, "row belongs to lost data and was",
                          "rows belong to lost data and were")
               << " left out\n";
  }
  if (end.without_parent > 0) {
    output.out << counted(end.without_parent, "imported candidate lost its parent and was",
                          "imported candidates lost their parents and were")
               << " kept without it\n";
  }
  if (report.without) {
    output.out << counted(report.without->evaluations, "evaluation") << " of "
               << counted(report.without->workers, "worker") << " were removed\n";
  }
  for (const Rebuilt::Design& design : report.designs)
    output.out << as_shown(design_text(design), Layout::Escaped) << "\n";
  for (const std::string& complaint : report.complaints)
    output.out << as_shown(complaint, Layout::Escaped) << "\n";
  output.out << file << ": " << counted(end.evaluations, "evaluation") << ", digest " << end.digest
             << "\n";
}

/// Adds the campaign of the file that the user named, if the campaign's row is lost.
Expected<void> put_campaign(Recovery& recovery, const std::string& file) {
  if (!recovery.campaigns().empty() || file.empty()) return {};
  const auto campaign = read_campaign(file);
  if (!campaign) return Unexpected(campaign.error().front());
  recovery.put_campaign(campaign_row(*campaign));
  return {};
}

/// Computes again everything that follows from scores, if this program can replay the races.
Expected<void> rebuild_campaign(Recovery& recovery, const StoredCampaign& stored, Report& report) {
  if (stored.state == "imported") return {};
  auto plans = plans_of(stored.row);
  if (!plans && report.without) {
    Error error = plans.error();
    error.message = "what follows from the other scores cannot be derived: " + error.message;
    return Unexpected(error);
  }
  if (!plans) {
    report.complaints.push_back(stored.row.name + ": " + to_string(plans.error()) +
                                "; its rows are kept as found");
    return {};
  }
  std::vector<DesignRow> designs;
  for (const DesignPlan& plan : *plans)
    designs.push_back(plan.row);
  if (auto put = recovery.put_designs(stored, designs); !put) return put;
  StoredCampaign campaign = stored;
  campaign.designs = static_cast<std::int64_t>(designs.size());
  const std::string source = plans->front().source;
  const std::vector<StoredStep> steps = recovery.steps(campaign);
  const std::vector<CommandRow> commands = recovery.commands(campaign);
  Rebuilt rebuilt;
  do {
    rebuilt = rebuild(*plans, recovery.scores(campaign), steps, commands);
  } while (recovery.replace_derived(campaign, rebuilt.derived, source) > 0);
  for (Rebuilt::Design& design : rebuilt.designs) {
    design.id.value += campaign.designs_before;
    report.designs.push_back(design);
  }
  for (const std::string& complaint : rebuilt.complaints)
    report.complaints.push_back(complaint);
  return {};
}

ExitCode run_recover(RecoverArguments& arguments, Output& output) {
  if (!arguments.out.empty() && !arguments.second.empty())
    return fail(output, ExitCode::Usage,
                "the new file is named twice: as the second word, and with -o");
  if (arguments.out.empty()) arguments.out = arguments.second;
  if (arguments.out.empty()) {
    return fail(output, ExitCode::Usage,
                "no new file given; name it second, or with -o: `swarmsmith recover damaged.db "
                "rescued.db`");
  }
  auto recovery = Recovery::begin(arguments.damaged, arguments.out);
  if (!recovery) {
    const bool about_out = recovery.error().where == arguments.out;
    return fail(output, about_out ? ExitCode::Failed : ExitCode::Store, recovery.error());
  }
  if (const auto put = put_campaign(**recovery, arguments.campaign); !put) {
    return fail(output, ExitCode::Usage, put.error());
  }
  Report report;
  if (!arguments.without_key.empty()) {
    const auto without = (*recovery)->drop_words_of(arguments.without_key);
    if (!without) return fail(output, ExitCode::NoSuchId, without.error());
    report.without = *without;
  }
  for (const StoredCampaign& campaign : (*recovery)->campaigns()) {
    if (const auto rebuilt = rebuild_campaign(**recovery, campaign, report); !rebuilt) {
      return fail(output, ExitCode::Store, rebuilt.error());
    }
  }
  const auto end = (*recovery)->finish();
  if (!end) return fail(output, ExitCode::Store, end.error());
  write(output, (*recovery)->found(), report, *end, arguments.out);
  if (!end->doubt.empty()) {
    return fail(
        output, ExitCode::Store,
        {ErrorKind::Conflict,
         "scores in this store are not reliable: " + end->doubt +
             "; `swarmsmith verify` evaluates them again, and no campaign can continue from it",
         arguments.out});
  }
  if (report.without)
    print_note(output, "the campaign continues from there with `--store " + arguments.out + "`");
  return ExitCode::Done;
}

}  // namespace

CommandRun declare_recover(Options& options) {
  auto arguments = std::make_shared<RecoverArguments>();
  options.text("DAMAGED STORE", arguments->damaged, "The damaged store's file",
               Options::Need::Required);
  options.text("NEW STORE", arguments->second, "The new store's file");
  options.text("-o,--output STORE", arguments->out, "The same");
  options.text("--without-key KEY", arguments->without_key,
               "Leave out the results of workers with that key (the key's name; for workers "
               "without one their address), and never trust it again");
  options.text("--campaign FILE", arguments->campaign,
               "The campaign's file, if the store has lost its own copy");
  return [arguments](Output& output) { return run_recover(*arguments, output); };
}

}  // namespace swarmsmith::cli
