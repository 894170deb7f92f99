#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <memory>

#include "cli/commands/commands.h"
#include "coordinator/launchers/worker_program.h"
#include "proto/access/address.h"

namespace swarmsmith::cli {
namespace {

/// The arguments that tell the worker program where the coordinator is.
Expected<std::vector<std::string>> where_words(const std::string& connect,
                                               const std::string& coordinator) {
  if (connect.empty() == coordinator.empty()) {
    return bad_input(
        "no coordinator given; name its address (--connect HOST:PORT) or its file (--coordinator "
        "FILE)");
  }
  if (!coordinator.empty()) return std::vector<std::string>{"--coordinator", coordinator};
  const auto endpoint = endpoint_of(connect, true);
  if (endpoint) return std::vector<std::string>{"--connect", *endpoint};
  return bad_input("`" + connect + "`: " + endpoint.error().message, "--connect");
}

}  // namespace

CommandRun declare_worker(Options& options) {
  struct Arguments {
    std::string connect;
    std::string coordinator;
    std::string key;
    bool insecure_plaintext = false;
    std::optional<std::int64_t> slots;
    std::vector<std::string> allow;
    bool allow_shell = false;
  };
  auto arguments = std::make_shared<Arguments>();
  options.text("--connect HOST:PORT", arguments->connect, "Address and port of the coordinator");
  options.text("--coordinator FILE", arguments->coordinator,
               "File that the coordinator writes (STORE.coordinator), in place of --connect; it "
               "also finds a coordinator that has moved");
  options.text("--key FILE", arguments->key,
               "Key file, if the coordinator needs one (default: SWARMSMITH_KEY, else worker.key "
               "in SWARMSMITH_KEYS or ~/.config/swarmsmith/keys)");
  options.flag("--insecure-plaintext", arguments->insecure_plaintext,
               "Connect to a coordinator on another host without encryption");
  options.integer("--slots", arguments->slots, {1, 1024},
                  "Parallel evaluations (default: SLURM_CPUS_PER_TASK, else the CPUs that this "
                  "process may use)");
  options.texts("--allow PROGRAM", arguments->allow,
                "Program that campaigns may run here in place of the simulator; repeatable");
  options.flag("--allow-shell", arguments->allow_shell,
               "Run command lines that need a shell with /bin/sh: campaigns may then run anything");
  return [arguments](Output& output) {
    const auto program = find_worker_program();
    if (!program) return fail(output, ExitCode::Unreachable, program.error());
    const auto where = where_words(arguments->connect, arguments->coordinator);
    if (!where) return fail(output, ExitCode::Usage, where.error());
    std::vector<std::string> words{program->string()};
    words.insert(words.end(), where->begin(), where->end());
    if (!arguments->key.empty()) {
      words.emplace_back("--key");
      words.push_back(arguments->key);
    }
    if (arguments->insecure_plaintext) words.emplace_back("--insecure-plaintext");
    if (arguments->slots) {
      words.emplace_back("--slots");
      words.push_back(std::to_string(*arguments->slots));
    }
    for (const std::string& allowed : arguments->allow) {
      words.emplace_back("--allow");
      words.push_back(allowed);
    }
    if (arguments->allow_shell) words.emplace_back("--allow-shell");
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words)
      pointers.push_back(word.data());
    pointers.push_back(nullptr);
    execv(pointers.front(), pointers.data());
    return fail(output, ExitCode::Unreachable,
                program->string() + " cannot be started: " + std::strerror(errno));
  };
}

}  // namespace swarmsmith::cli
