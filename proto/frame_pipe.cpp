#include "proto/frame_pipe.h"

#include <poll.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <optional>

namespace swarmsmith {
namespace {

using Deadline = std::optional<std::chrono::steady_clock::time_point>;

constexpr std::size_t kLengthBytes = 4;

bool write_all(int descriptor, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t written = write(descriptor, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

/// False when the time is over.
bool wait_for_bytes(int descriptor, const Deadline& deadline) {
  if (!deadline) return true;
  pollfd item{descriptor, POLLIN, 0};
  while (true) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(*deadline - std::chrono::steady_clock::now());
    const auto time = std::clamp<std::int64_t>(left.count(), 0, 1'000'000);
    const int ready = poll(&item, 1, static_cast<int>(time));
    if (ready > 0) return true;
    if (ready == 0 && std::chrono::steady_clock::now() >= *deadline) return false;
    if (ready < 0 && errno != EINTR) return true;  // the read reports the error
  }
}

PipeRead read_all(int descriptor, char* bytes, std::size_t size, const Deadline& deadline) {
  while (size > 0) {
    if (!wait_for_bytes(descriptor, deadline)) return PipeRead::TimedOut;
    const ssize_t got = read(descriptor, bytes, size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return PipeRead::Ended;
    bytes += got;
    size -= static_cast<std::size_t>(got);
  }
  return PipeRead::Frame;
}

PipeRead read_whole(int descriptor, std::size_t most, std::string& frame,
                    const Deadline& deadline) {
  std::array<char, kLengthBytes> head{};
  if (const PipeRead end = read_all(descriptor, head.data(), head.size(), deadline);
      end != PipeRead::Frame) {
    return end;
  }
  std::uint32_t size = 0;
  for (std::size_t i = 0; i < kLengthBytes; ++i)
    size |= static_cast<std::uint32_t>(static_cast<unsigned char>(head[i])) << (8 * i);
  // The length is checked before memory is taken for it: the other process may be broken.
  if (size > most) return PipeRead::Ended;
  frame.resize(size);
  return read_all(descriptor, frame.data(), frame.size(), deadline);
}

}  // namespace

bool write_frame(int descriptor, std::string_view frame) {
  std::array<char, kLengthBytes> head{};
  for (std::size_t i = 0; i < kLengthBytes; ++i)
    head[i] = static_cast<char>(frame.size() >> (8 * i));
  return write_all(descriptor, head.data(), head.size()) &&
         write_all(descriptor, frame.data(), frame.size());
}

bool read_frame(int descriptor, std::size_t most, std::string& frame) {
  return read_whole(descriptor, most, frame, std::nullopt) == PipeRead::Frame;
}

PipeRead read_frame_until(int descriptor, std::size_t most, std::string& frame,
                          std::chrono::steady_clock::time_point deadline) {
  return read_whole(descriptor, most, frame, deadline);
}

}  // namespace swarmsmith
