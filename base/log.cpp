#include "base/log.h"

#include <fmt/format.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <cstdlib>
#include <iterator>
#include <memory>

namespace swarmsmith {
namespace {

bool wants_json() {
  const char* form = std::getenv("SWARMSMITH_LOG");
  return form != nullptr && std::string_view(form) == "json";
}

void append_quoted(std::string& out, std::string_view text) {
  out += '"';
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      fmt::format_to(std::back_inserter(out), "\\u{:04x}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  out += '"';
}

/// Bare when it reads as one word, quoted otherwise.
void append_value(std::string& out, std::string_view text) {
  const bool word = !text.empty() && text.find_first_of(" \t\n\r\"=\\") == std::string_view::npos;
  if (word) {
    out += text;
  } else {
    append_quoted(out, text);
  }
}

struct Log {
  bool json = wants_json();
  std::shared_ptr<spdlog::logger> logger = [this] {
    auto made = std::make_shared<spdlog::logger>("swarmsmith",
                                                 std::make_shared<spdlog::sinks::stderr_sink_mt>());
    made->set_formatter(std::make_unique<spdlog::pattern_formatter>(
        json ? R"({"time":"%Y-%m-%dT%H:%M:%S.%eZ","level":"%l",%v})"
             : "%Y-%m-%dT%H:%M:%S.%eZ level=%l %v",
        spdlog::pattern_time_type::utc));
    made->flush_on(spdlog::level::trace);
    return made;
  }();
};

Log& the_log() {
  static Log log;
  return log;
}

spdlog::level::level_enum to_spdlog(LogLevel level) {
  switch (level) {
    case LogLevel::Debug:
      return spdlog::level::debug;
    case LogLevel::Info:
      return spdlog::level::info;
    case LogLevel::Warning:
      return spdlog::level::warn;
    case LogLevel::Error:
      return spdlog::level::err;
    case LogLevel::None:
      return spdlog::level::off;
  }
  return spdlog::level::err;
}

}  // namespace

void log(LogLevel level, std::string_view component, std::string_view event,
         std::initializer_list<LogField> fields) {
  Log& sink = the_log();
  if (!sink.logger->should_log(to_spdlog(level))) return;
  std::string line;
  if (sink.json) {
    line += "\"component\":";
    append_quoted(line, component);
    line += ",\"event\":";
    append_quoted(line, event);
    for (const LogField& field : fields) {
      line += ',';
      append_quoted(line, field.key);
      line += ':';
      append_quoted(line, field.value);
    }
  } else {
    line += "component=";
    append_value(line, component);
    line += " event=";
    append_quoted(line, event);
    for (const LogField& field : fields) {
      line += ' ';
      line += field.key;
      line += '=';
      append_value(line, field.value);
    }
  }
  sink.logger->log(to_spdlog(level), "{}", line);
}

void set_log_level(LogLevel level) {
  the_log().logger->set_level(to_spdlog(level));
}

}  // namespace swarmsmith
