#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "irace_core/expression.h"
#include "irace_core/files/r_syntax.h"

namespace swarmsmith {

/// The context of an expression in irace's files.
enum class ExpressionUse {
  Value,      ///< && and || are errors, as in the conditions of irace 4
  Forbidden,  ///< && and || are read as & and |, with a warning; also for conditions of irace 3.5
};

/// Reads an expression over the parameters `names` (irace facts, 8.2). T and F are TRUE and FALSE
/// unless a parameter has that name. A minus before a number makes a negative constant. Unknown
/// names, operators and functions are errors, which suggest a replacement. In errors and warnings,
/// `where` is line:column, counted from `start`.
Expected<Expression> parse_expression(std::string_view text, std::span<const std::string> names,
                                      ExpressionUse use, r::Place start,
                                      std::vector<Error>& warnings);

/// The same for an expression that is already parsed.
Expected<Expression> to_expression(const r::Node& node, std::span<const std::string> names,
                                   ExpressionUse use, std::vector<Error>& warnings);

/// R text from which the same expression is read back, if the names are known. The only exceptions
/// are a minus applied to a constant that is not negative, which is read back as the negative
/// constant, and text constants with zero bytes.
std::string print(const Expression& expression);

}  // namespace swarmsmith
