#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace swarmsmith {

enum class LogLevel { Debug, Info, Warning, Error, None };

using LogValue = std::variant<std::string, std::int64_t, double>;

/// A key and its value in a log line. Numbers are also numbers in JSON.
struct LogField {
  std::string_view key;
  LogValue value;
};

/// Writes one line to standard error: UTC time with milliseconds, level, component, event (with a
/// verb in the past tense: "lease expired"), fields. The form is key=value, or one JSON object.
/// Thread-safe. Only programs write logs; libraries return values.
///
/// At most `LogLimiter::kMostASecond` lines of one event are written per second; another line
/// reports how many were left out.
///
/// SWARMSMITH_LOG is a list of words separated by commas: a level (debug, info, warning, error,
/// none), a form (text, json). The default level is info.
void log_event(LogLevel level, std::string_view component, std::string_view event,
               std::span<const LogField> fields);
void log_event(LogLevel level, std::string_view component, std::string_view event,
               std::initializer_list<LogField> fields = {});

/// Lines below this level are dropped; all lines if it is None. The command line overrides the
/// environment.
void set_log_level(LogLevel level);
/// The same, unless SWARMSMITH_LOG has a level.
void set_default_log_level(LogLevel level);
/// Whether SWARMSMITH_LOG has a value. Otherwise users read the program's normal output, and log
/// lines with the same content would only disturb them.
bool log_is_asked_for();

/// From now on, SIGUSR1 makes the log more verbose by one level, and SIGUSR2 less verbose.
void change_log_level_by_signals();

}  // namespace swarmsmith
