#pragma once

#include <google/protobuf/arena.h>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "coordinator/pool/scheduler_types.h"
#include "proto/wire_fwd.h"

namespace swarmsmith {

/// Converts messages of workers to the scheduler's plain values, and its actions to frames.
/// Messages come from `decode_to_coordinator`, so their keys and numbers are valid.

WorkerHello hello_of(const pb::Hello& hello, std::uint64_t incarnation, std::uint64_t scenario);
void results_of(const pb::Results& results, std::vector<Result>& out);
void running_of(const pb::Heartbeat& heartbeat, std::vector<RunningReport>& out);
/// None for a worker that does not report its slots' time.
std::optional<SlotReport> slots_of(const pb::Heartbeat& heartbeat);
std::vector<PackedKey> keys_of(const pb::Returned& returned);

/// What a worker is sent about the campaigns.
struct PoolFacts {
  std::vector<std::string> campaign_digests;
  std::string scenario;  ///< serialised
  std::uint64_t scenario_digest = 0;
};

std::string frame_of(const SendWelcome& action, const PoolFacts& facts,
                     const SchedulerOptions& options);
std::string frame_of(const SendReject& action);
std::string frame_of(const SendTasks& action, const PoolFacts& facts,
                     google::protobuf::Arena& arena);
std::string frame_of(const SendHeartbeat& action);
std::string frame_of(const SendNotice& action);
std::string frame_of(const SendWhoAreYou& action);
std::string frame_of(const SendDrain& action);
/// One frame for at most kMaxItemsPerMessage keys.
std::string acknowledgement_of(std::span<const PackedKey> keys, std::uint64_t incarnation);
std::string scenario_reply_of(const PoolFacts& facts, std::uint64_t incarnation);

/// The kind of a command as rows store it; Unknown for kinds that this version does not know.
CommandKind command_kind_of(pb::Command_Kind kind);
/// The reverse; not for Unknown.
pb::Command_Kind message_kind_of(CommandKind kind);
/// Answers to commands and to requests for the status.
std::string command_reply_of(bool done, const std::string& sentence);
std::string status_reply_of(const std::string& json);

}  // namespace swarmsmith
