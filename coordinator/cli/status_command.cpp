#include <chrono>
#include <memory>
#include <thread>

#include "coordinator/cli/commands.h"
#include "coordinator/cli/query_output.h"
#include "coordinator/cli/store_argument.h"

namespace swarmsmith::cli {
namespace {

struct Arguments {
  StoreArgument store;
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
constexpr const char* kCommands =
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

  std::string of_campaign(const std::string& column) const {
    for (std::size_t i = 0; i < campaign.columns.size(); ++i) {
      if (campaign.columns[i] == column) return campaign.cells.front()[i].text;
    }
    return "";
  }
};

/// Stores of schemas before 3 have none.
Expected<void> read_commands(StoreReader& store, Status& status) {
  const auto known = select(store, "SELECT 1 FROM sqlite_master WHERE name = 'v_commands'");
  if (!known || known->cells.empty()) return {};
  for (const auto& [sql, rows] :
       {std::pair{kPaused, &status.paused}, {kCommands, &status.commands}}) {
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
  if (status.campaign.cells.empty()) return unexpected(ErrorKind::Corrupt, "the store is empty");
  return status;
}

/// One line of the campaign, then its designs, then who works.
void write_text(Output& output, const Status& status) {
  output.out << "campaign " << status.of_campaign("name") << "  " << status.of_campaign("state")
             << "  designs " << status.of_campaign("designs_finished") << "/"
             << status.of_campaign("designs") << "  experiments " << status.of_campaign("used")
             << "/" << status.of_campaign("budget") << "  candidates "
             << status.of_campaign("candidates") << "  failed "
             << status.failures.cells.front().front().text << "\n\n"
             << rows_as_text(status.designs);
  for (std::size_t i = 0; i < status.paused.cells.size(); ++i)
    output.out << (i == 0 ? "\npaused: " : ", ") << status.paused.cells[i].front().text;
  if (!status.paused.cells.empty()) output.out << "\n";
  if (!status.commands.cells.empty()) output.out << "\n" << rows_as_text(status.commands);
  if (status.workers.cells.empty()) return;
  output.out << "\n" << rows_as_text(status.workers);
}

void write_json(Output& output, const Status& status) {
  output.out << "{\"campaign\":" << row_as_json(status.campaign, 0)
             << ",\"designs\":" << rows_as_json(status.designs)
             << ",\"workers\":" << rows_as_json(status.workers)
             << ",\"paused\":" << rows_as_json(status.paused)
             << ",\"commands\":" << rows_as_json(status.commands)
             << ",\"failures\":" << status.failures.cells.front().front().text << "}\n";
}

/// Once, or every two seconds until nothing changes any more.
ExitCode run(const Arguments& arguments, Output& output) {
  constexpr auto kPause = std::chrono::seconds(2);
  while (true) {
    const auto store = arguments.store.open();
    if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
    const auto status = read_status(**store);
    if (!status) return fail(output, ExitCode::Store, status.error());
    if (arguments.watch && output.out_is_terminal) output.out << "\x1b[H\x1b[2J";
    output.json ? write_json(output, *status) : write_text(output, *status);
    output.out.flush();
    if (!arguments.watch || status->of_campaign("state") != "running") return ExitCode::Done;
    std::this_thread::sleep_for(kPause);
  }
}

}  // namespace

Run declare_status(Options& options) {
  auto arguments = std::make_shared<Arguments>();
  arguments->store.declare(options);
  options.flag("--watch", arguments->watch, "Write it again every 2 s until the campaign ends");
  return [arguments](Output& output) { return run(*arguments, output); };
}

}  // namespace swarmsmith::cli
