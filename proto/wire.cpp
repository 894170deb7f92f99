#include "proto/wire.h"
#include "proto/wire.pb.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/stubs/logging.h>
#include <google/protobuf/wire_format_lite.h>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "base/hash.h"
#include "programs/cost.h"
#include "proto/key.h"
#include "proto/task_messages.h"

namespace swarmsmith {
namespace {

void append_word(std::string& out, std::uint16_t word) {
  out += static_cast<char>(word & 0xffU);
  out += static_cast<char>(word >> 8U);
}

std::uint16_t word_at(std::string_view frame, std::size_t at) {
  return static_cast<std::uint16_t>(static_cast<unsigned char>(frame[at]) |
                                    static_cast<unsigned char>(frame[at + 1]) << 8U);
}

template <class Message>
std::string encode_message(const Message& message) {
  std::string out;
  out.reserve(kFrameHeaderBytes + message.ByteSizeLong());
  out += kFrameMagic;
  append_word(out, kProtocolMajor);
  append_word(out, kProtocolMinor);
  message.AppendToString(&out);
  return out;
}

Expected<std::string_view> payload_of(std::string_view frame, std::size_t most) {
  if (frame.size() < kFrameHeaderBytes || frame.size() > most) {
    return bad_input("a frame of " + std::to_string(frame.size()) + " bytes; expected 8 to " +
                         std::to_string(most),
                     "length");
  }
  if (frame.substr(0, kFrameMagic.size()) != kFrameMagic) {
    return bad_input("a frame that does not begin with " + std::string(kFrameMagic), "magic");
  }
  const std::uint16_t major = word_at(frame, 4);
  if (major != kProtocolMajor) {
    return unexpected(ErrorKind::Conflict,
                      "the peer speaks version " + std::to_string(major) +
                          " of the protocol, this program version " +
                          std::to_string(kProtocolMajor) +
                          ": install the same release on both sides",
                      "major version");
  }
  return frame.substr(kFrameHeaderBytes);
}

/// Whether a message's body has more parts than the limits allow. They are counted before parsing,
/// since parsing makes an object of some hundred bytes from each part of two bytes.
bool has_too_many_parts(std::string_view payload) {
  using google::protobuf::internal::WireFormatLite;
  // The items of a message, and its other fields, which are far fewer than 64.
  constexpr int kMost = kMaxItemsPerMessage + 64;
  google::protobuf::io::CodedInputStream stream(
      reinterpret_cast<const std::uint8_t*>(payload.data()), static_cast<int>(payload.size()));
  int parts = 0;
  while (const std::uint32_t tag = stream.ReadTag()) {
    if (++parts > kMost) return true;
    std::uint32_t size = 0;
    if (WireFormatLite::GetTagWireType(tag) != WireFormatLite::WIRETYPE_LENGTH_DELIMITED) {
      if (!WireFormatLite::SkipField(&stream, tag)) return false;
      continue;
    }
    // Parsing refuses such a message, so it needs no count.
    if (!stream.ReadVarint32(&size) || size > payload.size()) return false;
    const int end = stream.CurrentPosition() + static_cast<int>(size);
    const auto limit = stream.PushLimit(static_cast<int>(size));
    while (const std::uint32_t inner = stream.ReadTag()) {
      if (++parts > kMost) return true;
      if (!WireFormatLite::SkipField(&stream, inner)) break;
    }
    stream.PopLimit(limit);
    // A text field of a later version is not a body, so the parts after it count.
    if (!stream.Skip(end - stream.CurrentPosition())) return false;
  }
  return false;
}

template <class Message>
Expected<const Message*> parse(std::string_view frame, std::size_t most,
                               google::protobuf::Arena& arena) {
  // Errors in a frame are returned as values; the library would write them to standard error.
  [[maybe_unused]] static auto* const kLoud = google::protobuf::SetLogHandler(nullptr);
  const Expected<std::string_view> payload = payload_of(frame, most);
  if (!payload) return Unexpected(payload.error());
  if (std::is_same_v<Message, pb::ToCoordinator> && has_too_many_parts(*payload)) {
    return bad_input("a message with more parts than the protocol's limits", "limits");
  }
  auto* message = google::protobuf::Arena::CreateMessage<Message>(&arena);
  if (!message->ParseFromArray(payload->data(), static_cast<int>(payload->size()))) {
    return bad_input("a frame that is not a message of this protocol", "protobuf");
  }
  return message;
}

template <class Items, class IsFine>
bool all(const Items& items, IsFine is_fine) {
  if (items.size() > kMaxItemsPerMessage) return false;
  for (const auto& item : items) {
    if (!is_fine(item)) return false;
  }
  return true;
}

constexpr bool is_from_0_to(std::int64_t number, std::int64_t most) {
  return number >= 0 && number <= most;
}

bool is_key(const pb::Key& key) {
  return pack(key).has_value();
}

bool is_fine(const pb::Hello& hello) {
  return hello.worker_id().size() == kWorkerIdBytes && hello.slots() >= 1 &&
         hello.slots() <= kMaxSlots && hello.build().size() <= kMaxNameBytes &&
         hello.self_test().size() <= kMaxNameBytes && hello.host().size() <= kMaxNameBytes &&
         hello.job().size() <= kMaxNameBytes && hello.cpu().size() <= kMaxNameBytes &&
         hello.secret().size() <= kMaxNameBytes && all(hello.holds(), is_key) &&
         is_from_0_to(hello.pid(), kMostWhole) &&
         all(hello.attempts(),
             [](std::int64_t attempt) { return is_from_0_to(attempt, kMostAttempts); }) &&
         (hello.signatures().empty() || (hello.signatures_size() == hello.holds_size() &&
                                         hello.attempts_size() == hello.holds_size()));
}

bool is_result(const pb::Result& result) {
  const bool fits =
      result.failure().size() <= kMaxTextBytes && result.command().size() <= kMaxTextBytes &&
      result.output().size() <= kMaxTextBytes && result.errors().size() <= kMaxTextBytes;
  const bool is_score = std::isfinite(result.score()) && !is_too_large(result.score());
  return is_key(result.key()) && fits && result.time() >= 0 && result.time() <= kLargestCost &&
         is_from_0_to(result.attempt(), kMostAttempts) &&
         is_from_0_to(result.wall_us(), 1000 * kLongestTime_ms) &&
         (!result.failure().empty() || is_score);
}

bool is_task(const pb::Task& task) {
  return is_key(task.key()) && task.machine().size() <= kMaxMachineBytes && task.bound() >= 0 &&
         task.bound() <= kLargestCost && is_from_0_to(task.attempt(), kMostAttempts) &&
         task.instance() >= -kMostWhole && task.instance() <= kMostWhole &&
         all(task.alive(),
             [](std::int64_t number) { return number >= 1 && number <= kMostCandidates; });
}

bool is_fine(const pb::Heartbeat& heartbeat) {
  return all(heartbeat.running(), [](const pb::Running& running) {
    return is_key(running.key()) && is_from_0_to(running.elapsed_ms(), kLongestTime_ms);
  });
}

bool is_fine(const pb::Command& command) {
  return command.campaign().size() <= kMaxTextBytes && command.who().size() <= kMaxTextBytes &&
         command.whom().size() <= kMaxTextBytes && is_from_0_to(command.design(), kMostDesigns) &&
         is_from_0_to(command.budget(), kMostWhole);
}

/// 0: the worker uses its own time.
bool is_fine(const pb::Welcome& welcome) {
  return is_from_0_to(welcome.heartbeat_ms(), kLongestWait_ms) &&
         is_from_0_to(welcome.dead_after_ms(), kLongestWait_ms) &&
         is_from_0_to(welcome.resend_ms(), kLongestWait_ms);
}

bool is_fine(const pb::ToCoordinator& message) {
  switch (message.body_case()) {
    case pb::ToCoordinator::kHello:
      return is_fine(message.hello());
    case pb::ToCoordinator::kResults:
      return all(message.results().results(), is_result);
    case pb::ToCoordinator::kHeartbeat:
      return is_fine(message.heartbeat());
    case pb::ToCoordinator::kReturned:
      return all(message.returned().keys(), is_key);
    case pb::ToCoordinator::kBegan:
      return is_key(message.began().key());
    case pb::ToCoordinator::kCommand:
      return is_fine(message.command());
    case pb::ToCoordinator::kWantStatus:
    case pb::ToCoordinator::kCredit:
    case pb::ToCoordinator::kGoodbye:
    case pb::ToCoordinator::kWantScenario:
    case pb::ToCoordinator::BODY_NOT_SET:
      return true;
  }
  return true;
}

bool is_fine(const pb::ToWorker& message) {
  switch (message.body_case()) {
    case pb::ToWorker::kTasks:
      return all(message.tasks().tasks(), is_task);
    case pb::ToWorker::kAcknowledged:
      return all(message.acknowledged().keys(), is_key);
    case pb::ToWorker::kReject:
      return message.reject().sentence().size() <= kMaxTextBytes;
    case pb::ToWorker::kNotice:
      return message.notice().sentence().size() <= kMaxTextBytes;
    case pb::ToWorker::kHeartbeat:
      return is_fine(message.heartbeat());
    case pb::ToWorker::kWelcome:
      return is_fine(message.welcome());
    case pb::ToWorker::kScenario:
    case pb::ToWorker::kDrain:
    case pb::ToWorker::kWhoAreYou:
    case pb::ToWorker::kCommandReply:
    case pb::ToWorker::kStatusReply:
    case pb::ToWorker::BODY_NOT_SET:
      return true;
  }
  return true;
}

template <class Message>
Expected<const Message*> decode(std::string_view frame, std::size_t most,
                                google::protobuf::Arena& arena) {
  Expected<const Message*> message = parse<Message>(frame, most, arena);
  if (message && !is_fine(**message)) {
    return bad_input("a message with a value outside of the protocol's limits", "limits");
  }
  return message;
}

}  // namespace

std::string encode(const pb::ToCoordinator& message) {
  return encode_message(message);
}
std::string encode(const pb::ToWorker& message) {
  return encode_message(message);
}

Expected<const pb::ToCoordinator*> decode_to_coordinator(std::string_view frame,
                                                         google::protobuf::Arena& arena) {
  return decode<pb::ToCoordinator>(frame, kMaxFrameBytes, arena);
}

Expected<const pb::ToWorker*> decode_to_worker(std::string_view frame,
                                               google::protobuf::Arena& arena) {
  return decode<pb::ToWorker>(frame, kMaxFrameToWorkerBytes, arena);
}

std::uint64_t digest_of_scenario(std::string_view bytes) {
  Digest digest;
  digest.add(bytes);
  return digest.value64();
}

}  // namespace swarmsmith
