#include "coordinator/service/messages.h"

#include <algorithm>

#include "proto/task_messages.h"
#include "proto/wire.h"
#include "proto/wire.pb.h"

namespace swarmsmith {
namespace {

std::int64_t milliseconds(Duration duration) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(duration).count();
}

pb::Reject::Reason reason_of(RejectReason reason) {
  switch (reason) {
    case RejectReason::Protocol:
      return pb::Reject::REASON_PROTOCOL;
    case RejectReason::Build:
      return pb::Reject::REASON_BUILD;
    case RejectReason::Limit:
      return pb::Reject::REASON_LIMIT;
  }
  return pb::Reject::REASON_UNSPECIFIED;
}

}  // namespace

WorkerHello hello_of(const pb::Hello& hello, std::uint64_t incarnation, std::uint64_t scenario) {
  WorkerHello out{.identity = hello.worker_id(),
                  .incarnation = incarnation,
                  .build = hello.build(),
                  .engine_version = hello.engine_version(),
                  .self_test = hello.self_test(),
                  .slots = static_cast<int>(hello.slots()),
                  .host = hello.host(),
                  .pid = hello.pid(),
                  .job = hello.job(),
                  .cpu = hello.cpu(),
                  .client = {},
                  .address = {},
                  .same_scenario = hello.scenario() == scenario,
                  .holds = {}};
  out.holds.reserve(static_cast<std::size_t>(hello.holds_size()));
  const bool is_signed = hello.signatures_size() == hello.holds_size();
  for (int i = 0; i < hello.holds_size(); ++i) {
    out.holds.push_back({.key = *pack(hello.holds(i)),
                         .attempt = is_signed ? hello.attempts(i) : 0,
                         .signature = is_signed ? hello.signatures(i) : 0});
  }
  return out;
}

void results_of(const pb::Results& results, std::vector<Result>& out) {
  out.clear();
  for (const pb::Result& result : results.results())
    out.push_back(result_of(result));
}

void running_of(const pb::Heartbeat& heartbeat, std::vector<RunningReport>& out) {
  out.clear();
  for (const pb::Running& running : heartbeat.running()) {
    out.push_back({*pack(running.key()), running.elapsed_ms()});
  }
}

std::optional<SlotReport> slots_of(const pb::Heartbeat& heartbeat) {
  // Ten years for each slot that a worker may have: larger numbers cannot be true.
  constexpr std::uint64_t kMost = std::uint64_t{1} << 60U;
  if (!heartbeat.has_slot_us() || heartbeat.slot_us() > kMost) return std::nullopt;
  return SlotReport{
      .slot_us = static_cast<std::int64_t>(heartbeat.slot_us()),
      .busy_us = static_cast<std::int64_t>(std::min(heartbeat.busy_us(), heartbeat.slot_us()))};
}

std::vector<PackedKey> keys_of(const pb::Returned& returned) {
  std::vector<PackedKey> keys;
  for (const pb::Key& key : returned.keys())
    keys.push_back(*pack(key));
  return keys;
}

std::string frame_of(const SendWelcome& action, const PoolFacts& facts,
                     const SchedulerOptions& options) {
  pb::ToWorker message;
  message.set_incarnation(action.incarnation);
  pb::Welcome& welcome = *message.mutable_welcome();
  for (const std::string& digest : facts.campaign_digests)
    welcome.add_campaign_digests(digest);
  welcome.set_scenario(facts.scenario_digest);
  welcome.set_heartbeat_ms(milliseconds(options.heartbeat));
  welcome.set_dead_after_ms(milliseconds(options.dead_after));
  welcome.set_resend_ms(milliseconds(options.resend));
  welcome.set_max_credit(options.max_credit);
  return encode(message);
}

std::string frame_of(const SendReject& action) {
  pb::ToWorker message;
  message.set_incarnation(action.incarnation);
  message.mutable_reject()->set_reason(reason_of(action.reason));
  message.mutable_reject()->set_sentence(clipped_text(action.sentence));
  return encode(message);
}

std::string frame_of(const SendTasks& action, const PoolFacts& facts,
                     google::protobuf::Arena& arena) {
  auto& message = *google::protobuf::Arena::CreateMessage<pb::ToWorker>(&arena);
  message.set_incarnation(action.incarnation);
  pb::Tasks& tasks = *message.mutable_tasks();
  tasks.set_scenario(facts.scenario_digest);
  for (const LeasedTask& task : action.tasks)
    write(task, *tasks.add_tasks());
  return encode(message);
}

std::string frame_of(const SendHeartbeat& action) {
  pb::ToWorker message;
  message.set_incarnation(action.incarnation);
  message.mutable_heartbeat();
  return encode(message);
}

std::string frame_of(const SendNotice& action) {
  pb::ToWorker message;
  message.set_incarnation(action.incarnation);
  message.mutable_notice()->set_sentence(clipped_text(action.sentence));
  return encode(message);
}

std::string frame_of(const SendWhoAreYou&) {
  pb::ToWorker message;
  message.mutable_who_are_you();
  return encode(message);
}

std::string frame_of(const SendDrain& action) {
  pb::ToWorker message;
  message.set_incarnation(action.incarnation);
  message.mutable_drain();
  return encode(message);
}

std::string acknowledgement_of(std::span<const PackedKey> keys, std::uint64_t incarnation) {
  pb::ToWorker message;
  message.set_incarnation(incarnation);
  for (const PackedKey key : keys)
    unpack(key, *message.mutable_acknowledged()->add_keys());
  return encode(message);
}

std::string scenario_reply_of(const PoolFacts& facts, std::uint64_t incarnation) {
  pb::ToWorker message;
  message.set_incarnation(incarnation);
  message.mutable_scenario()->set_scenario(facts.scenario);
  return encode(message);
}

CommandKind command_kind_of(pb::Command_Kind kind) {
  for (const CommandKind known : {CommandKind::Pause, CommandKind::Resume, CommandKind::Cancel,
                                  CommandKind::Extend, CommandKind::Forgive}) {
    if (message_kind_of(known) == kind) return known;
  }
  return CommandKind::Unknown;
}

pb::Command_Kind message_kind_of(CommandKind kind) {
  switch (kind) {
    case CommandKind::Pause:
      return pb::Command::KIND_PAUSE;
    case CommandKind::Resume:
      return pb::Command::KIND_RESUME;
    case CommandKind::Cancel:
      return pb::Command::KIND_CANCEL;
    case CommandKind::Extend:
      return pb::Command::KIND_EXTEND;
    case CommandKind::Forgive:
      return pb::Command::KIND_FORGIVE;
    case CommandKind::Unknown:
      break;
  }
  return pb::Command::KIND_UNSPECIFIED;
}

std::string command_reply_of(bool done, const std::string& sentence) {
  pb::ToWorker message;
  message.mutable_command_reply()->set_done(done);
  message.mutable_command_reply()->set_sentence(clipped_text(sentence));
  return encode(message);
}

std::string status_reply_of(const std::string& json) {
  pb::ToWorker message;
  message.mutable_status_reply()->set_json(json);
  return encode(message);
}

}  // namespace swarmsmith
