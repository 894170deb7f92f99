#pragma once

#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/files/irace_text.h"
#include "irace_core/files/r_syntax.h"

namespace swarmsmith::irace {

/// A field of a table, and the place where it begins.
struct Cell {
  std::string text;
  bool quoted = false;
  r::Place place;

  /// As in R, an empty text also counts as missing.
  bool is_missing() const { return text.empty() || text == "NA" || text == "<NA>"; }
};

/// The non-empty rows of a table whose fields are separated by blanks, as R's read.table reads
/// them: quotes of both kinds at the start of a field, a backslash before such a quote inside it,
/// '#' begins a comment. `where` of an error is file:line:column.
Expected<std::vector<std::vector<Cell>>> read_table(const IraceText& source);

/// A field from which `text` is read back; an error if this is not possible.
Expected<std::string> print_field(const std::string& text);

}  // namespace swarmsmith::irace
