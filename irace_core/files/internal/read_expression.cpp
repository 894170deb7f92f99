#include "irace_core/files/internal/read_expression.h"

namespace swarmsmith::irace {
namespace {

/// Calls `run`, and puts the file's name before the places of its errors and warnings.
template <class Run>
Expected<Expression> with_file(const std::string& file, std::vector<Error>& warnings, Run run) {
  std::vector<Error> found;
  auto expression = run(found);
  for (Error& warning : found)
    warnings.push_back(in_file(std::move(warning), file));
  if (!expression) return Unexpected(in_file(std::move(expression.error()), file));
  return expression;
}

/// Whether an expression can be true or false: a comparison, or a combination of comparisons.
bool is_statement(const Expression& expression) {
  const Operation operation = expression.operation();
  return (operation >= Operation::Not && operation <= Operation::In) ||
         operation == Operation::IsMissing || operation == Operation::IfElse;
}

/// Evaluates a constant expression immediately, so that equivalent spaces compare equal.
Bound to_bound(Expression expression) {
  if (expression.operation() == Operation::Constant) {
    if (const std::optional<double> value = expression.to_number({})) return *value;
  }
  return expression;
}

}  // namespace

Expected<Expression> read_expression(const Piece& piece, const std::string& file,
                                     std::span<const std::string> names, ExpressionUse use,
                                     std::vector<Error>& warnings) {
  return with_file(file, warnings, [&](std::vector<Error>& found) {
    return parse_expression(piece.text, names, use, piece.place, found);
  });
}

Expected<Expression> read_forbidden_line(const Piece& piece, const std::string& file,
                                         std::span<const std::string> names,
                                         std::vector<Error>& warnings) {
  auto clause = read_expression(piece, file, names, ExpressionUse::Forbidden, warnings);
  if (!clause || is_statement(*clause)) return clause;
  return bad_input(
      "a value alone forbids everything or nothing; write a comparison, such as algorithm == "
      "\"as\"",
      file + ":" + r::to_string(piece.place));
}

Expected<std::pair<Bound, Bound>> read_bounds(const Piece& domain, const std::string& file,
                                              std::span<const std::string> names,
                                              std::vector<Error>& warnings) {
  constexpr std::size_t kAdded = 2;  // characters added before the domain's first one
  const r::Place start{domain.place.line, domain.place.column - kAdded};
  auto list = r::parse_expression("c(" + domain.text + ")", start);
  if (!list) return Unexpected(in_file(std::move(list.error()), file));
  const auto* call = std::get_if<r::Call>(&list->what);
  const std::size_t found = call == nullptr ? 0 : call->arguments.size();
  if (call == nullptr || call->function != "c" || found != 2) {
    return bad_input("expected two bounds with a comma between them, found " +
                         std::to_string(found) + " in (" + domain.text + ")",
                     file + ":" + r::to_string(domain.place));
  }
  std::vector<Bound> bounds;
  for (const r::Argument& argument : call->arguments) {
    auto bound = with_file(file, warnings, [&](std::vector<Error>& warned) {
      const auto* text = std::get_if<r::Text>(&argument.value.what);
      if (text == nullptr) {
        return to_expression(argument.value, names, ExpressionUse::Value, warned);
      }
      const r::Place inside{argument.value.place.line, argument.value.place.column + 1};
      return parse_expression(text->value, names, ExpressionUse::Value, inside, warned);
    });
    if (!bound) return Unexpected(bound.error());
    bounds.push_back(to_bound(std::move(*bound)));
  }
  return std::pair{std::move(bounds[0]), std::move(bounds[1])};
}

}  // namespace swarmsmith::irace
