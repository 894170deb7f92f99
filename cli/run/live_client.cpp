#include "cli/run/live_client.h"

#include "proto/socket.h"
#include "proto/wakeup.h"
#include "proto/wire.h"

namespace swarmsmith::cli {

Expected<std::string> ask_status(const FoundCoordinator& coordinator,
                                 std::chrono::milliseconds patience) {
  using Clock = std::chrono::steady_clock;
  using std::chrono::milliseconds;
  const auto unreachable = [&](const std::string& how) {
    return unexpected(ErrorKind::Unavailable, how, coordinator.endpoint);
  };
  ClientSocket socket(coordinator.endpoint, {}, coordinator.keys);
  socket.connect();
  pb::ToCoordinator question;
  question.mutable_want_status();
  socket.send(encode(question));
  google::protobuf::Arena arena;
  const Wakeup nobody;
  std::string frame;
  const auto until = Clock::now() + patience;
  while (true) {
    while (socket.receive(frame)) {
      const auto answer = decode_to_worker(frame, arena);
      if (!answer) return Unexpected(answer.error());
      if ((*answer)->has_status_reply()) return std::string((*answer)->status_reply().json());
      if ((*answer)->has_reject())
        return bad_input((*answer)->reject().sentence(), coordinator.endpoint);
    }
    if (socket.refused()) return unreachable("the coordinator does not know this key");
    if (socket.lost()) return unreachable("no coordinator runs there");
    const auto left = std::chrono::ceil<milliseconds>(until - Clock::now());
    if (left.count() <= 0) return unreachable("the coordinator does not answer");
    socket.wait(nobody, left);
  }
}

}  // namespace swarmsmith::cli
