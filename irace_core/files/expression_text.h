#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "irace_core/expression.h"
#include "irace_core/files/r_syntax.h"

namespace swarmsmith {

/// What an expression of irace's files is for.
enum class ExpressionUse {
  Value,      ///< && and || are errors, as in the conditions of irace 4
  Forbidden,  ///< && and || are read as & and |, with a warning; also conditions of irace 3.5
};

/// Reads an expression over the parameters `names` (irace facts, 8.2). T and F are TRUE and FALSE
/// unless a parameter is called so. A minus before a number makes a negative constant. Errors and
/// warnings: `where` is line:column, counted on from `start`; unknown names, operators and
/// functions, and what to write instead.
Expected<Expression> parse_expression(std::string_view text, std::span<const std::string> names,
                                      ExpressionUse use, r::Place start,
                                      std::vector<Error>& warnings);

/// The same for what is parsed already.
Expected<Expression> to_expression(const r::Node& node, std::span<const std::string> names,
                                   ExpressionUse use, std::vector<Error>& warnings);

/// R text that reads back as the same expression, where its names are known. The only trees that
/// cannot are a minus applied to a constant that is not negative, which reads back as the negative
/// constant, and constants of text with zero bytes in them.
std::string print(const Expression& expression);

}  // namespace swarmsmith
