#include "cli/run/command_at_rest.h"

#include <algorithm>

#include "base/plain_text.h"
#include "cli/output/query_output.h"
#include "coordinator/campaign/campaign_file.h"
#include "coordinator/design/campaign_runner.h"
#include "coordinator/design/plans.h"
#include "coordinator/pool/principal.h"
#include "coordinator/service/live_status.h"
#include "coordinator/service/paused_designs.h"

namespace swarmsmith::cli {
namespace {

/// The designs that would continue if the campaign ran again.
std::vector<DesignId> unfinished(const std::vector<DesignStateRow>& states,
                                 const std::vector<CommandRow>& commands) {
  const std::vector<DesignId> ended = ended_designs(states, commands);
  std::vector<DesignId> left;
  for (const DesignStateRow& state : states) {
    const bool over = state.state == DesignState::Stopped ||
                      std::ranges::find(ended, state.design) != ended.end();
    if (!over) left.push_back(state.design);
  }
  return left;
}

/// One row for each design that the command changes.
Expected<std::vector<CommandRow>> pauses(Store& store, const std::vector<CommandRow>& commands,
                                         const CommandRow& command) {
  const std::vector<DesignId> designs = unfinished(store.design_states(), commands);
  auto rows = rows_of_pause(command, designs, paused_designs(commands));
  if (!rows) {
    return bad_input("it is over; designs that are not: " + listed(designs),
                     to_string(command.design));
  }
  return std::move(*rows);
}

/// Asks the replayed design, in its current state, whether it accepts the command.
Expected<void> ask_design(Store& store, const Campaign& campaign,
                          const std::vector<CommandRow>& commands, const CommandRow& command) {
  auto plans = plans_of(campaign);
  if (!plans) return Unexpected(plans.error());
  const auto plan =
      std::ranges::find(*plans, command.design, [](const DesignPlan& each) { return each.row.id; });
  if (plan == plans->end()) {
    return bad_input("the campaign has no such design", to_string(command.design));
  }
  std::vector<DesignId> others;
  for (const DesignPlan& each : *plans) {
    if (each.row.id != command.design) others.push_back(each.row.id);
  }
  plan->commands = commands_to(command.design, commands);
  auto stored = by_design(store.scores(), store.steps(), others);
  auto runner = DesignRunner::start(std::move(*plan), std::move(stored[command.design]));
  if (!runner) return Unexpected(runner.error());
  std::vector<Task> tasks;
  std::vector<Row> rows;
  if (auto advanced = runner->advance(tasks, rows); !advanced) return advanced;
  return runner->command(command, rows);
}

/// Written in one transaction, and on disk when this returns.
Expected<void> write(Store& store, std::vector<CommandRow> commands, std::int64_t number) {
  std::vector<Row> rows;
  for (CommandRow& command : commands) {
    command.number = ++number;
    rows.emplace_back(std::move(command));
  }
  store.append(std::move(rows));
  return store.flush();
}

/// The principals of the workers in quarantine on the host with this name.
Expected<std::vector<std::string>> principals_on(const std::filesystem::path& path,
                                                 const std::string& host) {
  const auto reader = StoreReader::open(path);
  if (!reader) return Unexpected(reader.error());
  const auto rows = select(**reader,
                           "SELECT DISTINCT principal FROM v_workers WHERE state = "
                           "'quarantined' AND host = " +
                               sql_text(host));
  if (!rows) return Unexpected(rows.error());
  std::vector<std::string> principals;
  for (const auto& cells : rows->cells)
    principals.push_back(cells.front().text);
  return principals;
}

Expected<std::string> forgive(Store& store, const std::filesystem::path& path,
                              const CommandRow& command) {
  const auto on_host = principals_on(path, command.whom);
  if (!on_host) return Unexpected(on_host.error());
  std::vector<std::string> names, known;
  std::vector<Row> rows;
  for (const Quarantine& one : store.trust().quarantined) {
    if (std::ranges::find(known, one.principal) != known.end()) continue;
    known.push_back(one.principal);
    const bool is_on_host = std::ranges::find(*on_host, one.principal) != on_host->end();
    if (!is_on_host && !is_named(one.principal, command.whom)) continue;
    names.push_back(one.principal);
    rows.emplace_back(ForgivenRow{one.principal});
    rows.emplace_back(
        event_row("info", "workers forgiven", {{"who", one.principal}, {"by", command.who}}));
  }
  if (names.empty()) return not_in_quarantine(command.whom, known);
  store.append(std::move(rows));
  if (auto written = store.flush(); !written) return Unexpected(written.error());
  return sentence_of_forgiven(names);
}

}  // namespace

Expected<std::string> command_at_rest(Store& store, const CampaignRow& known,
                                      const std::filesystem::path& path,
                                      const CommandRow& command) {
  if (command.kind == CommandKind::Forgive) return forgive(store, path, command);
  const std::vector<CommandRow> commands = store.commands();
  const std::int64_t last = commands.empty() ? 0 : commands.back().number;
  if (is_of_leases(command.kind)) {
    const auto rows = pauses(store, commands, command);
    if (!rows) return Unexpected(rows.error());
    if (!rows->empty()) {
      if (auto written = write(store, *rows, last); !written) return Unexpected(written.error());
    }
    return sentence_of_pause(command.kind, *rows);
  }
  const auto campaign = parse_campaign(known.file, path.string());
  if (!campaign) return Unexpected(campaign.error().front());
  if (auto asked = ask_design(store, *campaign, commands, command); !asked) {
    return Unexpected(asked.error());
  }
  if (auto written = write(store, {command}, last); !written) return Unexpected(written.error());
  const std::string name = to_string(command.design);
  if (command.kind == CommandKind::Cancel) return name + " ends when the campaign is run again";
  return name + " gets " + counted(command.budget, "more experiment") +
         " when the campaign is run again";
}

}  // namespace swarmsmith::cli
