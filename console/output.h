#pragma once

#include <cerrno>
#include <ostream>
#include <span>
#include <string>
#include <string_view>

#include "base/expected.h"
#include "console/exit_code.h"

namespace swarmsmith {

/// The streams and settings for a command's output: answers go to `out`, everything else to `err`.
struct Output {
  std::ostream& out;
  std::ostream& err;
  std::string_view program = "swarmsmith";  ///< printed before errors
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  bool color = false;  ///< only for `err`, and only on a terminal without NO_COLOR
  bool err_is_terminal = false;
  bool out_is_terminal = false;
};

/// The streams of this process. Looks up terminals and colour settings in the environment.
Output standard_output();

/// Prints "PROGRAM: where: error and advice". Further lines of the text, such as the output of a
/// program, are indented.
void print_error(Output& output, const Error& error);
/// Prints information that may be useful; nothing with --quiet.
void print_note(Output& output, std::string_view text);

/// Prints the error and returns `code`.
ExitCode fail(Output& output, ExitCode code, const std::string& message);
ExitCode fail(Output& output, ExitCode code, const Error& error);

}  // namespace swarmsmith
