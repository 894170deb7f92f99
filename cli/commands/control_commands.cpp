// pause, resume, cancel, extend and forgive: users' commands to a campaign, running or not.

#include <sys/types.h>
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <thread>

#include "base/environment.h"
#include "base/text/json.h"
#include "cli/arguments/store_argument.h"
#include "cli/arguments/thing_id.h"
#include "cli/commands/commands.h"
#include "cli/run/command_at_rest.h"
#include "cli/run/coordinator_link.h"
#include "coordinator/campaign/campaign.h"
#include "coordinator/service/live_status.h"
#include "proto/access/address.h"
#include "proto/access/coordinator_file.h"

namespace swarmsmith::cli {
namespace {

/// A coordinator that is starting writes its file only after it has read its stores.
constexpr std::chrono::milliseconds kLookAgain{100};
constexpr int kLooks = 100;

struct Arguments {
  CommandKind kind = CommandKind::Unknown;
  std::vector<std::string> words;
  std::string store;
  CoordinatorArgument coordinator;
  std::optional<std::int64_t> budget;
};

/// The arguments, sorted by kind.
struct Wish {
  std::string store;  ///< empty: only the coordinator is named
  std::vector<DesignId> designs;
  std::vector<std::string> whom{};  ///< keys and hosts for `forgive`
};

std::optional<DesignId> design_in(const std::string& word) {
  const auto id = parse_thing_id(word);
  if (!id || id->letter != 'd') return std::nullopt;
  return DesignId{std::stoll(id->digits)};
}

/// Reads STORE KEY..., or KEY... if the store or the coordinator is named in another way.
void sort_names(const Arguments& arguments, Wish& wish) {
  std::error_code none;
  const bool is_named = !wish.store.empty() || arguments.coordinator.is_named() ||
                        !store_of_environment().empty() ||
                        !environment("SWARMSMITH_COORDINATOR").empty();
  for (const std::string& word : arguments.words) {
    const bool is_store = wish.store.empty() && wish.whom.empty() &&
                          (!is_named || std::filesystem::is_regular_file(word, none));
    if (is_store) {
      wish.store = word;
    } else {
      wish.whom.push_back(word);
    }
  }
}

Expected<Wish> wish_of(const Arguments& arguments) {
  Wish wish{.store = arguments.store, .designs = {}};
  const bool of_workers = arguments.kind == CommandKind::Forgive;
  if (of_workers) sort_names(arguments, wish);
  for (const std::string& word : of_workers ? std::vector<std::string>{} : arguments.words) {
    if (const auto design = design_in(word)) {
      wish.designs.push_back(*design);
    } else if (wish.store.empty()) {
      wish.store = word;
    } else {
      return bad_input("unexpected word `" + word +
                       "`: a store is named already, and a design is written d3");
    }
  }
  if (wish.store.empty()) wish.store = store_of_environment();
  const bool named =
      arguments.coordinator.is_named() || !environment("SWARMSMITH_COORDINATOR").empty();
  if (!wish.store.empty() || named) return wish;
  return bad_input("no campaign given: name its store, or its coordinator with --coordinator FILE");
}

Expected<void> check(const Arguments& arguments, const Wish& wish) {
  if (is_of_race(arguments.kind) && wish.designs.empty()) {
    return bad_input("no design given: name at least one, such as d1");
  }
  if (arguments.kind == CommandKind::Forgive && wish.whom.empty()) {
    return bad_input(
        "no key or host given: name a key, an address or a host that is in quarantine, as "
        "`swarmsmith status` lists them");
  }
  if (arguments.kind == CommandKind::Extend && !arguments.budget) {
    return bad_input("no budget given: name the number of further experiments with --budget N");
  }
  return {};
}

/// Whether the file was left behind by a killed coordinator of this host.
bool is_stale(const CoordinatorFile& file) {
  return file.host == name_of_this_host() && kill(static_cast<pid_t>(file.pid), 0) != 0 &&
         errno == ESRCH;
}

/// Waits for the file of the running coordinator, and returns whether it is there.
bool stands(const std::filesystem::path& file) {
  for (int look = 0; look < kLooks; ++look) {
    const auto found = read_coordinator_file(file);
    if (found ? !is_stale(*found) : found.error().kind != ErrorKind::NotFound) return true;
    if (look + 1 < kLooks) std::this_thread::sleep_for(kLookAgain);
  }
  return false;
}

/// Sends a command to one campaign, for each design in turn.
class Control {
 public:
  Control(Output& output, const Arguments& arguments, Wish wish)
      : output_(output), arguments_(arguments), wish_(std::move(wish)) {}

