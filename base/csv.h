#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swarmsmith {

/// Tables with commas (RFC 4180, lines end with LF), as every program here writes and reads them.

/// One field: in quotes when it must be. A text that a spreadsheet would take for a formula, or for
/// a line of its own, begins with an apostrophe then: one that begins with = + - @, a tab or a line
/// end. Numbers stay as they are; so do switches and their values, --s0 1 -a 0.5: a minus, a
/// letter, and nothing but letters, digits, blanks and . _ - / : , call nothing.
std::string csv_field(std::string_view text);

/// The texts as fields of one line, with its end.
std::string csv_line(const std::vector<std::string>& texts);

/// The text of a field that `csv_field` wrote, or a person: without that apostrophe.
std::string_view csv_text(std::string_view field);

}  // namespace swarmsmith
