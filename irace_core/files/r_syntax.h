#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/expected.h"

namespace swarmsmith::r {

/// Where a piece of text begins, from 1; columns count characters of UTF-8.
struct Place {
  std::size_t line = 1;
  std::size_t column = 1;
};
/// "line:column".
std::string to_string(Place place);

/// `f(a, name = b)`; operators are calls by their own name: "+", "!", "%in%", "-" with one operand.
/// Parentheses leave no trace. Assignments are not expressions and only occur at the top.
struct Argument;
struct Call {
  std::string function;
  std::vector<Argument> arguments;
};
struct Number {
  double value = 0;         ///< also Inf and NaN
  bool is_integer = false;  ///< written with the suffix L
};
struct Text {
  std::string value;  ///< without quotes, escapes resolved
};
/// Also T and F, as in R, so that a parameter may be called so (see `logical_of`), and NA_real_ and
/// its sisters.
struct Name {
  std::string value;
};
struct Logical {
  std::optional<bool> value;  ///< nothing for NA
};
struct Null {};

/// A piece of R as it is written: the part of the language that irace's files use (irace facts, 8.2
/// and 23.1). No tree is deeper than 1000 nodes, so that those who walk it may recurse.
struct Node {
  std::variant<Number, Text, Name, Logical, Null, Call> what;
  Place place;  ///< of the first character; of a binary operator, the operator's
};
struct Argument {
  std::string name;  ///< of a named argument, else empty
  Node value;
};

/// TRUE, FALSE, T or F; nothing for every other node.
std::optional<bool> logical_of(const Node& node);

/// One expression, which must end with the text. Errors: `where` is line:column, counted on from
/// `start`; the message says what was found and what was expected.
Expected<Node> parse_expression(std::string_view text, Place start = {});

/// `name = expression` or `name <- expression`; an expression on a line of its own has no name.
struct Statement {
  std::string name;
  Node value;
  Place place;
};
/// A file of statements, one a line or separated by `;`, with comments. As in R, a line goes on in
/// the next one within parentheses and after an operator.
Expected<std::vector<Statement>> parse_statements(std::string_view text);

}  // namespace swarmsmith::r
