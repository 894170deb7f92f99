#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/log.h"

namespace swarmsmith {

/// What SWARMSMITH_LOG asks for.
struct LogSettings {
  bool json = false;
  std::optional<LogLevel> level{};
  std::string unknown{};  ///< the first word that means nothing
};
LogSettings parse_log_settings(std::string_view text);

std::string_view name_of(LogLevel level);

/// The line without its end. `time` is written as it is. Text that is not UTF-8 gets question
/// marks, and what would steer a terminal an escape (base/shown_text.h).
std::string log_line(bool json, std::string_view time, LogLevel level, std::string_view component,
                     std::string_view event, std::span<const LogField> fields);

}  // namespace swarmsmith
