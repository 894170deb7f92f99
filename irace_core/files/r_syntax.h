#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/expected.h"

namespace swarmsmith::r {

/// The place where a piece of text begins, from 1; columns count UTF-8 characters.
struct Place {
  std::size_t line = 1;
  std::size_t column = 1;
};
/// "line:column".
std::string to_string(Place place);

/// A call `f(a, name = b)`; operators are calls with the operator as name: "+", "!", "%in%", "-"
/// with one operand. Parentheses are not kept. Assignments are not expressions and only occur at
/// the top level.
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
/// Also T and F, as in R, so that a parameter may have such a name (see `logical_of`), and NA_real_
/// and the similar constants.
struct Name {
  std::string value;
};
struct Logical {
  std::optional<bool> value;  ///< nothing for NA
};
struct Null {};

/// An expression of R: the part of the language that irace's files use (irace facts, 8.2 and 23.1).
/// A tree has at most 1000 levels, so that recursion over it is safe.
struct Node {
  std::variant<Number, Text, Name, Logical, Null, Call> what;
  Place place;  ///< of the first character; for a binary operator, of the operator
};
struct Argument {
  std::string name;  ///< of a named argument, otherwise empty
  Node value;
};

/// The value of TRUE, FALSE, T or F; nothing for any other node.
std::optional<bool> logical_of(const Node& node);

/// Parses one expression, which must be the whole text. In errors, `where` is line:column, counted
/// from `start`; the message says what was found and what was expected.
Expected<Node> parse_expression(std::string_view text, Place start = {});

/// A statement `name = expression` or `name <- expression`; for an expression without an assignment
/// the name is empty.
struct Statement {
  std::string name;
  Node value;
  Place place;
};
/// Parses a file of statements, one per line or separated by `;`, with comments. As in R, a
/// statement continues on the next line inside parentheses and after an operator.
Expected<std::vector<Statement>> parse_statements(std::string_view text);

}  // namespace swarmsmith::r
