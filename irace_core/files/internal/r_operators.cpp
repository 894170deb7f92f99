#include "irace_core/files/internal/r_operators.h"

#include <algorithm>
#include <array>

namespace swarmsmith::irace {
namespace {

constexpr std::array<Spelling, 16> kOperators = {{
    {"|", Operation::Or, 1},
    {"&", Operation::And, 2},
    {"==", Operation::Equal, kBindingOfComparison},
    {"!=", Operation::NotEqual, kBindingOfComparison},
    {"<", Operation::Less, kBindingOfComparison},
    {"<=", Operation::LessEqual, kBindingOfComparison},
    {">", Operation::Greater, kBindingOfComparison},
    {">=", Operation::GreaterEqual, kBindingOfComparison},
    {"+", Operation::Add, 5},
    {"-", Operation::Subtract, 5},
    {"*", Operation::Multiply, 6},
    {"/", Operation::Divide, 6},
    {"%in%", Operation::In, 7},
    {"%%", Operation::Modulo, 7},
    {"%/%", Operation::IntegerDivide, 7},
    {":", Operation::Range, 8},
}};
constexpr Spelling kPower = {"^", Operation::Power, kBindingOfPower};

constexpr std::array<Spelling, 18> kFunctions = {{
    {"c", Operation::Combine},
    {"as.numeric", Operation::AsNumeric},
    {"as.double", Operation::AsNumeric},
    {"as.integer", Operation::AsInteger},
    {"as.character", Operation::AsText},
    {"is.na", Operation::IsMissing},
    {"min", Operation::Min},
    {"max", Operation::Max},
    {"round", Operation::Round},
    {"floor", Operation::Floor},
    {"ceiling", Operation::Ceiling},
    {"trunc", Operation::Truncate},
    {"abs", Operation::Abs},
    {"sqrt", Operation::SquareRoot},
    {"exp", Operation::Exp},
    {"log", Operation::Log},
    {"ifelse", Operation::IfElse},
    {"xor", Operation::Xor},
}};

template <class Range, class Predicate>
const Spelling* find(const Range& spellings, Predicate predicate) {
  const auto found = std::find_if(spellings.begin(), spellings.end(), predicate);
  return found == spellings.end() ? nullptr : &*found;
}

}  // namespace

const Spelling* find_operator(std::string_view text) {
  if (text == kPower.text) return &kPower;
  return find(kOperators, [text](const Spelling& one) { return one.text == text; });
}

const Spelling* find_function(std::string_view text) {
  return find(kFunctions, [text](const Spelling& one) { return one.text == text; });
}

const Spelling* find_spelling(Operation operation) {
  if (operation == kPower.operation) return &kPower;
  const auto does = [operation](const Spelling& one) { return one.operation == operation; };
  const Spelling* found = find(kOperators, does);
  return found != nullptr ? found : find(kFunctions, does);
}

std::string_view function_names() {
  return "c as.numeric as.integer as.character is.na min max round floor ceiling trunc abs sqrt "
         "exp log ifelse xor";
}

}  // namespace swarmsmith::irace
