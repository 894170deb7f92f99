#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/expected.h"

namespace swarmsmith::r {

/// Where a piece of text begins, from 1.
struct Place {
  std::size_t line = 1;
  std::size_t column = 1;
};

struct Node;

/// `f(a, name = b)`; operators are calls by their own name: "+", "!", "%in%", "-" with one operand.
/// Assignments ("=", "<-") and the braces of a block are not expressions and only occur at the top.
struct Argument;
struct Call {
  std::string function;
  std::vector<Argument> arguments;
};
struct Number {
  double value = 0;
  bool is_integer = false;  ///< written with the suffix L
};
struct Text {
  std::string value;  ///< without quotes, escapes resolved
};
struct Name {
  std::string value;
};
struct Logical {
  std::optional<bool> value;  ///< nothing for NA
};
struct Null {};

/// A piece of R as it is written: the part of the language that irace's files use (irace facts, 8.2
/// and 23.1).
struct Node {
  std::variant<Number, Text, Name, Logical, Null, Call> what;
  Place place;
};
struct Argument {
  std::string name;  ///< of a named argument, else empty
  Node value;
};

/// One expression, which must end with the text. Errors: `where` is line:column, counted on from
/// `start`; the message says what was found and what was expected.
Expected<Node> parse_expression(std::string_view text, Place start = {});

/// `name = expression` or `name <- expression`; a call on a line of its own has no name.
struct Statement {
  std::string name;
  Node value;
  Place place;
};
/// A file of statements, one a line or separated by `;`, with comments.
Expected<std::vector<Statement>> parse_statements(std::string_view text);

}  // namespace swarmsmith::r
