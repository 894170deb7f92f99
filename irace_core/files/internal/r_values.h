#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/expression.h"
#include "irace_core/files/r_syntax.h"

namespace swarmsmith::r {

/// A value of R as scenario files use them: a vector, empty for NULL. A list may mix types.
using Vector = std::vector<Scalar>;

/// What an expression can see.
struct Environment {
  std::map<std::string, Vector> variables;  ///< assigned before
  /// An environment variable's value; nothing when it is not set.
  std::function<std::optional<std::string>(const std::string& name)> environment_variable;
  std::filesystem::path folder{};  ///< R's working directory
  /// The text of a file, for readLines.
  std::function<Expected<std::string>(const std::filesystem::path&)> read{};
};

/// The value of an expression with constants, variables, the operators and functions of conditions
/// (irace facts, 8.2), paste, paste0, file.path, list and Sys.getenv (irace facts, 23.1), and those
/// of r_functions.h. What else there is in R is an error, whose place is line:column.
Expected<Vector> evaluate(const Node& node, const Environment& environment);

/// Each element as R's as.character writes it.
std::vector<std::string> to_texts(const Vector& vector);

}  // namespace swarmsmith::r
