#include <sys/ioctl.h>
#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "base/environment.h"
#include "base/shown_text.h"
#include "base/text/json.h"
#include "cli/arguments/store_argument.h"
#include "cli/commands/commands.h"
#include "cli/output/query_output.h"
#include "cli/output/status_text.h"
#include "cli/output/stored_campaigns.h"
#include "cli/output/stored_quarantine.h"
#include "cli/run/coordinator_link.h"
#include "console/terminal.h"
#include "proto/access/address.h"
#include "proto/access/coordinator_file.h"
#include "proto/access/find_coordinator.h"

namespace swarmsmith::cli {
namespace {

struct StatusArguments {
  StoreArgument store;
  std::string connect;
  std::string key;
  bool insecure_plaintext = false;
  bool watch = false;
};

/// The names in the first version of the JSON. They stay beside the names of the second version
/// until the next version.
constexpr const char* kCampaign = "SELECT * FROM v_campaign_status";
constexpr const char* kDesigns =
    "SELECT design, mission, method, repetition, state, iteration, used, budget, best_candidate, "
    "best_mean, reason FROM v_designs ORDER BY design";
/// The latest commands.
constexpr const char* kCommands =
    "SELECT number, kind, design, budget, step, who, at FROM v_commands "
    "ORDER BY number DESC LIMIT 20";
constexpr const char* kFailures = "SELECT count(*) AS failures FROM v_failures";

/// Other facts from a store, besides the state of its campaigns.
struct StoredFacts {
  Rows campaign;
  Rows designs;
  Rows commands;
  std::string failures;
};

Expected<StoredFacts> read_facts(StoreReader& store) {
  StoredFacts facts;
  Rows failures;
  for (const auto& [sql, rows] : {std::pair{kCampaign, &facts.campaign},
                                  {kDesigns, &facts.designs},
                                  {kFailures, &failures},
                                  {kCommands, &facts.commands}}) {
    if (sql == kCommands && store.schema() < 3) continue;  // older stores have no commands
    auto found = select(store, sql);
    if (!found) return Unexpected(found.error());
    letter_ids(*found);
    *rows = std::move(*found);
  }
  facts.failures = failures.cells.front().front().text;
  return facts;
}

void write_text(Output& output, const LiveStatus& status, const StoredFacts& facts,
                const Screen& screen, const std::string& store) {
  for (const std::string& line : status_lines(status, screen))
    output.out << as_shown(line, Layout::Escaped) << "\n";
  output.out << "\nfailed " << facts.failures << "\n";
  if (!facts.commands.cells.empty()) output.out << "\n" << rows_as_text(facts.commands);
  const std::vector<std::string> quarantine = quarantine_lines(status.quarantine, store);
  if (!quarantine.empty()) output.out << "\n";
  for (const std::string& line : quarantine)
    output.out << as_shown(line, Layout::Escaped) << "\n";
}

/// Replaces states and stages by those in `campaigns`, because the store has only the ones that its
/// last writer wrote.
void correct(StoredFacts& facts, const std::vector<CampaignStatus>& campaigns, bool is_written) {
  const std::size_t state = facts.campaign.column("state");
  for (std::size_t i = 0; i < facts.campaign.cells.size() && i < campaigns.size(); ++i)
    facts.campaign.cells[i][state].text = campaigns[i].state;
  mark_interrupted(facts.designs, is_written);
  std::map<std::string, std::string> stages;
  for (const CampaignStatus& campaign : campaigns) {
    for (const DesignStatus& design : campaign.designs) {
      if (!design.stage.empty()) stages[to_string(design.id)] = design.stage;
    }
  }
  if (stages.empty()) return;
  facts.designs.columns.emplace_back("stage");
  for (auto& cells : facts.designs.cells)
    cells.push_back({StoreReader::Cell::Type::Text, stages[cells.front().text]});
}

/// The coordinator's status, together with other facts from its store.
std::string json_of(const LiveStatus& status, const StoredFacts& facts) {
  Rows paused{.columns = {"design"}};
  for (const CampaignStatus& campaign : *status.campaigns) {
    for (const DesignStatus& design : campaign.designs) {
      if (design.paused)
        paused.cells.push_back({{StoreReader::Cell::Type::Text, to_string(design.id)}});
    }
  }
  return to_json(status)
      .add("failures", JsonPiece{facts.failures})
      .add("commands", rows_as_json(facts.commands))
      .add("campaign", row_as_json(facts.campaign, 0))
      .add("designs", rows_as_json(facts.designs))
      .add("paused", rows_as_json(paused))
      .text();
}

/// The coordinator to ask: the one that the user named by its address or file, else the one of the
/// file beside the store. NotFound if no coordinator seems to be running.
Expected<FoundCoordinator> coordinator_of(const StatusArguments& arguments) {
  CoordinatorSearch search;
  search.role = "reader";
  search.key = arguments.key;
  search.insecure_plaintext = arguments.insecure_plaintext;
  const std::string named =
      arguments.connect.empty() ? environment("SWARMSMITH_COORDINATOR") : arguments.connect;
  if (named.empty()) {
    const auto store = arguments.store.path();
    if (!store) return unexpected(ErrorKind::NotFound, store.error().message);
    search.file = coordinator_file_of(real_store(*store));
  } else if (const auto endpoint = endpoint_of(named, true)) {
    search.endpoint = *endpoint;
  } else if (!arguments.connect.empty() && !std::filesystem::exists(named)) {
    return Unexpected(endpoint.error());
  } else {
    search.file = named;
  }
  return find_coordinator(search);
}

Screen screen_of(const Output& output) {
  winsize size = {};
  if (output.out_is_terminal && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    // The last line stays empty: a line end there would scroll.
    return {size.ws_col, size.ws_row > 1 ? size.ws_row - 1U : 23U};
  }
  constexpr auto kAll = std::numeric_limits<std::size_t>::max();
  return {kAll, kAll};
}

/// Draws the lines over the previous screen, without clearing it in between.
void redraw(Output& output, const std::vector<std::string>& lines) {
  output.out << Verbatim{"\x1b[H"};
  for (const std::string& line : lines)
    output.out << as_shown(line, Layout::Escaped) << Verbatim{"\x1b[K"} << "\n";
  output.out << Verbatim{"\x1b[J"};
}

void write_live(const StatusArguments& arguments, Output& output, const LiveStatus& status) {
  if (!arguments.watch) {
    for (const std::string& line : status_lines(status, screen_of(output)))
      output.out << as_shown(line, Layout::Escaped) << "\n";
  } else if (output.out_is_terminal) {
    redraw(output, status_lines(status, screen_of(output)));
  } else {
    output.out << as_shown(status_summary(status), Layout::Escaped) << "\n";
  }
}

/// Prints the coordinator's status; if JSON is wanted, exactly as it arrived.
Expected<void> show_live(const StatusArguments& arguments, Output& output) {
  constexpr auto kPatience = std::chrono::seconds(3);
  const auto coordinator = coordinator_of(arguments);
  if (!coordinator) return Unexpected(coordinator.error());
  const auto json = ask_status(*coordinator, kPatience);
  if (!json) return Unexpected(json.error());
  if (output.json) {
    output.out << *json << "\n";
    return {};
  }
  const auto status = live_status_of(*json);
  if (!status) return Unexpected(status.error());
  write_live(arguments, output, *status);
  return {};
}

ExitCode show_stored(const StatusArguments& arguments, Output& output, bool& running) {
  const auto store = arguments.store.open();
  if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
  const bool is_written = has_writer(*arguments.store.path());
  auto campaigns = stored_campaigns(**store, is_written);
  if (!campaigns) return fail(output, ExitCode::Store, campaigns.error());
  auto facts = read_facts(**store);
  if (!facts) return fail(output, ExitCode::Store, facts.error());
  auto quarantine = stored_quarantine(**store);
  if (!quarantine) return fail(output, ExitCode::Store, quarantine.error());
  correct(*facts, *campaigns, is_written);
  running = campaigns->size() == 1 && campaigns->front().state == "running";
  LiveStatus status;
  status.running = false;
  status.quarantine = std::move(*quarantine);
  status.campaigns = std::make_shared<const std::vector<CampaignStatus>>(std::move(*campaigns));
  if (arguments.watch && output.out_is_terminal) output.out << Verbatim{"\x1b[H\x1b[2J"};
  if (output.json)
    output.out << json_of(status, *facts) << "\n";
  else
    write_text(output, status, *facts, screen_of(output), *arguments.store.path());
  return ExitCode::Done;
}

/// Prints the status once, or repeatedly until nothing more can change.
ExitCode run_status(const StatusArguments& arguments, Output& output) {
  // A terminal is redrawn often; a file would become too long.
  const auto pause = std::chrono::seconds(output.out_is_terminal ? 1 : 5);
  const bool has_store = arguments.store.path().has_value();
  bool was_live = false;
  while (true) {
    bool running = true;
    const auto live = show_live(arguments, output);
    if (!live && !has_store) {
      // A coordinator that was running and no longer answers has finished.
      return was_live ? ExitCode::Done : fail(output, ExitCode::Unreachable, live.error());
    }
    if (!live) {
      const bool is_news = live.error().kind != ErrorKind::NotFound && !was_live;
      if (is_news) print_note(output, to_string(live.error()) + "; this is what the store says:");
      const ExitCode shown = show_stored(arguments, output, running);
      if (shown != ExitCode::Done) return shown;
    }
    was_live |= live.has_value();
    output.out.flush();
    if (!arguments.watch || !running) return ExitCode::Done;
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace

CommandRun declare_status(Options& options) {
  auto arguments = std::make_shared<StatusArguments>();
  arguments->store.declare(options);
  options.text("--connect HOST:PORT|FILE", arguments->connect,
               "Ask the coordinator at HOST:PORT, or the one with this file (default: "
               "SWARMSMITH_COORDINATOR, else STORE.coordinator)");
  options.text("--key FILE", arguments->key,
               "Key file, if the coordinator needs one (default: SWARMSMITH_KEY, else reader.key "
               "in SWARMSMITH_KEYS or ~/.config/swarmsmith/keys)");
  options.flag("--insecure-plaintext", arguments->insecure_plaintext,
               "Ask a coordinator on another host without encryption");
  options.flag("--watch", arguments->watch, "Repeat until the campaign ends");
  return [arguments](Output& output) { return run_status(*arguments, output); };
}

}  // namespace swarmsmith::cli
