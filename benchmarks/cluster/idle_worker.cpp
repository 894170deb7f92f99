#include "benchmarks/cluster/idle_worker.h"

#include <sys/prctl.h>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <thread>

#include "base/hash.h"
#include "benchmarks/cluster/crowd.h"
#include "benchmarks/cluster/process_stats.h"
#include "worker/pool.h"
#include "worker/service.h"
#include "worker/slots.h"

namespace swarmsmith::bench {
namespace {

constexpr const char* kEndpoint = "SWARMSMITH_BENCHMARK_ENDPOINT";
constexpr const char* kWorkers = "SWARMSMITH_BENCHMARK_WORKERS";
constexpr const char* kSlots = "SWARMSMITH_BENCHMARK_SLOTS";
constexpr const char* kSecretKey = "SWARMSMITH_BENCHMARK_SECRET_KEY";
constexpr const char* kServerKey = "SWARMSMITH_BENCHMARK_SERVER_KEY";

double part_of(std::uint64_t bits) {
  return static_cast<double>(bits >> 11U) * 0x1p-53;
}

void spend(const Work& work, std::int64_t seed) {
  if (work.us <= 0) return;
  const auto until = std::chrono::steady_clock::now() + time_of(work, seed);
  if (work.kind == Work::Kind::Sleep) return std::this_thread::sleep_until(until);
  while (std::chrono::steady_clock::now() < until) {
  }
}

Expected<Evaluator> make_evaluator(const std::string& scenario) {
  const Expected<Work> work = work_of(scenario);
  if (!work) return Unexpected(work.error());
  return Evaluator([work = *work](const LeasedTask& item) -> Result {
    // Makes sleeps end on time, not when the kernel finds it convenient to end several together.
    // The setting is for this thread, and costs a tenth of a microsecond.
    if (work.kind == Work::Kind::Sleep) prctl(PR_SET_TIMERSLACK, 1000UL);
    spend(work, item.seed);
    return Result{.measured = {.score = synthetic_score(item.machine, item.seed),
                               .state_digest = mix64(static_cast<std::uint64_t>(item.seed))}};
  });
}

std::optional<ClientKeys> announced_keys() {
  const char* secret = std::getenv(kSecretKey);
  const char* server = std::getenv(kServerKey);
  if (secret == nullptr || server == nullptr) return std::nullopt;
  return ClientKeys{.secret_key = secret, .server_key = server};
}

void run_one(const std::string& endpoint, int slots) {
  Wakeup wakeup;
  Pool pool(slots, make_evaluator, [&wakeup] { wakeup.notify(); });
  const std::atomic<bool> drain{false};
  const WorkerEnd end =
      serve({.endpoint = endpoint, .keys = announced_keys(), .protocol = {}, .socket = {}},
            identity_of_this_process(slots, "benchmark"), pool, wakeup, drain);
  if (end.code != WorkerExit::Done) std::fprintf(stderr, "worker: %s\n", end.reason.c_str());
}

}  // namespace

std::string to_text(const Work& work) {
  std::ostringstream text;
  text << (work.kind == Work::Kind::Sleep ? "sleep " : "spin ") << work.us << ' ' << work.spread;
  return text.str();
}

Expected<Work> work_of(const std::string& text) {
  Work work;
  std::string kind;
  std::istringstream words(text);
  if (!(words >> kind >> work.us >> work.spread)) return bad_input("no work of a benchmark", text);
  work.kind = kind == "sleep" ? Work::Kind::Sleep : Work::Kind::Spin;
  return work;
}

Duration time_of(const Work& work, std::int64_t seed) {
  const double part = part_of(mix64(static_cast<std::uint64_t>(seed) ^ 0x74696d65U));
  const double us = static_cast<double>(work.us) * (1 + work.spread * (2 * part - 1));
  return Duration(static_cast<std::int64_t>(1e3 * us));
}

void announce(const std::string& endpoint, const WorkerShape& shape,
              const std::optional<ClientKeys>& keys) {
  setenv(kEndpoint, endpoint.c_str(), 1);
  setenv(kWorkers, std::to_string(shape.workers).c_str(), 1);
  setenv(kSlots, std::to_string(shape.slots).c_str(), 1);
  unsetenv(kSecretKey);
  unsetenv(kServerKey);
  if (!keys) return;
  setenv(kSecretKey, keys->secret_key.c_str(), 1);
  setenv(kServerKey, keys->server_key.c_str(), 1);
}

bool is_worker() {
  return std::getenv(kEndpoint) != nullptr;
}

void be_worker() {
  raise_descriptor_limit();
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const std::string endpoint = std::getenv(kEndpoint);
  const WorkerShape shape{.workers = std::atoi(std::getenv(kWorkers)),
                          .slots = std::atoi(std::getenv(kSlots))};
  if (shape.workers == 1) {
    run_one(endpoint, shape.slots);
  } else {
    run_crowd(endpoint, shape, announced_keys());
  }
  std::_Exit(0);
}

double synthetic_score(const std::string& machine, std::int64_t seed) {
  Digest text;
  text.add(machine);
  const std::uint64_t bits = text.value64();
  return part_of(mix64(bits)) + part_of(mix64(bits ^ mix64(static_cast<std::uint64_t>(seed))));
}

}  // namespace swarmsmith::bench
