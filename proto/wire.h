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
/// The header never changes, so that two versions can tell each other apart. Peers of one major
/// version understand each other; a minor version adds fields and bodies that the other ignores.
inline constexpr std::string_view kFrameMagic = "SWRM";
inline constexpr std::size_t kFrameHeaderBytes = 8;
inline constexpr std::uint16_t kProtocolMajor = 4;
inline constexpr std::uint16_t kProtocolMinor = 1;

/// What a receiver puts up with; senders keep far below.
inline constexpr std::size_t kMaxFrameBytes = 1U << 20U;
/// A scenario has the pictures of its missions' floors.
inline constexpr std::size_t kMaxFrameToWorkerBytes = 32U << 20U;
inline constexpr int kMaxItemsPerMessage = 4096;  ///< tasks, results or keys
/// A machine, or switches and values of a program: some thousands of parameters.
inline constexpr std::size_t kMaxMachineBytes = 1U << 20U;
inline constexpr std::size_t kMaxTextBytes = 4U << 10U;
/// Names of a hello: a coordinator keeps them for each worker.
inline constexpr std::size_t kMaxNameBytes = 256;
/// As much of a text as a message may carry.
inline std::string clipped_text(const std::string& text, std::size_t most = kMaxTextBytes) {
  return text.substr(0, most);
}
inline constexpr std::uint32_t kMaxSlots = 4096;
inline constexpr std::size_t kWorkerIdBytes = 16;

/// Where senders close a message of tasks.
inline constexpr int kTasksPerMessage = 64;
inline constexpr std::size_t kTaskBytesPerMessage = 64U << 10U;

std::string encode(const pb::ToCoordinator& message);
std::string encode(const pb::ToWorker& message);

/// The message in a frame; it lives in `arena`. Errors have in `where` the part that is wrong, one
/// of "length", "magic", "major version", "protobuf", "limits": a frame is dropped as a whole.
/// Kind Conflict is a peer of another major version, whose frames are well formed otherwise. A
/// message without a body is one that this version does not know: not an error.
Expected<const pb::ToCoordinator*> decode_to_coordinator(std::string_view frame,
                                                         google::protobuf::Arena& arena);
Expected<const pb::ToWorker*> decode_to_worker(std::string_view frame,
                                               google::protobuf::Arena& arena);

/// What tasks and results name a scenario by: a digest of its serialised bytes.
std::uint64_t digest_of_scenario(std::string_view bytes);

}  // namespace swarmsmith
