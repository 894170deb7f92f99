#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace swarmsmith {

enum class LogLevel { Debug, Info, Warning, Error, None };

/// One key and its value in a log line.
struct LogField {
  std::string_view key;
  std::string value;
};

/// Writes one line to standard error: UTC time with milliseconds, level, component, what happened
/// (a verb in the past: "lease expired"), fields. Form: key=value, or JSON when the environment
/// has SWARMSMITH_LOG=json. Any thread. Only programs log; libraries return values.
void log(LogLevel level, std::string_view component, std::string_view event,
         std::initializer_list<LogField> fields = {});

/// Lines below this level are dropped, all of them at None; starts at Info.
void set_log_level(LogLevel level);

}  // namespace swarmsmith
