#include <sys/ioctl.h>
#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <memory>
#include <thread>

#include "base/environment.h"
#include "base/shown_text.h"
#include "base/text/json.h"
#include "cli/arguments/store_argument.h"
#include "cli/commands/commands.h"
#include "cli/output/query_output.h"
#include "cli/output/status_text.h"
#include "cli/output/stored_quarantine.h"
#include "cli/output/stored_stages.h"
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

constexpr const char* kCampaign = "SELECT * FROM v_campaign_status";
constexpr const char* kDesigns =
    "SELECT design, mission, method, repetition, state, iteration, used, budget, best_candidate, "
    "best_mean, reason FROM v_designs ORDER BY design";
constexpr const char* kWorkers =
    "SELECT worker, host, pid, slots, state, done, failed, last_seen FROM v_workers "
    "WHERE state = 'connected' ORDER BY worker";
constexpr const char* kFailures = "SELECT count(*) AS failures FROM v_failures";

/// The last ones; whether a design is paused is in them.
constexpr const char* kOpenCommands =
    "SELECT number, kind, design, budget, step, who, at FROM v_commands "
    "ORDER BY number DESC LIMIT 20";

/// Designs that a person has paused, and that are not over.
constexpr const char* kPaused =
    "SELECT d.design FROM v_designs AS d WHERE d.state NOT IN ('finished', 'stopped') AND "
    "(SELECT c.kind FROM v_commands AS c WHERE c.design = d.design AND c.kind IN "
    "('pause', 'resume') ORDER BY c.number DESC LIMIT 1) = 'pause' ORDER BY d.design";

struct Status {
  Rows campaign;
  Rows designs;
  Rows workers;
  Rows failures;
  Rows commands;
  Rows paused;
  std::vector<QuarantineStatus> quarantine;
  std::string store;  ///< as it was named

  std::string of_campaign(std::size_t row, const std::string& column) const {
    for (std::size_t i = 0; i < campaign.columns.size(); ++i) {
      if (campaign.columns[i] == column) return campaign.cells[row][i].text;
    }
    return "";
  }
};

/// The store says what its last writer said. When nobody writes it any more, who was at work is
/// not: a campaign and its designs that are not over are "interrupted", and workers are gone.
void correct_states(Status& status) {
  status.workers.cells.clear();
  for (Rows* rows : {&status.campaign, &status.designs}) {
    const auto state = std::ranges::find(rows->columns, "state") - rows->columns.begin();
    for (auto& cells : rows->cells) {
      std::string& text = cells[static_cast<std::size_t>(state)].text;
      if (text != "running" && text != "racing" && text != "testing") continue;
      text = "interrupted";
    }
  }
}

/// Where searches are that are no iterated races; programs have `iteration` besides.
void add_stages(Status& status, const StoredStages& stages) {
  if (stages.empty()) return;
  Rows told = status.designs;
  stages.tell(told);
  const auto stage = std::ranges::find(told.columns, "stage") - told.columns.begin();
  status.designs.columns.emplace_back("stage");
  for (std::size_t i = 0; i < told.cells.size(); ++i)
    status.designs.cells[i].push_back(told.cells[i][static_cast<std::size_t>(stage)]);
}

/// Stores of schemas before 3 have none.
Expected<void> read_commands(StoreReader& store, Status& status) {
  const auto known = select(store, "SELECT 1 FROM sqlite_master WHERE name = 'v_commands'");
  if (!known || known->cells.empty()) return {};
  for (const auto& [sql, rows] :
       {std::pair{kPaused, &status.paused}, {kOpenCommands, &status.commands}}) {
    auto found = select(store, sql);
    if (!found) return Unexpected(found.error());
    letter_ids(*found);
    *rows = std::move(*found);
  }
  return {};
}

/// All parts of one answer; a campaign that runs may move on between them.
Expected<Status> read_status(StoreReader& store) {
  Status status;
  const std::pair<const char*, Rows*> parts[] = {{kCampaign, &status.campaign},
                                                 {kDesigns, &status.designs},
                                                 {kWorkers, &status.workers},
                                                 {kFailures, &status.failures}};
  for (const auto& [sql, rows] : parts) {
    auto found = select(store, sql);
    if (!found) return Unexpected(found.error());
    letter_ids(*found);
    *rows = std::move(*found);
  }
  if (auto asked = read_commands(store, status); !asked) return Unexpected(asked.error());
  auto quarantine = stored_quarantine(store);
  if (!quarantine) return Unexpected(quarantine.error());
  status.quarantine = std::move(*quarantine);
  if (status.campaign.cells.empty()) return unexpected(ErrorKind::Corrupt, "the store is empty");
  return status;
}

