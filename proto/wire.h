#pragma once

#include <google/protobuf/arena.h>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/expected.h"
#include "proto/wire_fwd.h"

namespace swarmsmith {

/// A frame is eight bytes of header and one message:
///
///     "SWRM" | major version, 16 bits little-endian | minor version, the same | protobuf
///
/// The header never changes, so that two versions can tell each other apart. Peers with the same
/// major version understand each other; a minor version adds fields and bodies that older peers
/// ignore.
inline constexpr std::string_view kFrameMagic = "SWRM";
inline constexpr std::size_t kFrameHeaderBytes = 8;
inline constexpr std::uint16_t kProtocolMajor = 4;
inline constexpr std::uint16_t kProtocolMinor = 1;

/// Limits that a receiver accepts; senders stay far below them.
inline constexpr std::size_t kMaxFrameBytes = 1U << 20U;
/// A scenario includes the pictures of its missions' floors.
inline constexpr std::size_t kMaxFrameToWorkerBytes = 32U << 20U;
inline constexpr int kMaxItemsPerMessage = 4096;  ///< tasks, results or keys
/// For a machine, or for switches and values of a program: some thousands of parameters.
inline constexpr std::size_t kMaxMachineBytes = 1U << 20U;
inline constexpr std::size_t kMaxTextBytes = 4U << 10U;
/// For names in a hello message: a coordinator keeps them for each worker.
inline constexpr std::size_t kMaxNameBytes = 256;
/// The part of a text that fits into a message.
inline std::string clipped_text(const std::string& text, std::size_t most = kMaxTextBytes) {
  return text.substr(0, most);
}
inline constexpr std::uint32_t kMaxSlots = 4096;
/// Limits of numbers, which keep sums and other units of them within 64 bits.
inline constexpr std::int64_t kMostWhole = std::int64_t{1} << 53;
inline constexpr std::int64_t kMostAttempts = 1'000'000'000;
/// For the time of an evaluation: a hundred years.
inline constexpr std::int64_t kLongestTime_ms = 3'155'760'000'000;
/// For the times after which a worker must do something.
inline constexpr std::int64_t kLongestWait_ms = 3'600'000;
inline constexpr std::size_t kWorkerIdBytes = 16;

/// Above one of these, senders begin a new message of tasks.
inline constexpr int kTasksPerMessage = 64;
inline constexpr std::size_t kTaskBytesPerMessage = 64U << 10U;

std::string encode(const pb::ToCoordinator& message);
std::string encode(const pb::ToWorker& message);

/// The message in a frame; it is allocated in `arena`. Errors have in `where` which part is wrong,
/// one of "length", "magic", "major version", "protobuf", "limits"; the whole frame is dropped.
/// Conflict means that the peer has another major version; its frames are otherwise well-formed. A
/// message without a body is one that this version does not know, and is not an error.
Expected<const pb::ToCoordinator*> decode_to_coordinator(std::string_view frame,
                                                         google::protobuf::Arena& arena);
Expected<const pb::ToWorker*> decode_to_worker(std::string_view frame,
                                               google::protobuf::Arena& arena);

/// The digest of a scenario's bytes. Tasks and results name their scenario with it.
std::uint64_t digest_of_scenario(std::string_view bytes);

}  // namespace swarmsmith
