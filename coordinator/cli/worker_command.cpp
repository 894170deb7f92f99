#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <memory>

#include "coordinator/cli/commands.h"
#include "coordinator/launchers/worker_program.h"
#include "proto/socket.h"

namespace swarmsmith::cli {

Run declare_worker(Options& options) {
  struct Arguments {
    std::string connect;
    std::optional<std::int64_t> slots;
    std::vector<std::string> allow;
    bool allow_shell = false;
  };
  auto arguments = std::make_shared<Arguments>();
  options.text("--connect", arguments->connect, "Address and port of the coordinator",
               Options::Need::Required);
  options.integer("--slots", arguments->slots, {1, 1024},
                  "Evaluations at the same time (default: SLURM_CPUS_PER_TASK, else the CPUs that "
                  "this process may use)");
  options.texts("--allow", arguments->allow,
                "A program that campaigns may run here in place of the simulator; repeatable");
  options.flag("--allow-shell", arguments->allow_shell,
               "Give command lines that only a shell understands to /bin/sh: then campaigns may "
               "run anything");
  return [arguments](Output& output) {
    const auto program = find_worker_program();
    if (!program) return fail(output, ExitCode::Unreachable, program.error());
    const bool has_scheme = arguments->connect.find("://") != std::string::npos;
    const std::string endpoint = (has_scheme ? "" : "tcp://") + arguments->connect;
    if (!is_tcp_address(endpoint) || endpoint.ends_with("*")) {
      return fail(output, ExitCode::Usage,
                  {ErrorKind::BadInput,
                   "`" + arguments->connect +
                       "` is no address; it is written 127.0.0.1:5555, host and port, as `serve` "
                       "prints it",
                   "--connect"});
    }
    std::vector<std::string> words{program->string(), "--connect", endpoint};
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
