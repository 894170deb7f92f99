#include "cli/commands/evaluated_apart.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <exception>
#include <optional>
#include <type_traits>

namespace swarmsmith::cli {
namespace {

static_assert(std::is_trivially_copyable_v<Again>, "the child sends its bytes");

Again evaluate_here(const StoredRun& run, const EvaluateRun& evaluate) {
  try {
    const Measured result = evaluate(run);
    if (std::isfinite(result.score)) return {.end = Again::End::Scored, .result = result};
  } catch (const std::exception&) {
    // The reason why the run has no score is not used.
  }
  return {.end = Again::End::Failed, .result = {}};
}

/// Runs in the child process: reports the results until it has finished or dies. Its error stream
/// goes to /dev/null, because only expected crashes write to it.
[[noreturn]] void evaluate_and_tell(std::span<const StoredRun> runs, const EvaluateRun& evaluate,
                                    int to) {
  const struct rlimit none = {};
  setrlimit(RLIMIT_CORE, &none);
  if (const int null = open("/dev/null", O_WRONLY | O_CLOEXEC); null >= 0) dup2(null, 2);
  for (const StoredRun& run : runs) {
    const Again again = evaluate_here(run, evaluate);
    // It is shorter than PIPE_BUF, so it is written as a whole or not at all.
    if (::write(to, &again, sizeof again) != sizeof again) _exit(1);
  }
  _exit(0);
}

/// The next result of the child; empty if the child has finished or died.
std::optional<Again> hear(int from) {
  Again again;
  std::size_t got = 0;
  while (got < sizeof again) {
    const ssize_t size = ::read(from, reinterpret_cast<char*>(&again) + got, sizeof again - got);
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return std::nullopt;
    got += static_cast<std::size_t>(size);
  }
  return again;
}

/// Starts a child for `runs` and collects its results until it has finished or died.
Expected<std::vector<Again>> evaluate_in_child(std::span<const StoredRun> runs,
                                               const EvaluateRun& evaluate) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    return unexpected(ErrorKind::Unavailable, std::string("no pipe: ") + std::strerror(errno));
  }
  const pid_t child = fork();
  if (child == 0) evaluate_and_tell(runs, evaluate, ends[1]);
  const int reason = errno;
  close(ends[1]);
  std::vector<Again> heard;
  while (child > 0 && heard.size() < runs.size()) {
    const std::optional<Again> again = hear(ends[0]);
    if (!again) break;
    heard.push_back(*again);
  }
  close(ends[0]);
  if (child < 0) {
    return unexpected(ErrorKind::Unavailable,
                      std::string("no process to evaluate in: ") + std::strerror(reason));
  }
  while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  return heard;
}

}  // namespace

Expected<std::vector<Again>> evaluate_apart(std::span<const StoredRun> runs,
                                            const EvaluateRun& evaluate) {
  std::vector<Again> all;
  while (all.size() < runs.size()) {
    const auto heard = evaluate_in_child(runs.subspan(all.size()), evaluate);
    if (!heard) return Unexpected(heard.error());
    all.insert(all.end(), heard->begin(), heard->end());
    if (all.size() < runs.size()) all.push_back({.end = Again::End::Killed, .result = {}});
  }
  return all;
}

}  // namespace swarmsmith::cli
