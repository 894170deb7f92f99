#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "irace_core/files/expression_text.h"
#include "irace_core/files/internal/parameter_line.h"
#include "irace_core/parameter_space.h"

namespace swarmsmith::irace {

/// Reads an expression in a file; `where` of errors and warnings is file:line:column.
Expected<Expression> read_expression(const Piece& piece, const std::string& file,
                                     std::span<const std::string> names, ExpressionUse use,
                                     std::vector<Error>& warnings);

/// Reads one line of the forbidden combinations; an expression that is only a value is an error.
Expected<Expression> read_forbidden_line(const Piece& piece, const std::string& file,
                                         std::span<const std::string> names,
                                         std::vector<Error>& warnings);

/// The two bounds of a numeric domain: expressions, which may be in quotes (irace facts, 23.2).
Expected<std::pair<Bound, Bound>> read_bounds(const Piece& domain, const std::string& file,
                                              std::span<const std::string> names,
                                              std::vector<Error>& warnings);

}  // namespace swarmsmith::irace
