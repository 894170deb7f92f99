#include "console/output.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "base/environment.h"
#include "base/shown_text.h"
#include "console/terminal.h"

namespace swarmsmith {
namespace {

constexpr Verbatim kRed{"\x1b[31m"};
constexpr Verbatim kPlain{"\x1b[0m"};

/// A terminal that does not support control sequences.
bool is_dumb() {
  return environment("TERM", "dumb") == "dumb";
}

/// Indents all lines after the first, so that none of them looks like a separate error.
std::string indented(std::string text) {
  text.erase(text.find_last_not_of('\n') + 1);
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; ++at)
    text.insert(at + 1, "  ");
  return text;
}

/// A standard stream that removes terminal control sequences from untrusted text.
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
  // If both streams go to the same file or pipe, their lines stay complete and in order.
  err.stream.tie(&out.stream);
  Output output{.out = out.stream, .err = err.stream};
  output.err_is_terminal = isatty(STDERR_FILENO) == 1 && !is_dumb();
  output.out_is_terminal = isatty(STDOUT_FILENO) == 1 && !is_dumb();
  // NO_COLOR counts only if it is not empty (no-color.org).
  output.color = output.err_is_terminal && environment("NO_COLOR").empty();
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

}  // namespace swarmsmith
