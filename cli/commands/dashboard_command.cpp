#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "base/output_file.h"
#include "base/text/json.h"
#include "base/text/whole_file.h"
#include "cli/arguments/program_name.h"
#include "cli/arguments/store_argument.h"
#include "cli/commands/commands.h"
#include "cli/dashboard/snapshot.h"
#include "cli/run/campaign_flags.h"
#include "cli/run/dashboard_setup.h"
#include "cli/run/run_signals.h"
#include "console/counter.h"
#include "coordinator/service/http_address.h"
#include "coordinator/service/http_server.h"
#include "proto/access/coordinator_file.h"
#include "proto/access/find_coordinator.h"
#include "storage/whole.h"

namespace swarmsmith::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct DashboardArguments {
  std::vector<std::string> stores;
  std::string http;
  std::string token_file;
  std::vector<std::string> names;
  CoordinatorArgument coordinator;
  std::string file;
  std::vector<std::string> designs;
};

/// Asks the coordinator of a running campaign for its status, at most once a second, and only while
/// a page is asking.
class LiveNumbers {
 public:
  LiveNumbers(CoordinatorArgument coordinator, std::string file)
      : coordinator_(std::move(coordinator)), file_(std::move(file)) {}

  void refresh(HttpSite& site) {
    const std::scoped_lock lock(mutex_);
    if (Clock::now() < next_) return;
    CoordinatorSearch search = coordinator_.search(file_);
    search.role = "reader";
    const auto found = find_coordinator(search);
    const auto json = found ? ask_status(*found, kPatience) : Unexpected(found.error());
    const auto status = json ? live_status_of(*json) : Unexpected(json.error());
    if (status) site.publish(*status);
    next_ = Clock::now() + (status ? kPause : kLongPause);
  }

 private:
  static constexpr std::chrono::milliseconds kPatience{1000};
  static constexpr std::chrono::milliseconds kPause{900};
  static constexpr std::chrono::milliseconds kLongPause{3000};

  CoordinatorArgument coordinator_;
  std::string file_;
  std::mutex mutex_;
  Clock::time_point next_{};
};

/// Errors: a store, or its name, is wrong.
Expected<std::vector<DashboardStore>> stores_of(const DashboardArguments& arguments) {
  std::vector<std::string> names = arguments.stores;
  if (names.empty() && !store_of_environment().empty()) names.push_back(store_of_environment());
  if (names.empty())
    return bad_input("no store given: name its file, or set SWARMSMITH_STORE", "STORE");
  std::vector<DashboardStore> stores;
  for (const std::string& name : names) {
    const auto reader = StoreReader::open(name);
    if (!reader) return Unexpected(reader.error());
    // Stores before schema 4 have no such view; the error says how to make a copy.
    auto seen = (*reader)->query(
        "SELECT 1 FROM v_campaigns", {}, [](const auto&) {}, [](const auto&) {});
    if (!seen) {
      seen.error().where = name;
      return Unexpected(seen.error());
    }
    stores.push_back({std::filesystem::absolute(name), std::nullopt});
  }
  // Only the coordinator of the first store is asked, so the other stores have no index in its
  // status.
  stores.front().place = 0;
  return stores;
}

/// Writes one file instead of starting a server.
ExitCode write_snapshot(const DashboardArguments& arguments, Output& output) {
  const auto stores = stores_of(arguments);
  if (!stores) {
    const bool usage = stores.error().where == "STORE";
    return fail(output, usage ? ExitCode::Usage : exit_code_of_store(stores.error()),
                stores.error());
  }
  if (stores->size() > 1) {
    return fail(
        output, ExitCode::Usage,
        Error{ErrorKind::BadInput, "takes one store; `merge` makes one of several", "--export"});
  }
  // Refuses an unsuitable name now, before minutes of work.
  const std::filesystem::path file(arguments.file);
  if (const auto place = output_place(file, FileKind::WebPage); !place)
    return fail(output, ExitCode::Failed, place.error());
  if (std::filesystem::is_directory(file) ||
      (file.has_parent_path() && !std::filesystem::exists(file.parent_path())))
    return fail(output, ExitCode::Failed, cannot_write(arguments.file, 0));
  if (const auto whole = check_rows(stores->front().file); !whole)
    return fail(output, ExitCode::Store, whole.error());
  SnapshotOptions options{.version = program_name()};
  for (const std::string& text : arguments.designs) {
    const auto design = id_from_text<DesignTag>(text);
    if (!design) {
      return fail(
          output, ExitCode::Usage,
          Error{ErrorKind::BadInput, "must be an id such as d3, not \"" + text + "\"", "--design"});
    }
    options.designs.push_back(*design);
  }
  Counter counter(output, "made", "answers");
  options.progress = [&](std::int64_t made, std::int64_t of) { counter.tell(made, of); };
  const auto page = snapshot_page(stores->front().file, options);
  if (!page) {
    const ErrorKind kind = page.error().kind;
    const ExitCode code = kind == ErrorKind::NotFound   ? ExitCode::NoSuchId
                          : kind == ErrorKind::Conflict ? ExitCode::Failed
                                                        : ExitCode::Store;
    return fail(output, code, page.error());
  }
  if (const auto written = write_whole_file(arguments.file, *page); !written)
    return fail(output, ExitCode::Failed, written.error());
  if (output.json) {
    output.out << JsonObject().add("file", arguments.file).add("bytes", page->size()).text()
               << "\n";
  } else {
    output.out << arguments.file << "\n";
  }
  return ExitCode::Done;
}

