#include "irace_core/files/expression_text.h"
#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {

/// An expression that is read reads back from what is printed, and its value is the same.
void run(std::string_view input) {
  const std::vector<std::string> names = {"a", "b", "NumStates", "T", "x.1"};
  const std::vector<Scalar> values = {Scalar::of_text("1"), Scalar::integer(5), Scalar::real(0.5),
                                      Scalar::missing_of(Scalar::Type::Text), Scalar::real(1e5)};
  for (const ExpressionUse use : {ExpressionUse::Value, ExpressionUse::Forbidden}) {
    std::vector<Error> warnings;
    auto expression = parse_expression(input, names, use, {}, warnings);
    if (!expression) continue;
    const std::string text = print(*expression);
    auto again = parse_expression(text, names, ExpressionUse::Value, {}, warnings);
    require(again.has_value(), "what is printed can be read: " + text);
    require(*again == *expression, "what is printed reads back as the same: " + text);
    require(expression->bind(names) && again->bind(names), "all names are known");
    const Values one = expression->evaluate(values);
    const Values other = again->evaluate(values);
    require(one.size() == other.size() && one[0] == other[0], "equal trees have equal values");
  }
}

}  // namespace swarmsmith::fuzz
