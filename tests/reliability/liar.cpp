// A worker that lies, over real sockets and with a real key.
//
//   liar ADDRESS HONEST EVERY [KEY_FILE]
//
// Its first HONEST scores are right; of those after them each EVERY-th is higher than it should be,
// so that it turns races. Prints why it ended.

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "proto/access/key_file.h"
#include "sim/engine/self_test.h"
#include "sim/engine/simulate.h"
#include "worker/evaluate.h"
#include "worker/service.h"
#include "worker/slots.h"

namespace swarmsmith {
namespace {

EvaluatorFactory lying_evaluators(int honest, int every) {
  return [real = make_evaluators(), honest,
          every](const std::string& scenario) -> Expected<Evaluator> {
    Expected<Evaluator> made = real(scenario);
    if (!made) return made;
    return [evaluate = std::move(*made), honest, every, count = 0](const LeasedTask& item) mutable {
      Result result = evaluate(item);
      if (++count <= honest || (count - honest) % every != 0) return result;
      result.measured.score += 1;
      result.measured.state_digest ^= 1;
      return result;
    };
  };
}

int run(const std::string& address, int honest, int every, const char* key_file) {
  WorkerServiceOptions options{.endpoint = "tcp://" + address, .protocol = {}, .socket = {}};
  if (key_file != nullptr) {
    const auto key = read_client_key(key_file);
    if (!key) {
      std::fprintf(stderr, "liar: %s\n", to_string(key.error()).c_str());
      return 2;
    }
    options.keys = key->keys();
  }
  WorkerIdentity identity = identity_of_this_process(1, "liar");
  identity.engine_version = kEngineVersion;
  identity.self_test = self_test_digest();
  Wakeup wakeup;
  Pool pool(1, lying_evaluators(honest, every), [&wakeup] { wakeup.notify(); });
  const std::atomic<bool> drain = false;
  const WorkerEnd end = serve(options, identity, pool, wakeup, drain);
  std::fprintf(stderr, "liar: %s\n", end.reason.c_str());
  return static_cast<int>(end.code);
}

}  // namespace
}  // namespace swarmsmith

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) return 2;
  return swarmsmith::run(argv[1], std::atoi(argv[2]), std::atoi(argv[3]),
                         argc == 5 ? argv[4] : nullptr);
}