ExitCode show(const DashboardArguments& arguments, Output& output) {
  auto stores = stores_of(arguments);
  if (!stores) {
    const bool usage = stores.error().where == "STORE";
    return fail(output, usage ? ExitCode::Usage : exit_code_of_store(stores.error()),
                stores.error());
  }
  const bool named = !arguments.http.empty();
  const auto address = parse_address(named ? arguments.http : "127.0.0.1:8347");
  if (!address) return fail(output, ExitCode::Usage, address.error());
  HttpOptions http{.address = *address, .next_port = !named, .token = {}};
  http.names = arguments.names;
  http.has_loop = false;
  if (!arguments.token_file.empty()) {
    auto token = read_token(arguments.token_file);
    if (!token) return fail(output, ExitCode::Usage, token.error());
    http.token = *token;
  }
  LiveNumbers numbers(arguments.coordinator,
                      coordinator_file_of(real_store(stores->front().file)).string());
  std::weak_ptr<HttpSite> site;
  const auto refresh = [&] {
    if (const auto shown = site.lock()) numbers.refresh(*shown);
  };
  const auto setup = DashboardSetup::make(
      {.stores = std::move(*stores), .version = program_name(), .before_live = refresh},
      arguments.coordinator,
      arguments.token_file.empty() ? DashboardSetup::Secret::Joined
                                   : DashboardSetup::Secret::OfOnesOwn);
  site = setup->site();
  http.site = setup->site();
  http.act_token = setup->token();
  catch_ending_signals();
  const auto server = HttpServer::start(std::move(http));
  if (!server) {
    const bool usage = server.error().kind == ErrorKind::BadInput;
    return fail(output, usage ? ExitCode::Usage : ExitCode::Unreachable, server.error());
  }
  setup->announce(output, (*server)->address());
  print_note(output, "Ctrl-C ends it");
  while (ending_signal() == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  return ExitCode::Done;
}

}  // namespace

CommandRun declare_dashboard(Options& options) {
  auto arguments = std::make_shared<DashboardArguments>();
  options.words("STORE", arguments->stores, "Stores to show (else SWARMSMITH_STORE)");
  options.text("--http HOST:PORT", arguments->http,
               "Address and port (default 127.0.0.1:8347, or the next port that is free)");
  options.text("--http-token-file FILE", arguments->token_file,
               "File of the secret that readers must show");
  options.texts("--http-name HOST", arguments->names,
                "Name of this host in addresses of the pages, such as a proxy's");
  CoordinatorArgument& coordinator = arguments->coordinator;
  options.text("--connect HOST:PORT|FILE", coordinator.connect,
               "Get the state of the first store's campaign from this coordinator (default: the "
               "one of STORE.coordinator)");
  options.text("--key FILE", coordinator.key, "Key file, if the coordinator needs one");
  options.flag("--insecure-plaintext", coordinator.insecure_plaintext,
               "Ask a coordinator on another host without encryption");
  options.text("--export FILE", arguments->file,
               "Write the pages with all that they show into this file, which opens without a "
               "server, instead of serving them");
  options.texts("--design DESIGN", arguments->designs,
                "With --export: this design; once for each (default: all)");
  return [arguments](Output& output) {
    if (!arguments->file.empty()) return write_snapshot(*arguments, output);
    if (arguments->designs.empty()) return show(*arguments, output);
    return fail(output, ExitCode::Usage,
                Error{ErrorKind::BadInput, "applies to --export", "--design"});
  };
}

}  // namespace swarmsmith::cli
