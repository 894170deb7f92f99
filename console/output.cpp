#include "console/output.h"

#include <unistd.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>

namespace swarmsmith::cli {
namespace {

constexpr std::string_view kRed = "\x1b[31m";
constexpr std::string_view kPlain = "\x1b[0m";

/// NO_COLOR counts when it is not empty (no-color.org).
bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

/// A terminal that knows no control sequences.
bool is_dumb() {
  const char* terminal = std::getenv("TERM");
  return terminal == nullptr || std::string_view(terminal) == "dumb";
}

/// Bytes of the UTF-8 character at the begin of `text`; 0 when there is none.
std::size_t character_at(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t size = first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
  if (size == 0 || first > 0xf4 || text.size() < size) return 0;
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return 0;
  }
  // Longer than needed, half of a surrogate pair, beyond the last.
  const unsigned char second = byte(1);
  if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f)) return 0;
  if ((first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f)) return 0;
  return size;
}

}  // namespace

Output standard_output() {
  Output output{.out = std::cout, .err = std::cerr};
  output.err_is_terminal = isatty(STDERR_FILENO) == 1 && !is_dumb();
  output.out_is_terminal = isatty(STDOUT_FILENO) == 1 && !is_dumb();
  output.color = output.err_is_terminal && !is_set("NO_COLOR");
  return output;
}

void print_error(Output& output, const Error& error) {
  if (output.color) output.err << kRed;
  output.err << output.program << ": " << to_string(error);
  if (output.color) output.err << kPlain;
  output.err << '\n';
}

void print_note(Output& output, std::string_view text) {
  if (!output.quiet) output.err << text << '\n';
}

ExitCode fail(Output& output, ExitCode code, const std::string& message) {
  return fail(output, code, Error{ErrorKind::BadInput, message, {}});
}

ExitCode fail(Output& output, ExitCode code, const Error& error) {
  print_error(output, error);
  return code;
}

Error cannot_write(const std::string& file) {
  Error error{ErrorKind::Unavailable, "cannot be written", file};
  std::error_code trouble;
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  if (std::filesystem::is_directory(file, trouble)) {
    error.message += ": this is a folder; name a file";
  } else if (!folder.empty() && !std::filesystem::exists(folder, trouble) && !trouble) {
    error.message += ": there is no folder " + folder.string();
  }
  return error;
}

std::string json_text(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string quoted = "\"";
  while (!text.empty()) {
    const std::size_t size = character_at(text);
    const char letter = text.front();
    const auto code = static_cast<unsigned char>(letter);
    if (size != 1) {
      // What is no text (names of files may be anything) is replaced: JSON is UTF-8.
      quoted += size == 0 ? std::string_view("\xef\xbf\xbd") : text.substr(0, size);
      text.remove_prefix(size == 0 ? 1 : size);
      continue;
    }
    text.remove_prefix(1);
    if (letter == '"' || letter == '\\') {
      quoted += '\\';
      quoted += letter;
    } else if (letter == '\n') {
      quoted += "\\n";
    } else if (letter == '\t') {
      quoted += "\\t";
    } else if (code < 0x20) {
      quoted += "\\u00";
      quoted += kDigits[code >> 4U];
      quoted += kDigits[code & 15U];
    } else {
      quoted += letter;
    }
  }
  return quoted + "\"";
}

std::string json_number(double value) {
  if (!std::isfinite(value)) return "null";
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

}  // namespace swarmsmith::cli
