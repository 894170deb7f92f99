#pragma once

#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/files/internal/line_reader.h"

namespace swarmsmith::irace {

/// A part of a line that is parsed later, and the place where it begins.
struct Piece {
  std::string text;
  r::Place place;
};

/// The parts of a line `name "switch" type (domain) | condition`.
struct ParameterLine {
  Piece name;
  std::string switch_text;
  char type = 'c';  ///< c, o, i, r
  bool log = false;
  Piece domain;     ///< between the outer parentheses
  Piece condition;  ///< including a comment after it; empty for none
};

/// `line` must be positioned before the name.
Expected<ParameterLine> read_parameter_line(LineReader& line);

/// The values of a categorical or ordinal domain. Warnings have their place in `where`.
Expected<std::vector<std::string>> read_choices(const Piece& domain, const std::string& file,
                                                std::vector<Error>& warnings);

/// The length, including the quotes, of the quoted text at the start of `text`, if a comma or the
/// end of a domain follows it; otherwise 0, and the quote is an ordinary character.
std::size_t quoted_length(std::string_view text);

}  // namespace swarmsmith::irace
