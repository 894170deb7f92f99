// Many workers in one process: threads that sleep before each evaluation, over real sockets.
//
//   crowd ADDRESS WORKERS SLEEP_MS
//
// The evaluations are the real ones, so that the campaign's answer is. Ends when all workers were
// sent home; 1 when one of them ended otherwise.

#include <sys/resource.h>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "sim/engine/self_test.h"
#include "sim/engine/simulate.h"
#include "worker/evaluate.h"
#include "worker/service.h"
#include "worker/slots.h"

namespace swarmsmith {
namespace {

EvaluatorFactory sleeping_evaluators(std::chrono::milliseconds sleep) {
  return [real = make_evaluators(), sleep](const std::string& scenario) -> Expected<Evaluator> {
    Expected<Evaluator> made = real(scenario);
    if (!made) return made;
    return [evaluate = std::move(*made), sleep](const LeasedTask& item) {
      std::this_thread::sleep_for(sleep);
      return evaluate(item);
    };
  };
}

bool work(const std::string& address, const std::string& self_test,
          std::chrono::milliseconds sleep) {
  WorkerIdentity identity = identity_of_this_process(1, "crowd");
  identity.engine_version = kEngineVersion;
  identity.self_test = self_test;
  Wakeup wakeup;
  Pool pool(1, sleeping_evaluators(sleep), [&wakeup] { wakeup.notify(); });
  const std::atomic<bool> drain = false;
  const WorkerEnd end = serve({.endpoint = "tcp://" + address, .protocol = {}, .socket = {}},
                              identity, pool, wakeup, drain);
  if (end.code != WorkerExit::Done) std::fprintf(stderr, "crowd: %s\n", end.reason.c_str());
  return end.code == WorkerExit::Done;
}

/// A worker has about a dozen descriptors.
void raise_descriptor_limit() {
  struct rlimit limit = {};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_NOFILE, &limit);
}

int run(const std::string& address, int count, std::chrono::milliseconds sleep) {
  raise_descriptor_limit();
  const std::string self_test = self_test_digest();
  std::atomic<int> failed{0};
  {
    std::vector<std::jthread> workers;
    for (int i = 0; i < count; ++i) {
      workers.emplace_back([&] { failed += work(address, self_test, sleep) ? 0 : 1; });
    }
  }
  return failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace swarmsmith

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  return swarmsmith::run(argv[1], std::atoi(argv[2]),
                         std::chrono::milliseconds(std::atoi(argv[3])));
}
