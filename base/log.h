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

/// One key and its value in a log line. Numbers are numbers in JSON, too.
struct LogField {
  std::string_view key;
  LogValue value;
};

/// Writes one line to standard error: UTC time with milliseconds, level, component, what happened
/// (a verb in the past: "lease expired"), fields. Form: key=value, or one JSON object. Any thread.
/// Only programs log; libraries return values.
///
/// Of one event at most `LogLimiter::kMostASecond` lines a second are written; a line says how many
/// were left out.
///
/// SWARMSMITH_LOG has words with commas between: a level (debug, info, warning, error, none), a
/// form (text, json). Without a level it is info.
void log_event(LogLevel level, std::string_view component, std::string_view event,
               std::span<const LogField> fields);
void log_event(LogLevel level, std::string_view component, std::string_view event,
               std::initializer_list<LogField> fields = {});

/// Lines below this level are dropped, all of them at None. What the command line says wins over
/// the environment.
void set_log_level(LogLevel level);
/// The same, unless SWARMSMITH_LOG has a level.
void set_default_log_level(LogLevel level);
/// Whether SWARMSMITH_LOG says something: else people read what the program prints, and lines that
/// say the same are only in their way.
bool log_is_asked_for();

/// From now on SIGUSR1 makes the log one level chattier, SIGUSR2 one level quieter.
void change_log_level_by_signals();

}  // namespace swarmsmith
