#include "console/output.h"

#include <unistd.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "base/shown_text.h"
#include "console/terminal.h"

namespace swarmsmith::cli {
namespace {

constexpr Verbatim kRed{"\x1b[31m"};
constexpr Verbatim kPlain{"\x1b[0m"};

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

/// Lines after the first stand to the right: none of them looks like an error of its own.
std::string indented(std::string text) {
  text.erase(text.find_last_not_of('\n') + 1);
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; ++at)
    text.insert(at + 1, "  ");
  return text;
}

/// A standard stream, through which no text of others steers a terminal.
struct ShownStream {
  explicit ShownStream(std::ostream& behind) : buffer(behind.rdbuf()), stream(&buffer) {
    stream.flags(behind.flags());
  }
  ShownBuffer buffer;
  std::ostream stream;
};

}  // namespace

Output standard_output() {
  static ShownStream out(std::cout);
  static ShownStream err(std::cerr);
  Output output{.out = out.stream, .err = err.stream};
  output.err_is_terminal = isatty(STDERR_FILENO) == 1 && !is_dumb();
  output.out_is_terminal = isatty(STDOUT_FILENO) == 1 && !is_dumb();
  output.color = output.err_is_terminal && !is_set("NO_COLOR");
  return output;
}

void print_error(Output& output, const Error& error) {
  if (output.color) output.err << kRed;
  output.err << output.program << ": "
             << to_string(Error{error.kind, indented(error.message),
                                as_shown(error.where, Layout::Escaped)});
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

Error cannot_write(const std::string& file, int reason) {
  Error error{ErrorKind::Unavailable, "cannot be written", file};
  std::error_code trouble;
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  if (std::filesystem::is_directory(file, trouble)) {
    error.message += ": this is a folder; name a file";
  } else if (!folder.empty() && !std::filesystem::exists(folder, trouble) && !trouble) {
    error.message += ": there is no folder " + folder.string();
  } else if (reason != 0) {
    error.message += ": " + std::generic_category().message(reason);
  }
  return error;
}

std::string json_text(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string quoted = "\"";
  while (!text.empty()) {
    const std::size_t size = character_length(text);
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
