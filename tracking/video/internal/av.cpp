#include "tracking/video/internal/av.h"

extern "C" {
#include <libavutil/log.h>
#include <libavutil/mem.h>
}

#include <array>
#include <cstdarg>
#include <cstdio>
#include <string_view>

namespace swarmsmith::av {
namespace {

thread_local std::string last_message;

/// Keeps only printable ASCII, because the library's messages quote damaged files.
std::string on_one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const bool printable = c >= ' ' && c <= '~';
    if (printable) line += c;
  }
  return line;
}

void keep_message(void* /*context*/, int level, const char* format, va_list arguments) {
  if (level > AV_LOG_ERROR) return;
  std::array<char, 400> text{};
  const int length = std::vsnprintf(text.data(), text.size(), format, arguments);
  if (length > 0) last_message = on_one_line(text.data());
}

}  // namespace

void set_up() {
  // A table in a damaged file may claim gigabytes; a picture of kMostPixels needs at most 300 MB.
  constexpr std::size_t kMostBytesAtATime = std::size_t{512} << 20;
  av_max_alloc(kMostBytesAtATime);
  av_log_set_callback(keep_message);
}

std::string take_message() {
  std::string message;
  message.swap(last_message);
  return message;
}

std::string reason(int code) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(code, text.data(), text.size());
  std::string words(text.data());
  const std::string message = take_message();
  if (!message.empty()) words += " (" + message + ")";
  return words;
}

}  // namespace swarmsmith::av
