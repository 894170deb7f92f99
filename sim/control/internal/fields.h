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

/// The text of a machine as words and as switches with values, before it means anything.

/// A word of the text; number and column count from 1.
struct Token {
  std::string_view text;
  std::size_t number = 0;
  std::size_t column = 0;
};

/// A switch with its value, the switch taken apart: --p0x3 is stem p, state 0, transition 3; what
/// the switch lacks is -1. In trees --p03 is the same: child 3 of subtree 0.
struct Field {
  Token name;
  Token value;
  std::string_view stem;
  int state = -1;
  int transition = -1;
};

/// An error whose place is the token's.
Error error_at(const Token& token, std::string message);

std::string quoted(std::string_view text);

/// "expected `--s0`, found `--robots`", at the found word, which may be the one of the end.
Error expected_error(std::string_view name, const Token& found);

/// The words, and an empty one that stands for the end of the text.
std::vector<Token> tokens_of(std::string_view text);

/// What stands between the two numbers of a switch: an x in machines, nothing in trees.
enum class Between { Cross, Nothing };

/// Pairs the words up; `tokens` ends with the one of the end.
Expected<std::vector<Field>> fields_of(std::span<const Token> tokens,
                                       Between between = Between::Cross);

/// Reads a whole word as a number, whatever the locale; false when it is none.
template <class Number>
bool read_number(std::string_view text, Number& number) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end;
}

/// The value as an integer, in the second form from `low` to `high`.
Expected<int> integer_of(const Field& field);
Expected<int> integer_of(const Field& field, int low, int high);

/// The fields of one state or transition, to be taken out by name. No stem is in it twice.
class Block {
 public:
  /// `suffix`: 0 of --s0, 0x1 of --n0x1; `end`: the token behind the block.
  Block(std::string suffix, const Token& end) : suffix_(std::move(suffix)), end_(end) {}

  const std::string& suffix() const { return suffix_; }
  const Token& end() const { return end_; }
  void end_at(const Token& end) { end_ = end; }

  std::optional<Error> add(const Field& field);
  std::optional<Field> take(std::string_view stem);
  /// Takes a field that must be there.
  Expected<Field> need(std::string_view stem);
  /// Complains about a field that was not taken; `owner` is the module that has no use for it.
  std::optional<Error> check_empty(std::string_view owner) const;

 private:
  std::string suffix_;
  Token end_;
  std::vector<Field> fields_;
};

}  // namespace swarmsmith
