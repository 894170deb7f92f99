#pragma once

#include <cerrno>
#include <ostream>
#include <span>
#include <string>
#include <string_view>

#include "base/expected.h"
#include "console/exit_code.h"

namespace swarmsmith {

/// Where a command writes, and how: answers to `out`, all else to `err`.
struct Output {
  std::ostream& out;
  std::ostream& err;
  std::string_view program = "swarmsmith";  ///< before errors
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  bool color = false;  ///< only for `err`, and only on a terminal without NO_COLOR
  bool err_is_terminal = false;
  bool out_is_terminal = false;
};

/// Streams of this process; asks the environment about terminals and colour.
Output standard_output();

/// "PROGRAM: where: what was found and what to do"; further lines of the text, such as what a
/// program wrote, are indented.
void print_error(Output& output, const Error& error);
/// What a person may like to know; not when quiet.
void print_note(Output& output, std::string_view text);

/// Prints the error and returns what to exit with: `usage` for a wrong command line or file.
ExitCode fail(Output& output, ExitCode code, const std::string& message);
ExitCode fail(Output& output, ExitCode code, const Error& error);

}  // namespace swarmsmith