  ExitCode run() {
    if (wish_.store.empty()) return by_wire(environment("SWARMSMITH_COORDINATOR"));
    const auto reader = StoreReader::open(wish_.store);
    if (!reader) return fail(output_, exit_code_of_store(reader.error()), reader.error());
    if (const auto all = (*reader)->campaigns(); all.size() > 1) {
      return fail(output_, ExitCode::Store,
                  Error{ErrorKind::Conflict,
                        "the store holds " + std::to_string(all.size()) +
                            " campaigns and is read-only (merged); name the campaign's own store",
                        wish_.store});
    }
    campaign_ = (*reader)->campaign();
    const std::vector<DesignRow> designs = (*reader)->designs();
    for (const DesignId design : wish_.designs) {
      if (std::ranges::find(designs, design, &DesignRow::id) != designs.end()) continue;
      const std::string there =
          designs.empty() ? "it has none" : "it has d1 to " + to_string(designs.back().id);
      return fail(output_, ExitCode::NoSuchId,
                  Error{ErrorKind::NotFound, "the campaign has no such design; " + there,
                        to_string(design)});
    }
    if (arguments_.coordinator.is_named()) return by_wire("");
    auto store = Store::open(wish_.store, campaign_, designs);
    if (store) return at_rest(**store);
    if (store.error().kind == ErrorKind::Conflict) return by_wire(file_of_runner(store.error()));
    return fail(output_, exit_code_of_store(store.error()), store.error());
  }

 private:
  /// The coordinator's file of a running campaign: the file beside the store, or the one named in
  /// the environment.
  std::string file_of_runner(const Error& in_use) {
    const std::filesystem::path beside = coordinator_file_of(real_store(wish_.store));
    const std::string named = environment("SWARMSMITH_COORDINATOR");
    std::error_code none;
    const bool elsewhere = !named.empty() && !std::filesystem::exists(beside, none);
    if (!elsewhere && stands(beside)) return beside.string();
    if (named.empty()) print_error(output_, in_use);
    return named.empty() ? beside.string() : named;
  }

  ExitCode by_wire(const std::string& file) {
    const CoordinatorSearch search = arguments_.coordinator.search(file);
    return each([&](const CommandRow& command) {
      return command_by_wire(search, campaign_.digest, command);
    });
  }

  ExitCode at_rest(Store& store) {
    return each([&](const CommandRow& command) {
      return command_at_rest(store, campaign_, wish_.store, command);
    });
  }

  /// Sends all commands, even if one of them fails. Returns the exit code of the first failure.
  template <class Ask>
  ExitCode each(const Ask& ask) {
    ExitCode code = ExitCode::Done;
    for (const CommandRow& command : commands()) {
      const Expected<std::string> done = ask(command);
      if (done) {
        write(command, *done);
        continue;
      }
      // A coordinator's answer is only a sentence, so this error is recognised by its text.
      if (done.error().message.find(kNotInQuarantine) != std::string::npos) {
        fail(output_, ExitCode::NoSuchId, done.error());
        if (code == ExitCode::Done) code = ExitCode::NoSuchId;
        continue;
      }
      const ErrorKind kind = done.error().kind;
      const bool away = kind == ErrorKind::Unavailable || kind == ErrorKind::NotFound;
      fail(output_, away ? ExitCode::Unreachable : ExitCode::Failed, done.error());
      if (code == ExitCode::Done) code = away ? ExitCode::Unreachable : ExitCode::Failed;
    }
    return code;
  }

