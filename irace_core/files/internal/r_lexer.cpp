#include "irace_core/files/internal/r_lexer.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "irace_core/files/internal/r_literal.h"

namespace swarmsmith::r {
namespace {

bool is_name_byte(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '.' || static_cast<unsigned char>(c) >= 0x80;
}

std::string shortened(std::string_view text) {
  constexpr std::size_t kMost = 40;
  if (text.size() <= kMost) return std::string(text);
  std::size_t end = 0;
  while (end < kMost)
    end += character_length(text.substr(end));
  return std::string(text.substr(0, end)) + "...";
}

}  // namespace

std::string describe(const Token& token) {
  switch (token.kind) {
    case TokenKind::Number:
      return shortened(token.text);
    case TokenKind::Text:
      return "the string \"" + shortened(token.text) + "\"";
    case TokenKind::Name:
    case TokenKind::Operator:
      return "'" + shortened(token.text) + "'";
    case TokenKind::LineEnd:
      return "the end of the line";
    case TokenKind::End:
      break;
  }
  return "the end";
}

void Lexer::advance(std::size_t bytes) {
  while (bytes > 0) {
    const std::size_t length = std::min(bytes, character_length(rest_));
    ++place_.column;
    if (rest_.front() == '\n') place_ = {place_.line + 1, 1};
    rest_.remove_prefix(length);
    bytes -= length;
  }
}

void Lexer::skip_blanks() {
  for (;;) {
    const std::size_t blanks = std::min(rest_.find_first_not_of(" \t\r\f"), rest_.size());
    advance(blanks);
    if (rest_.empty() || rest_.front() != '#') return;
    advance(std::min(rest_.find('\n'), rest_.size()));
  }
}

Token Lexer::take(TokenKind kind, std::size_t bytes) {
  Token token{kind, std::string(rest_.substr(0, bytes)), {}, false, place_};
  advance(bytes);
  return token;
}

Expected<Token> Lexer::next() {
  skip_blanks();
  if (rest_.empty()) return take(TokenKind::End, 0);
  const char c = rest_.front();
  if (c == '\n') return take(TokenKind::LineEnd, 1);
  if (c == '"' || c == '\'') return quoted(read_text(rest_));
  if (auto raw = read_raw_text(rest_)) return quoted(std::move(*raw));
  const NumberLiteral literal = read_number(rest_);
  if (literal.bytes > 0) {
    Token token = take(TokenKind::Number, literal.bytes);
    token.number = literal.number;
    return token;
  }
  if (c == '`' || (is_name_byte(c) && c != '_')) return name();
  return operation();
}

Expected<Token> Lexer::quoted(Expected<TextLiteral> literal) {
  if (!literal) {
    const std::string message = literal.error().message;
    advance(static_cast<std::size_t>(std::atoi(literal.error().where.c_str())));
    return bad_input(message, to_string(place_));
  }
  Token token = take(TokenKind::Text, literal->bytes);
  token.text = std::move(literal->value);
  return token;
}

Expected<Token> Lexer::name() {
  if (rest_.front() == '`') {
    const std::size_t end = rest_.find('`', 1);
    const std::size_t line_end = rest_.find('\n');
    if (end == std::string_view::npos || end == 1 || line_end < end) {
      return bad_input("expected a name between two backticks", to_string(place_));
    }
    Token token = take(TokenKind::Name, end + 1);
    token.text = token.text.substr(1, end - 1);
    token.quoted = true;
    return token;
  }
  std::size_t end = 0;
  while (end < rest_.size() && is_name_byte(rest_[end])) {
    const std::size_t length = character_length(rest_.substr(end));
    const std::string_view character = rest_.substr(end, length);
    if (is_typographic(character)) {
      advance(end);
      return bad_input("found the typographic character '" + std::string(character) +
                           "'; write a plain blank, dash or quote",
                       to_string(place_));
    }
    end += length;
  }
  return take(TokenKind::Name, end);
}

Expected<Token> Lexer::operation() {
  if (rest_.front() == '%') {
    const std::size_t end = rest_.find('%', 1);
    if (end == std::string_view::npos || rest_.find('\n') < end) {
      return bad_input("expected a second % on this line, as in %in%", to_string(place_));
    }
    return take(TokenKind::Operator, end + 1);
  }
  // Longest first. Some are not supported, and are here only so that messages show the whole
  // operator.
  constexpr std::array<std::string_view, 36> kOperators = {
      "<<-", "->>", ":::", "<-", "->", "<=", ">=", "==", "!=", "&&", "||", "|>",
      "::",  ":=",  "[[",  "+",  "-",  "*",  "/",  "^",  "<",  ">",  "!",  "&",
      "|",   ":",   "=",   "(",  ")",  ",",  ";",  "[",  "]",  "{",  "}",  "$"};
  for (const std::string_view op : kOperators) {
    if (rest_.substr(0, op.size()) == op) return take(TokenKind::Operator, op.size());
  }
  return bad_input("found '" + std::string(rest_.substr(0, character_length(rest_))) +
                       "', which does not belong here",
                   to_string(place_));
}

}  // namespace swarmsmith::r
