#pragma once

#include <string>
#include <string_view>

#include "base/expected.h"
#include "irace_core/files/internal/r_literal.h"
#include "irace_core/files/r_syntax.h"

namespace swarmsmith::r {

enum class TokenKind {
  Number,
  Text,
  Name,      ///< also reserved words
  Operator,  ///< also parentheses, comma and semicolon
  LineEnd,
  End,
};

struct Token {
  TokenKind kind = TokenKind::End;
  /// The value of a Text, otherwise the text as written (names without backticks).
  std::string text;
  Number number;
  bool quoted = false;  ///< a name in backticks, which is never a reserved word
  Place place;

  bool is(std::string_view op) const { return kind == TokenKind::Operator && text == op; }
};

/// The name of a token in messages: `"x"`, `'+'`, `the end of the line`.
std::string describe(const Token& token);

/// Splits R text into tokens, one at a time; comments and blanks are skipped.
class Lexer {
 public:
  Lexer(std::string_view text, Place start) : rest_(text), place_(start) {}
  Expected<Token> next();

 private:
  void advance(std::size_t bytes);
  void skip_blanks();
  Expected<Token> number();
  Expected<Token> quoted(Expected<TextLiteral> literal);
  Expected<Token> name();
  Expected<Token> operation();
  Token take(TokenKind kind, std::size_t bytes);

  std::string_view rest_;
  Place place_;
};

}  // namespace swarmsmith::r
