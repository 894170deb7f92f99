#pragma once

#include <charconv>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// The text of a machine split into words, and into switches with values, before it is interpreted.

/// A word of the text; its number and column are counted from 1.
struct Token {
  std::string_view text;
  std::size_t number = 0;
  std::size_t column = 0;
};

/// A switch with its value. The switch is split: --p0x3 has stem p, state 0, transition 3; missing
/// parts are -1. In trees --p03 has the same parts: child 3 of subtree 0.
struct Field {
  Token name;
  Token value;
  std::string_view stem;
  int state = -1;
  int transition = -1;
};

/// An error located at the token.
Error error_at(const Token& token, std::string message);

std::string quoted(std::string_view text);

/// The error "expected `--s0`, found `--robots`", located at the word found, which may be the end
/// token.
Error expected_error(std::string_view name, const Token& found);

/// The words of the text, followed by an empty token that marks its end.
std::vector<Token> tokens_of(std::string_view text);

/// The separator of the two numbers of a switch: an x in machines, nothing in trees.
enum class Between { Cross, Nothing };

/// Groups the words into switches with values; `tokens` ends with the end token.
Expected<std::vector<Field>> fields_of(std::span<const Token> tokens,
                                       Between between = Between::Cross);

/// Reads the whole text as a number, whatever the locale; false if it is not a number.
template <class Number>
bool read_number(std::string_view text, Number& number) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end;
}

/// The value as an integer; the second form requires it to be in [low, high].
Expected<int> integer_of(const Field& field);
Expected<int> integer_of(const Field& field, int low, int high);

/// The fields of one state or transition, which are taken out by name. Each stem occurs at most
/// once.
class Block {
 public:
  /// `suffix`: 0 of --s0, 0x1 of --n0x1; `end`: the token after the block.
  Block(std::string suffix, const Token& end) : suffix_(std::move(suffix)), end_(end) {}

  const std::string& suffix() const { return suffix_; }
  const Token& end() const { return end_; }
  void end_at(const Token& end) { end_ = end; }

  std::optional<Error> add(const Field& field);
  std::optional<Field> take(std::string_view stem);
  /// Takes out a field that must be present.
  Expected<Field> need(std::string_view stem);
  /// The error about a field that was not taken; `owner` is the module that does not use it.
  std::optional<Error> check_empty(std::string_view owner) const;

 private:
  std::string suffix_;
  Token end_;
  std::vector<Field> fields_;
};

}  // namespace swarmsmith
