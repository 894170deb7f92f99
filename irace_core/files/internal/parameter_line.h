#pragma once

#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/files/internal/line_reader.h"

namespace swarmsmith::irace {

/// A piece of a line that is read later, and where it begins.
struct Piece {
  std::string text;
  r::Place place;
};

/// A line `name "switch" type (domain) | condition`, taken apart.
struct ParameterLine {
  Piece name;
  std::string switch_text;
  char type = 'c';  ///< c, o, i, r
  bool log = false;
  Piece domain;     ///< between the outer parentheses
  Piece condition;  ///< with a comment behind it; empty for none
};

/// `line` stands before the name.
Expected<ParameterLine> read_parameter_line(LineReader& line);

/// The values of a categorical or ordinal domain. Warnings have a place in `where`.
Expected<std::vector<std::string>> read_choices(const Piece& domain, const std::string& file,
                                                std::vector<Error>& warnings);

/// The length of the text in double quotes that `text` begins with, quotes included, when a comma
/// or the end of a domain follows it; else 0, and the quote is an ordinary character.
std::size_t quoted_length(std::string_view text);

}  // namespace swarmsmith::irace