  /// One command for each design, key or host named; one command for all if none is named.
  std::vector<CommandRow> commands() const {
    CommandRow command{.kind = arguments_.kind,
                       .step = std::nullopt,
                       .budget = arguments_.budget.value_or(0),
                       .who = user_and_host()};
    std::vector<CommandRow> all;
    for (const std::string& whom : wish_.whom) {
      command.whom = whom;
      all.push_back(command);
    }
    for (const DesignId design : wish_.designs) {
      command.design = design;
      all.push_back(command);
    }
    if (all.empty()) all.push_back(command);
    return all;
  }

  void write(const CommandRow& command, const std::string& sentence) {
    if (!output_.json) {
      output_.out << sentence << "\n";
      return;
    }
    JsonObject object;
    object.add("command", word_of(command.kind));
    if (command.kind == CommandKind::Forgive) {
      object.add("whom", command.whom);
    } else {
      object.add("design", command.design);
    }
    output_.out << object.add("done", sentence).text() << "\n";
  }

  Output& output_;
  const Arguments& arguments_;
  Wish wish_;
  CampaignRow campaign_;
};

CommandRun declare(CommandKind kind, Options& options) {
  auto arguments = std::make_shared<Arguments>();
  arguments->kind = kind;
  if (kind == CommandKind::Forgive) {
    options.words("STORE WHO|STORE", arguments->words,
                  "The campaign's store (else SWARMSMITH_STORE), and keys, addresses or hosts in "
                  "quarantine, as `status` lists them");
  } else {
    options.words("STORE DESIGN|STORE", arguments->words,
                  std::string("The campaign's store (else SWARMSMITH_STORE), and designs: d1 d2") +
                      (is_of_leases(kind) ? "; without any, all unfinished ones" : ""));
  }
  options.text("--store STORE", arguments->store, "The campaign's store");
  if (kind == CommandKind::Extend) {
    options.integer("--budget", arguments->budget, {1, kLargestBudget}, "Further experiments");
  }
  CoordinatorArgument& coordinator = arguments->coordinator;
  options.text("--coordinator FILE", coordinator.coordinator,
               "File of the coordinator that runs the campaign (default: STORE.coordinator, else "
               "SWARMSMITH_COORDINATOR)");
  options.text("--connect HOST:PORT", coordinator.connect,
               "Its address, HOST:PORT, in place of the file");
  options.text("--key FILE", coordinator.key,
               "Key file of an operator (default: SWARMSMITH_KEY, else operator.key in "
               "SWARMSMITH_KEYS or ~/.config/swarmsmith/keys)");
  options.flag("--insecure-plaintext", coordinator.insecure_plaintext,
               "Connect to a coordinator on another host without encryption");
  return [arguments](Output& output) {
    auto wish = wish_of(*arguments);
    if (!wish) return fail(output, ExitCode::Usage, wish.error());
    if (const auto checked = check(*arguments, *wish); !checked) {
      return fail(output, ExitCode::Usage, checked.error());
    }
    return Control(output, *arguments, std::move(*wish)).run();
  };
}

}  // namespace

CommandRun declare_pause(Options& options) {
  return declare(CommandKind::Pause, options);
}

CommandRun declare_resume(Options& options) {
  return declare(CommandKind::Resume, options);
}

CommandRun declare_cancel(Options& options) {
  return declare(CommandKind::Cancel, options);
}

CommandRun declare_extend(Options& options) {
  return declare(CommandKind::Extend, options);
}

CommandRun declare_forgive(Options& options) {
  return declare(CommandKind::Forgive, options);
}

}  // namespace swarmsmith::cli
