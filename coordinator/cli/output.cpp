#include "coordinator/cli/output.h"

#include <unistd.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <iostream>

namespace swarmsmith::cli {
namespace {

constexpr std::string_view kRed = "\x1b[31m";
constexpr std::string_view kPlain = "\x1b[0m";

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

bool is_dumb() {
  const char* terminal = std::getenv("TERM");
  return terminal == nullptr || std::string_view(terminal) == "dumb";
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
  output.err << "swarmsmith: " << to_string(error);
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

std::string json_text(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string quoted = "\"";
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
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
