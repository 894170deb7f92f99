#include <sys/ioctl.h>
#include <unistd.h>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <memory>
#include <thread>

#include "coordinator/cli/commands.h"
#include "coordinator/cli/live_client.h"
#include "coordinator/cli/query_output.h"
#include "coordinator/cli/status_text.h"
#include "coordinator/cli/store_argument.h"

namespace swarmsmith::cli {
namespace {

struct Arguments {
  StoreArgument store;
  std::string connect;
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

struct Status {
  Rows campaign;
  Rows designs;
  Rows workers;
  Rows failures;

  std::string of_campaign(const std::string& column) const {
    for (std::size_t i = 0; i < campaign.columns.size(); ++i) {
      if (campaign.columns[i] == column) return campaign.cells.front()[i].text;
    }
    return "";
  }
};

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
  if (status.workers.cells.empty()) return;
  output.out << "\n" << rows_as_text(status.workers);
}

void write_json(Output& output, const Status& status) {
  output.out << "{\"campaign\":" << row_as_json(status.campaign, 0)
             << ",\"designs\":" << rows_as_json(status.designs)
             << ",\"workers\":" << rows_as_json(status.workers)
             << ",\"failures\":" << status.failures.cells.front().front().text << "}\n";
}

/// Where a coordinator runs, tcp://HOST:PORT; empty when nobody says so.
std::string endpoint_of(const Arguments& arguments) {
  std::string address = arguments.connect;
  const char* variable = std::getenv("SWARMSMITH_COORDINATOR");
  if (address.empty() && variable != nullptr) address = variable;
  if (address.empty() || address.find("://") != std::string::npos) return address;
  return "tcp://" + address;
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
  output.out << "\x1b[H";
  for (const std::string& line : lines)
    output.out << line << "\x1b[K\n";
  output.out << "\x1b[J";
}

void write_live(const Arguments& arguments, Output& output, const LiveStatus& status) {
  if (!arguments.watch) {
    for (const std::string& line : status_lines(status, screen_of(output)))
      output.out << line << "\n";
  } else if (output.out_is_terminal) {
    redraw(output, status_lines(status, screen_of(output)));
  } else {
    output.out << status_summary(status) << "\n";
  }
}

/// The coordinator's own word, as it came where JSON is wanted.
Expected<void> show_live(const Arguments& arguments, const std::string& endpoint, Output& output) {
  constexpr auto kPatience = std::chrono::seconds(3);
  const auto json = ask_status(endpoint, kPatience);
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

ExitCode show_stored(const Arguments& arguments, Output& output, bool& running) {
  const auto store = arguments.store.open();
  if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
  const auto status = read_status(**store);
  if (!status) return fail(output, ExitCode::Store, status.error());
  if (arguments.watch && output.out_is_terminal) output.out << "\x1b[H\x1b[2J";
  output.json ? write_json(output, *status) : write_text(output, *status);
  running = status->of_campaign("state") == "running";
  return ExitCode::Done;
}

/// Once, or again and again until there is nothing more to see.
ExitCode run(const Arguments& arguments, Output& output) {
  // A person looks at a terminal, a file fills up.
  const auto pause = std::chrono::seconds(output.out_is_terminal ? 1 : 5);
  bool was_live = false;
  while (true) {
    bool running = true;
    const std::string endpoint = endpoint_of(arguments);
    const auto live = endpoint.empty() ? Expected<void>{} : show_live(arguments, endpoint, output);
    const bool is_live = !endpoint.empty() && live;
    // A coordinator that was there and is gone has come to its end; the store says to which.
    const bool has_store = arguments.store.path().has_value();
    if (!live && !has_store) {
      if (was_live) return ExitCode::Done;
      return fail(output, ExitCode::Unreachable, live.error());
    }
    if (!is_live) {
      if (!live && !was_live) print_note(output, to_string(live.error()) + "; from the store:");
      const ExitCode shown = show_stored(arguments, output, running);
      if (shown != ExitCode::Done) return shown;
    }
    was_live |= is_live;
    output.out.flush();
    if (!arguments.watch || !running) return ExitCode::Done;
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace

Run declare_status(Options& options) {
  auto arguments = std::make_shared<Arguments>();
  arguments->store.declare(options);
  options.text("--connect", arguments->connect,
               "Ask the coordinator at HOST:PORT (default SWARMSMITH_COORDINATOR)");
  options.flag("--watch", arguments->watch, "Again and again, until the campaign ends");
  return [arguments](Output& output) { return run(*arguments, output); };
}

}  // namespace swarmsmith::cli
