#include "irace_core/files/internal/r_texts.h"

#include <algorithm>
#include <utility>

namespace swarmsmith::r {
namespace {

/// Removes the named argument from the list and returns its value.
std::optional<Vector> take(std::vector<Part>& parts, std::string_view name) {
  const auto part = std::ranges::find(parts, name, &Part::name);
  if (part == parts.end()) return std::nullopt;
  Vector value = std::move(part->value);
  parts.erase(part);
  return value;
}

/// The separator: `initial` if the argument is missing, or cannot be given because it has no name;
/// nothing for NULL.
Expected<std::optional<std::string>> take_separator(const Node& node, std::vector<Part>& parts,
                                                    std::string_view name,
                                                    std::optional<std::string> initial) {
  if (name.empty()) return initial;
  const std::optional<Vector> value = take(parts, name);
  if (!value) return initial;
  if (value->empty()) return std::optional<std::string>{};
  if (value->size() != 1 || value->front().missing || value->front().type != Scalar::Type::Text) {
    return wrong(node, "`" + std::string(name) + "` must be a text");
  }
  return std::optional(value->front().text);
}

}  // namespace

Unexpected wrong(const Node& node, std::string message) {
  return bad_input(std::move(message), to_string(node.place));
}

Expected<Vector> paste(const Node& node, std::vector<Part> parts, std::string_view separator_name,
                       std::optional<std::string> separator) {
  const auto between = take_separator(node, parts, separator_name, std::move(separator));
  if (!between) return Unexpected(between.error());
  const auto collapse = take_separator(node, parts, "collapse", std::nullopt);
  if (!collapse) return Unexpected(collapse.error());
  std::vector<std::vector<std::string>> columns;
  std::size_t rows = 0;
  for (const Part& part : parts) {
    if (!part.name.empty()) return wrong(node, "has no argument `" + part.name + "`");
    if (part.value.empty()) continue;
    columns.push_back(to_texts(part.value));
    rows = std::max(rows, part.value.size());
  }
  std::vector<std::string> lines(rows);
  std::size_t length = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns.size(); ++column) {
      if (column > 0) lines[row] += between->value_or("");
      lines[row] += columns[column][row % columns[column].size()];
    }
    length += lines[row].size();
    if (length > kLongestText) return wrong(node, "makes too long a text");
  }
  if (*collapse) {
    std::string whole;
    if (length + rows * (*collapse)->size() > kLongestText) {
      return wrong(node, "makes too long a text");
    }
    for (std::size_t row = 0; row < rows; ++row)
      whole += (row > 0 ? **collapse : "") + lines[row];
    return Vector{Scalar::of_text(std::move(whole))};
  }
  Vector result;
  for (std::string& line : lines)
    result.push_back(Scalar::of_text(std::move(line)));
  return result;
}

Expected<Vector> environment_variable(const Node& node, std::vector<Part> parts,
                                      const Environment& environment) {
  const std::optional<Vector> named = take(parts, "unset");
  Vector unset = named.value_or(Vector{Scalar::of_text("")});
  if (const auto name = take(parts, "x")) parts.insert(parts.begin(), Part{{}, *name});
  if (parts.size() == 2 && !named) {
    unset = parts[1].value;
    parts.pop_back();
  }
  const bool is_one_text = parts.size() == 1 && parts[0].name.empty() &&
                           parts[0].value.size() == 1 && !parts[0].value[0].missing &&
                           parts[0].value[0].type == Scalar::Type::Text;
  if (!is_one_text) return wrong(node, "Sys.getenv needs the name of one variable, in quotes");
  if (auto value = environment.environment_variable(parts[0].value[0].text)) {
    return Vector{Scalar::of_text(std::move(*value))};
  }
  return unset;
}

}  // namespace swarmsmith::r
