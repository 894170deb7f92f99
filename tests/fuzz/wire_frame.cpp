#include "proto/wire.h"
#include "proto/wire.pb.h"
#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {
namespace {

template <class Message>
void check(const Expected<const Message*>& message,
           Expected<const Message*> (*decode)(std::string_view, google::protobuf::Arena&)) {
  if (!message) {
    require(!message.error().message.empty(), "a refusal has a sentence");
    require(!message.error().where.empty(), "a refusal names the part");
    return;
  }
  google::protobuf::Arena arena;
  const std::string frame = encode(**message);
  const auto again = decode(frame, arena);
  require(again.has_value(), "what is encoded can be decoded");
  require(encode(**again) == frame, "a frame keeps its bytes");
}

void check_frame(std::string_view frame) {
  google::protobuf::Arena arena;
  check<pb::ToCoordinator>(decode_to_coordinator(frame, arena), decode_to_coordinator);
  check<pb::ToWorker>(decode_to_worker(frame, arena), decode_to_worker);
}

}  // namespace

/// What may arrive at either end of a connection, as it is, and behind a good header: a fuzzer then
/// does not have to find that.
void run(std::string_view input) {
  check_frame(input);
  const std::string header = encode(pb::ToWorker());
  require(header.size() == kFrameHeaderBytes, "an empty message is a header");
  check_frame(header + std::string(input));
}

}  // namespace swarmsmith::fuzz
