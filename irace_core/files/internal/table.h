#pragma once

#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/files/irace_text.h"
#include "irace_core/files/r_syntax.h"

namespace swarmsmith::irace {

/// A field of a table, and where it begins.
struct Cell {
  std::string text;
  bool quoted = false;
  r::Place place;

  /// An empty text is missing, too, as R reads it.
  bool is_missing() const { return text.empty() || text == "NA" || text == "<NA>"; }
};

/// The non-empty rows of a table with blanks between its fields, as R's read.table reads them:
/// quotes of both kinds where a field begins, a backslash before such a quote within, '#' begins a
/// comment. Errors: `where` is file:line:column.
Expected<std::vector<std::vector<Cell>>> read_table(const IraceText& source);

/// A field that reads back as `text`; an error when there is none.
Expected<std::string> print_field(const std::string& text);

}  // namespace swarmsmith::irace
