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

/// A value of R in scenario files: a vector, empty for NULL. A list may mix types.
using Vector = std::vector<Scalar>;

/// The variables and surroundings that an expression can use.
struct Environment {
  std::map<std::string, Vector> variables;  ///< variables that were assigned before
  /// Returns the value of an environment variable; nothing if it is not set.
  std::function<std::optional<std::string>(const std::string& name)> environment_variable;
  std::filesystem::path folder{};  ///< R's working directory
  /// Returns the text of a file, for readLines.
  std::function<Expected<std::string>(const std::filesystem::path&)> read{};
};

/// The value of an expression. It may use constants, variables, the operators and functions of
/// conditions (irace facts, 8.2), paste, paste0, file.path, list and Sys.getenv (irace facts,
/// 23.1), and the functions of r_functions.h. Everything else in R is an error, whose place is
/// line:column.
Expected<Vector> evaluate(const Node& node, const Environment& environment);

/// The elements as texts, in the form of R's as.character.
std::vector<std::string> to_texts(const Vector& vector);

}  // namespace swarmsmith::r
