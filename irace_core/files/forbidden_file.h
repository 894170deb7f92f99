#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/expression.h"
#include "irace_core/files/irace_text.h"

namespace swarmsmith {

/// Reads irace 3.5's forbiddenFile: one expression per line; comments and blank lines are allowed
/// (irace facts, 23.5). `where` of errors and warnings is file:line:column.
Expected<std::vector<Expression>> parse_forbidden_file(const IraceText& source,
                                                       std::span<const std::string> names,
                                                       std::vector<Error>& warnings);

}  // namespace swarmsmith
