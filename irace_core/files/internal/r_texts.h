#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "irace_core/files/internal/r_values.h"

namespace swarmsmith::r {

/// Limits of what a file's expressions may make, so that a few lines cannot fill the memory.
inline constexpr std::size_t kLongestVector = 100'000;
inline constexpr std::size_t kLongestText = 1'000'000;  // of all elements together

/// An argument with its value.
struct Part {
  std::string name;
  Vector value;
};

/// An error at a node.
Unexpected wrong(const Node& node, std::string message);

/// paste, paste0 and file.path: the parts' elements side by side, shorter parts repeated; empty
/// ones count for nothing. The argument called `separator_name` (none, when that is empty) may
/// replace the separator; `collapse` makes all elements one.
Expected<Vector> paste(const Node& node, std::vector<Part> parts, std::string_view separator_name,
                       std::optional<std::string> separator);

/// Sys.getenv("NAME", unset = ""), one name.
Expected<Vector> environment_variable(const Node& node, std::vector<Part> parts,
                                      const Environment& environment);

}  // namespace swarmsmith::r
