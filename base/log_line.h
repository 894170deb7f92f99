#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/log.h"

namespace swarmsmith {

/// The settings in SWARMSMITH_LOG.
struct LogSettings {
  bool json = false;
  std::optional<LogLevel> level{};
  std::string unknown{};  ///< the first unknown word
};
LogSettings parse_log_settings(std::string_view text);

std::string_view name_of(LogLevel level);

/// The line without its end. `time` is written unchanged. Bytes that are not UTF-8 become question
/// marks, and characters that would control a terminal are escaped (base/shown_text.h).
std::string log_line(bool json, std::string_view time, LogLevel level, std::string_view component,
                     std::string_view event, std::span<const LogField> fields);

}  // namespace swarmsmith
