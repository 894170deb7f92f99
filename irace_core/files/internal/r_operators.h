#pragma once

#include <optional>
#include <string_view>

#include "irace_core/expression.h"

namespace swarmsmith::irace {

/// The name of a binary operator or function of R, and its operation. Operators have a binding.
struct Spelling {
  std::string_view text;
  Operation operation;
  int binding = 0;  ///< larger binds more tightly; 0 for functions
};

/// Bindings of other parts of expressions.
inline constexpr int kBindingOfNot = 3;
inline constexpr int kBindingOfSign = 9;
inline constexpr int kBindingOfPower = 10;
inline constexpr int kBindingOfComparison = 4;
inline constexpr int kBindingOfAtom = 11;

/// Finds an operator or function by its text in a file; null for unknown ones. Some functions have
/// two names.
const Spelling* find_operator(std::string_view text);
const Spelling* find_function(std::string_view text);
/// Finds the spelling of an operation; null for Constant, Parameter, Not and Negate.
const Spelling* find_spelling(Operation operation);

/// All names of functions, for messages.
std::string_view function_names();

}  // namespace swarmsmith::irace
