#include "sim/mission/scores/compiled_formula.h"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/math.h"
#include "base/suggestion.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kMostCharacters = 1000;

double least_of(const double* values, int count) {
  return *std::min_element(values, values + count);
}
double most_of(const double* values, int count) {
  return *std::max_element(values, values + count);
}

/// Replaces the library's own functions: those of the C library give other bits on other computers.
void define_functions(mu::Parser& parser) {
  parser.ClearFun();
  parser.ClearConst();
  parser.DefineConst("pi", kPi);
  parser.DefineInfixOprt("!", [](double x) { return x == 0 ? 1.0 : 0.0; });
  parser.DefineFun("abs", [](double x) { return std::fabs(x); });
  parser.DefineFun("sqrt", [](double x) { return std::sqrt(x); });
  parser.DefineFun("floor", [](double x) { return std::floor(x); });
  parser.DefineFun("exp", [](double x) { return exp(x); });
  parser.DefineFun("log", [](double x) { return log(x); });
  parser.DefineFun("sin", [](double x) { return sin(x); });
  parser.DefineFun("cos", [](double x) { return cos(x); });
  parser.DefineFun("hypot", [](double x, double y) { return hypot(x, y); });
  parser.DefineFun("pow", [](double x, double y) { return pow(x, y); });
  parser.DefineFun("atan2", [](double y, double x) { return atan2(y, x); });
  parser.DefineFun("min", least_of);
  parser.DefineFun("max", most_of);
}

/// Finds signs that the library accepts but formulas do not have: `^` (it would give the C
/// library's bits), and signs that give no value or several values.
std::optional<std::string> forbidden_sign(const std::string& text) {
  const auto at = [](std::size_t position) { return fmt::format("at character {}", position + 1); };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char sign = text[i];
    if (sign == '^') return at(i) + ": there is no `^`; write x * x, or pow(x, 3)";
    if (sign == '"' || sign == ';') return at(i) + fmt::format(": `{}` is not allowed here", sign);
    if (sign == '=') {
      const bool compares =
          (i > 0 && std::string_view("=<>!").find(text[i - 1]) != std::string_view::npos) ||
          (i + 1 < text.size() && text[i + 1] == '=');
      if (!compares) return at(i) + ": `=` is not allowed; use `==` to compare";
    }
  }
  return std::nullopt;
}

constexpr std::array<std::string_view, 12> kFunctions = {
    "abs", "sqrt", "min", "max", "floor", "hypot", "exp", "log", "pow", "sin", "cos", "atan2"};

/// The token that the library reports, without surrounding blanks.
std::string token_of(const mu::Parser::exception_type& error) {
  const std::string& token = error.GetToken();
  const std::size_t first = token.find_first_not_of(' ');
  if (first == std::string::npos) return "";
  return token.substr(first, token.find_last_not_of(' ') - first + 1);
}

std::string unknown_name(const std::string& token, std::span<const std::string_view> names) {
  std::vector<std::string> known(names.begin(), names.end());
  known.insert(known.end(), kFunctions.begin(), kFunctions.end());
  return fmt::format("there is no `{}`{}; names are {}; functions are {}", token,
                     did_you_mean(token, known), fmt::join(names, ", "),
                     fmt::join(kFunctions, ", "));
}

std::string message_of(const mu::Parser::exception_type& error,
                       std::span<const std::string_view> names) {
  const mu::EErrorCodes code = error.GetCode();
  if (code == mu::ecMISSING_PARENS) return "a `)` is missing";
  if (code == mu::ecUNEXPECTED_EOF) return "it ends too early";
  if (code == mu::ecEMPTY_EXPRESSION) return "it is empty";
  if (code == mu::ecMISSING_ELSE_CLAUSE) return "a `?` has no `:`";
  const std::string token = token_of(error);
  const std::string where = fmt::format("at character {}: ", error.GetPos() + 1);
  if (code == mu::ecUNASSIGNABLE_TOKEN) return where + unknown_name(token, names);
  if (code == mu::ecTOO_FEW_PARAMS) return where + fmt::format("`{}` needs more values", token);
  if (code == mu::ecTOO_MANY_PARAMS) return where + fmt::format("`{}` needs fewer values", token);
  if (error.GetPos() < 0 || token.empty()) return "it cannot be read";
  return where + fmt::format("`{}` is not allowed here", token);
}

}  // namespace

struct CompiledFormula::Compiled {
  std::string text;
  std::vector<std::string_view> names;  ///< refer to string literals
  std::vector<double> values;
  mu::Parser parser;

  /// Throws the library's exception, or std::invalid_argument.
  Compiled(std::string formula, std::span<const std::string_view> known)
      : text(std::move(formula)), names(known.begin(), known.end()), values(known.size()) {
    if (text.size() > kMostCharacters) {
      throw std::invalid_argument(fmt::format("it is longer than {} characters", kMostCharacters));
    }
    if (const auto sign = forbidden_sign(text)) throw std::invalid_argument(*sign);
    define_functions(parser);
    for (std::size_t i = 0; i < names.size(); ++i)
      parser.DefineVar(std::string(names[i]), &values[i]);
    parser.SetExpr(text);
    parser.Eval();
    if (parser.GetNumResults() != 1) throw std::invalid_argument("it has more than one value");
  }
};

CompiledFormula::CompiledFormula(std::string text, std::span<const std::string_view> names) {
  if (const auto what = fault(text, names)) throw std::invalid_argument(*what);
  compiled_ = std::make_unique<Compiled>(std::move(text), names);
}

CompiledFormula::CompiledFormula(const CompiledFormula& other)
    : compiled_(std::make_unique<Compiled>(other.compiled_->text, other.compiled_->names)) {}
CompiledFormula::CompiledFormula(CompiledFormula&& other) noexcept = default;
CompiledFormula& CompiledFormula::operator=(const CompiledFormula& other) {
  return *this = CompiledFormula(other);
}
CompiledFormula& CompiledFormula::operator=(CompiledFormula&& other) noexcept = default;
CompiledFormula::~CompiledFormula() = default;

std::optional<std::string> CompiledFormula::fault(const std::string& text,
                                                  std::span<const std::string_view> names) {
  try {
    const Compiled compiled(text, names);
  } catch (const mu::Parser::exception_type& error) {
    return message_of(error, names);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return std::nullopt;
}

bool CompiledFormula::uses(std::string_view name) const {
  return compiled_->parser.GetUsedVar().contains(std::string(name));
}

double CompiledFormula::operator()(std::span<const double> values) const {
  std::ranges::copy(values, compiled_->values.begin());
  return compiled_->parser.Eval();
}

}  // namespace swarmsmith
