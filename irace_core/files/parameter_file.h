#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/files/irace_text.h"
#include "irace_core/parameter_space.h"

namespace swarmsmith {

/// The files that together say what is tuned. irace 4 has all in the parameter file; irace 3.5 has
/// `digits` in the scenario and forbidden lines in a file of their own; the irace that AutoMoDe
/// used has bounds that depend on other parameters in a dependency file, whose lines read `N0x0
/// (|NumStates-2)`: `name (lower|upper)`, an empty side leaves that bound as it is.
struct ParameterSources {
  IraceText parameters;
  std::optional<IraceText> forbidden;   ///< irace 3.5's forbiddenFile (irace facts, 23.5)
  std::optional<IraceText> dependency;  ///< dependencyFile
  /// irace 3.5's option: bounds are then rounded to so many decimals, as 3.5 does, with a warning.
  std::optional<int> digits;
  /// In conditions irace 4 refuses && and ||, irace 3.5 (and its own template) has them. They are
  /// read as & and |, with a warning, unless this is set.
  bool refuse_doubled_operators = false;
};

struct ParameterFile {
  ParameterSpace space;
  std::vector<std::string> warnings;  ///< a sentence each, with its place
};

/// Reads irace's parameter description (irace facts, 23.2 and 8). Errors: `where` is
/// file:line:column; the message says what was expected and quotes the unread rest of the line.
///
/// Differences from R's irace, all of them on text that R refuses or that counts as a defect there:
/// `#` and `|` within double quotes are part of the text; blanks before a comma are trimmed from an
/// unquoted value, with a warning; a bound may hold commas (`(1, min(ants, 10))`); text behind a
/// closing quote is an error; the bounds of inactive parameters are not looked at.
Expected<ParameterFile> parse_parameter_file(const ParameterSources& sources);

/// The space as a parameter file of irace 4, which reads back as the same space. An error names a
/// switch or value that the format cannot hold (quotes and commas in one value, line ends).
Expected<std::string> print_parameter_file(const ParameterSpace& space);

/// The same for irace 3.5: dependent domains are quoted, and what 3.5 keeps elsewhere is apart.
struct Irace35Files {
  std::string parameters;
  std::string forbidden;  ///< empty for none
  int digits = 4;
};
Expected<Irace35Files> print_irace_35_files(const ParameterSpace& space);

}  // namespace swarmsmith
