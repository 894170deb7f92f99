#include "worker/referee.h"

#include <cstdio>
#include <optional>
#include <string>

#include "proto/frame_pipe.h"
#include "proto/task_messages.h"
#include "proto/wire.pb.h"
#include "worker/pool.h"

namespace swarmsmith {
namespace {

pb::ToCoordinator hello_of(const WorkerIdentity& identity) {
  pb::ToCoordinator message;
  pb::Hello& hello = *message.mutable_hello();
  hello.set_worker_id(std::string(kWorkerIdBytes, '\0'));
  hello.set_slots(1);
  hello.set_engine_version(identity.engine_version);
  hello.set_self_test(identity.self_test);
  return message;
}

pb::ToCoordinator began_of(PackedKey key) {
  pb::ToCoordinator message;
  unpack(key, *message.mutable_began()->mutable_key());
  return message;
}

pb::ToCoordinator results_of(const Result& result) {
  pb::ToCoordinator message;
  write(result, *message.mutable_results()->add_results());
  return message;
}

}  // namespace

int serve_as_referee(const WorkerIdentity& identity, const EvaluatorFactory& make_evaluator,
                     int input, int output) {
  if (!write_frame(output, encode(hello_of(identity)))) return 1;
  std::optional<Evaluator> evaluator;
  std::string frame;
  google::protobuf::Arena arena;
  while (read_frame(input, kMaxFrameToWorkerBytes, frame)) {
    const Expected<const pb::ToWorker*> message = decode_to_worker(frame, arena);
    if (!message) return static_cast<int>(WorkerExit::Usage);
    if ((*message)->has_scenario()) {
      Expected<Evaluator> made = make_evaluator((*message)->scenario().scenario());
      if (!made) {
        std::fprintf(stderr, "%s\n", to_string(made.error()).c_str());
        return static_cast<int>(WorkerExit::Refused);
      }
      evaluator = std::move(*made);
    }
    for (const pb::Task& task : (*message)->tasks().tasks()) {
      if (!evaluator) return static_cast<int>(WorkerExit::Usage);
      const LeasedTask item = task_of(task);
      const bool told = write_frame(output, encode(began_of(item.key))) &&
                        write_frame(output, encode(results_of(evaluate(*evaluator, item))));
      if (!told) return 1;
    }
    arena.Reset();
  }
  return static_cast<int>(WorkerExit::Done);
}

}  // namespace swarmsmith
