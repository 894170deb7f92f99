#include "base/log_line.h"

#include <fmt/format.h>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/overloaded.h"
#include "base/shown_text.h"

namespace swarmsmith {
namespace {

constexpr std::array<std::string_view, 5> kLevels = {"debug", "info", "warning", "error", "none"};

/// Bytes that are not UTF-8 become question marks, since JSON has no escape for a byte.
void append_quoted(std::string& out, std::string_view text) {
  out += '"';
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    const char c = text.front();
    if (length == 0) {
      out += '?';
    } else if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (const std::string escape = escape_of(text, length); !escape.empty()) {
      out += escape;
    } else {
      out += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  out += '"';
}

/// Without quotes if it reads as one word, else in quotes.
void append_word(std::string& out, std::string_view text) {
  const bool word = !text.empty() && text.find_first_of(" \"=\\") == std::string_view::npos &&
                    as_shown(text, Layout::Escaped) == text;
  if (word) {
    out += text;
  } else {
    append_quoted(out, text);
  }
}

void append_value(std::string& out, const LogValue& value, bool json) {
  std::visit(Overloaded{[&](const std::string& text) {
                          json ? append_quoted(out, text) : append_word(out, text);
                        },
                        [&](std::int64_t number) { out += std::to_string(number); },
                        [&](double number) {
                          out += std::isfinite(number) ? fmt::format("{}", number) : "null";
                        }},
             value);
}

}  // namespace

std::string_view name_of(LogLevel level) {
  return kLevels[static_cast<std::size_t>(level)];
}

LogSettings parse_log_settings(std::string_view text) {
  LogSettings settings;
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    const std::string_view word = text.substr(0, comma);
    text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
    bool known = word.empty() || word == "json" || word == "text";
    if (word == "json") settings.json = true;
    for (std::size_t i = 0; i < kLevels.size(); ++i) {
      if (word != kLevels[i]) continue;
      settings.level = static_cast<LogLevel>(i);
      known = true;
    }
    if (!known && settings.unknown.empty()) settings.unknown = word;
  }
  return settings;
}

std::string log_line(bool json, std::string_view time, LogLevel level, std::string_view component,
                     std::string_view event, std::span<const LogField> fields) {
  std::string line;
  if (json) {
    line += "{\"time\":";
    append_quoted(line, time);
    line += ",\"level\":";
    append_quoted(line, name_of(level));
    line += ",\"component\":";
    append_quoted(line, component);
    line += ",\"event\":";
    append_quoted(line, event);
  } else {
    line += time;
    line += " level=";
    line += name_of(level);
    line += " component=";
    append_word(line, component);
    line += " event=";
    append_quoted(line, event);
  }
  for (const LogField& field : fields) {
    if (json) {
      line += ',';
      append_quoted(line, field.key);
      line += ':';
    } else {
      line += ' ';
      line += field.key;
      line += '=';
    }
    append_value(line, field.value, json);
  }
  if (json) line += '}';
  return line;
}

}  // namespace swarmsmith
