#include "sim/control/internal/fields.h"

#include <algorithm>

namespace swarmsmith {
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// Splits the name of the switch: letters, then nothing, a state, or a state and a transition with
/// the separator between them.
bool split_name(Field& field, Between between) {
  std::string_view rest = field.name.text;
  if (!rest.starts_with("--")) return false;
  rest.remove_prefix(2);
  const std::size_t digits = rest.find_first_of("0123456789");
  field.stem = rest.substr(0, digits);
  if (field.stem.empty()) return false;
  if (digits == std::string_view::npos) return true;
  rest.remove_prefix(digits);
  if (between == Between::Nothing) {
    return rest.size() <= 2 && read_number(rest.substr(0, 1), field.state) &&
           (rest.size() == 1 || read_number(rest.substr(1), field.transition));
  }
  const std::size_t cross = rest.find('x');
  if (!read_number(rest.substr(0, cross), field.state)) return false;
  if (cross == std::string_view::npos) return true;
  return read_number(rest.substr(cross + 1), field.transition);
}

}  // namespace

Error error_at(const Token& token, std::string message) {
  return {ErrorKind::BadInput, std::move(message),
          "token " + std::to_string(token.number) + ", column " + std::to_string(token.column)};
}

std::string quoted(std::string_view text) {
  return std::string("`").append(text).append("`");
}

Error expected_error(std::string_view name, const Token& found) {
  return error_at(found, "expected " + quoted(name) +
                             (found.text.empty() ? "" : ", found " + quoted(found.text)));
}

std::vector<Token> tokens_of(std::string_view text) {
  std::vector<Token> tokens;
  std::size_t at = 0;
  while (true) {
    while (at < text.size() && is_space(text[at]))
      ++at;
    std::size_t end = at;
    while (end < text.size() && !is_space(text[end]))
      ++end;
    tokens.push_back({text.substr(at, end - at), tokens.size() + 1, at + 1});
    if (at == end) return tokens;
    at = end;
  }
}

Expected<std::vector<Field>> fields_of(std::span<const Token> tokens, Between between) {
  std::vector<Field> fields;
  for (std::size_t i = 0; i + 1 < tokens.size(); i += 2) {
    Field field{.name = tokens[i], .value = tokens[i + 1], .stem = {}};
    if (!split_name(field, between)) {
      return Unexpected(
          error_at(tokens[i], "expected a switch such as `--s0`, found " + quoted(tokens[i].text)));
    }
    if (field.value.text.empty() || field.value.text.starts_with("--")) {
      return Unexpected(error_at(field.value, quoted(field.name.text) + " has no value"));
    }
    fields.push_back(field);
  }
  return fields;
}

Expected<int> integer_of(const Field& field) {
  int number = 0;
  if (read_number(field.value.text, number)) return number;
  return Unexpected(error_at(field.value, quoted(field.name.text) + " must be an integer, not " +
                                              quoted(field.value.text)));
}

Expected<int> integer_of(const Field& field, int low, int high) {
  Expected<int> number = integer_of(field);
  if (!number || (low <= *number && *number <= high)) return number;
  return Unexpected(error_at(field.value, quoted(field.name.text) + " must be from " +
                                              std::to_string(low) + " to " + std::to_string(high) +
                                              ", not " + std::to_string(*number)));
}

std::optional<Error> Block::add(const Field& field) {
  for (const Field& known : fields_) {
    if (known.stem == field.stem) {
      return error_at(field.name, quoted(field.name.text) + " appears twice");
    }
  }
  fields_.push_back(field);
  return std::nullopt;
}

std::optional<Field> Block::take(std::string_view stem) {
  const auto found = std::find_if(fields_.begin(), fields_.end(),
                                  [stem](const Field& field) { return field.stem == stem; });
  if (found == fields_.end()) return std::nullopt;
  const Field field = *found;
  fields_.erase(found);
  return field;
}

Expected<Field> Block::need(std::string_view stem) {
  if (const std::optional<Field> field = take(stem)) return *field;
  const std::string name = std::string("--").append(stem).append(suffix_);
  return Unexpected(error_at(end_, "expected " + quoted(name) + " before this place"));
}

std::optional<Error> Block::check_empty(std::string_view owner) const {
  if (fields_.empty()) return std::nullopt;
  const Token& name = fields_.front().name;
  return error_at(name, quoted(name.text) + " does not belong to " + std::string(owner));
}

}  // namespace swarmsmith
