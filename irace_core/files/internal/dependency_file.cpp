#include "irace_core/files/internal/dependency_file.h"

#include <algorithm>

#include "base/suggestion.h"
#include "irace_core/files/internal/read_expression.h"

namespace swarmsmith::irace {
namespace {

/// One side of the bar, without its quotes if it has any.
Piece side(LineReader line, std::size_t bytes) {
  const std::string_view text = trimmed(line.rest().substr(0, bytes));
  line.skip_blanks();
  Piece piece{std::string(text), line.place()};
  if (text.size() > 1 && text.front() == '"' && text.back() == '"') {
    piece.text = std::string(text.substr(1, text.size() - 2));
    ++piece.place.column;
  }
  return piece;
}

Expected<void> replace(Bound& bound, const Piece& piece, const std::string& file,
                       std::span<const std::string> names, std::vector<Error>& warnings) {
  if (piece.text.empty()) return {};
  auto expression = read_expression(piece, file, names, ExpressionUse::Value, warnings);
  if (!expression) return Unexpected(expression.error());
  bound = std::move(*expression);
  return {};
}

/// `line` must be positioned before the name.
Expected<void> apply_line(LineReader line, const std::string& file,
                          std::vector<Parameter>& parameters, std::span<const std::string> names,
                          std::vector<Error>& warnings) {
  const std::string where = line.where();
  const std::string name(line.take_name());
  line.skip_blanks();
  const std::string_view rest = line.rest().substr(0, line.rest().find('#'));
  const std::size_t bar = rest.find('|');
  const std::size_t close = rest.rfind(')');
  if (name.empty() || rest.empty() || rest[0] != '(' || bar == std::string_view::npos ||
      close == std::string_view::npos || close < bar || !trimmed(rest.substr(close + 1)).empty()) {
    return bad_input("expected a line 'name (lower|upper)', found \"" +
                         (name + " ").append(trimmed(line.rest())) + "\"",
                     where);
  }
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    return bad_input("there is no parameter '" + name + "'" + did_you_mean(name, names), where);
  }
  line.advance(1);
  LineReader behind_bar = line;
  behind_bar.advance(bar);
  const Piece lower = side(line, bar - 1);
  const Piece upper = side(behind_bar, close - bar - 1);
  Domain& domain = parameters[static_cast<std::size_t>(found - names.begin())].domain;
  const auto replace_both = [&](auto& numeric) -> Expected<void> {
    if (auto put = replace(numeric.lower, lower, file, names, warnings); !put) return put;
    return replace(numeric.upper, upper, file, names, warnings);
  };
  if (auto* whole = std::get_if<Integer>(&domain)) return replace_both(*whole);
  if (auto* real = std::get_if<Real>(&domain)) return replace_both(*real);
  return bad_input("'" + name + "' has no bounds: it is not numeric", where);
}

}  // namespace

Expected<void> apply_dependency_file(const IraceText& source, std::vector<Parameter>& parameters,
                                     std::vector<Error>& warnings) {
  std::vector<std::string> names;
  names.reserve(parameters.size());
  for (const Parameter& parameter : parameters)
    names.push_back(parameter.name);
  std::size_t number = 0;
  for (const std::string_view text : split_lines(source.text)) {
    LineReader line(source.file, text, ++number);
    if (line.at_comment_or_end()) continue;
    auto applied = apply_line(line, source.file, parameters, names, warnings);
    if (!applied) return applied;
  }
  return {};
}

}  // namespace swarmsmith::irace
