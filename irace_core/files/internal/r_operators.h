#pragma once

#include <optional>
#include <string_view>

#include "irace_core/expression.h"

namespace swarmsmith::irace {

/// How a binary operator or function of R is called and what it does. Operators have a binding.
struct Spelling {
  std::string_view text;
  Operation operation;
  int binding = 0;  ///< larger binds more tightly; 0 for functions
};

/// Bindings of operators that are not binary.
inline constexpr int kBindingOfNot = 3;
inline constexpr int kBindingOfSign = 9;
inline constexpr int kBindingOfPower = 10;
inline constexpr int kBindingOfComparison = 4;
inline constexpr int kBindingOfAtom = 11;

/// By what stands in a file; null for unknown ones. Some functions have two names.
const Spelling* find_operator(std::string_view text);
const Spelling* find_function(std::string_view text);
/// By what it does; null for Constant, Parameter, Not and Negate.
const Spelling* find_spelling(Operation operation);

/// All names of functions, for messages.
std::string_view function_names();

}  // namespace swarmsmith::irace