/// A line a campaign, then the designs, then who works.
void write_text(Output& output, const Status& status) {
  const std::size_t campaigns = status.campaign.cells.size();
  const std::string failures = status.failures.cells.front().front().text;
  for (std::size_t i = 0; i < campaigns; ++i) {
    const auto cell = [&](const char* column) {
      return as_shown(status.of_campaign(i, column), Layout::Escaped);
    };
    output.out << "campaign " << cell("name") << "  " << cell("state") << "  designs "
               << cell("designs_finished") << "/" << cell("designs") << "  experiments "
               << cell("used") << "/" << cell("budget") << "  candidates " << cell("candidates");
    if (campaigns == 1) output.out << "  failed " << failures;
    output.out << "\n";
  }
  if (campaigns > 1) output.out << "failed " << failures << "\n";
  if (status.of_campaign(0, "state") == "interrupted")
    output.out << "no coordinator runs it now; the command that started it continues from here\n";
  output.out << "\n" << rows_as_text(status.designs);
  for (std::size_t i = 0; i < status.paused.cells.size(); ++i)
    output.out << (i == 0 ? "\npaused: " : ", ") << status.paused.cells[i].front().text;
  if (!status.paused.cells.empty()) output.out << "\n";
  if (!status.commands.cells.empty()) output.out << "\n" << rows_as_text(status.commands);
  const std::vector<std::string> quarantine = quarantine_lines(status.quarantine, status.store);
  if (!quarantine.empty()) output.out << "\n";
  for (const std::string& line : quarantine)
    output.out << as_shown(line, Layout::Escaped) << "\n";
  if (status.workers.cells.empty()) return;
  output.out << "\n" << rows_as_text(status.workers);
}

void write_json(Output& output, const Status& status) {
  JsonObject object;
  object.add("campaign", row_as_json(status.campaign, 0));
  if (status.campaign.cells.size() > 1) object.add("campaigns", rows_as_json(status.campaign));
  output.out << object.add("designs", rows_as_json(status.designs))
                    .add("workers", rows_as_json(status.workers))
                    .add("quarantine", JsonPiece{quarantine_json(status.quarantine)})
                    .add("paused", rows_as_json(status.paused))
                    .add("commands", rows_as_json(status.commands))
                    .add("failures", JsonPiece{status.failures.cells.front().front().text})
                    .text()
             << "\n";
}

/// Where a coordinator is asked: at the address or by the file that a person names, else by the
/// file beside the store. NotFound when nothing says that one runs.
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
    // The last line stays free: a line end there would scroll.
    return {size.ws_col, size.ws_row > 1 ? size.ws_row - 1U : 23U};
  }
  constexpr auto kAll = std::numeric_limits<std::size_t>::max();
  return {kAll, kAll};
}

/// A screenful in place of the one before, without a blank one between.
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

/// The coordinator's own word, as it came where JSON is wanted.
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
  auto status = read_status(**store);
  if (!status) return fail(output, ExitCode::Store, status.error());
  status->store = *arguments.store.path();
  if (!has_writer(*arguments.store.path())) correct_states(*status);
  if (arguments.watch && output.out_is_terminal) output.out << Verbatim{"\x1b[H\x1b[2J"};
  const auto stages = StoredStages::read(**store);
  if (!stages) return fail(output, ExitCode::Store, stages.error());
  if (output.json)
    add_stages(*status, *stages);
  else
    stages->tell(status->designs);
  if (!output.json && is_of_programs(**store)) as_costs(status->designs);
  output.json ? write_json(output, *status) : write_text(output, *status);
  running = status->campaign.cells.size() == 1 && status->of_campaign(0, "state") == "running";
  return ExitCode::Done;
}

/// Once, or again and again until there is nothing more to see.
ExitCode run_status(const StatusArguments& arguments, Output& output) {
  // A person looks at a terminal, a file fills up.
  const auto pause = std::chrono::seconds(output.out_is_terminal ? 1 : 5);
  const bool has_store = arguments.store.path().has_value();
  bool was_live = false;
  while (true) {
    bool running = true;
    const auto live = show_live(arguments, output);
    if (!live && !has_store) {
      // A coordinator that was there and is gone has come to its end.
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

Run declare_status(Options& options) {
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
