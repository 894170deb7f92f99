#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/files/irace_text.h"
#include "irace_core/parameter_space.h"

namespace swarmsmith {

/// The files that together describe the parameters. irace 4 has everything in the parameter file.
/// irace 3.5 has `digits` in the scenario and forbidden lines in a separate file. The version of
/// irace that AutoMoDe used has bounds that depend on other parameters in a dependency file, with
/// lines such as `N0x0 (|NumStates-2)`: `name (lower|upper)`, where an empty side keeps that bound.
struct ParameterSources {
  IraceText parameters;
  std::optional<IraceText> forbidden;   ///< irace 3.5's forbiddenFile (irace facts, 23.5)
  std::optional<IraceText> dependency;  ///< dependencyFile
  /// irace 3.5's option: bounds are rounded to this number of decimals, as in 3.5, with a warning.
  std::optional<int> digits;
  /// In conditions, irace 4 refuses && and ||, but irace 3.5 (and its own template) has them. They
  /// are read as & and |, with a warning, unless this is set.
  bool refuse_doubled_operators = false;
};

struct ParameterFile {
  ParameterSpace space;
  std::vector<std::string> warnings;  ///< one sentence each, with its place
};

/// Reads irace's parameter description (irace facts, 23.2 and 8). In errors, `where` is
/// file:line:column; the message says what was expected and quotes the unread rest of the line.
///
/// There are differences from R's irace, all of them for text that R refuses or where its behaviour
/// counts as a defect: `#` and `|` inside double quotes are part of the text; blanks before a comma
/// are trimmed from an unquoted value, with a warning; a bound may contain commas (`(1, min(ants,
/// 10))`); text after a closing quote is an error; the bounds of inactive parameters are not
/// checked.
Expected<ParameterFile> parse_parameter_file(const ParameterSources& sources);

/// The space as a parameter file of irace 4, from which the same space is read back. If the format
/// cannot hold a switch or a value (quotes and commas in one value, line ends), the error names it.
Expected<std::string> print_parameter_file(const ParameterSpace& space);

/// The same for irace 3.5: dependent domains are quoted, and `digits` and forbidden lines are
/// separate.
struct Irace35Files {
  std::string parameters;
  std::string forbidden;  ///< empty for none
  int digits = 4;
};
Expected<Irace35Files> print_irace_35_files(const ParameterSpace& space);

}  // namespace swarmsmith
