#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

namespace swarmsmith {

/// Frames through a pipe between two processes. Each is preceded by its length (four bytes,
/// little-endian).

/// Waits until the whole frame is written; false when the other end is closed. The caller must have
/// set SIGPIPE to be ignored.
bool write_frame(int descriptor, std::string_view frame);

/// Waits for a complete frame; false at the end of the pipe, or when the frame is longer than
/// `most`.
bool read_frame(int descriptor, std::size_t most, std::string& frame);

enum class PipeRead { Frame, Ended, TimedOut };
/// The same, but waits at most until `deadline`.
PipeRead read_frame_until(int descriptor, std::size_t most, std::string& frame,
                          std::chrono::steady_clock::time_point deadline);

}  // namespace swarmsmith
