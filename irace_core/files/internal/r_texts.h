#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "irace_core/files/internal/r_values.h"

namespace swarmsmith::r {

/// Limits on the values that a file's expressions can make, so that a few lines cannot fill the
/// memory.
inline constexpr std::size_t kLongestVector = 100'000;
inline constexpr std::size_t kLongestText = 1'000'000;  // for all elements together

/// An argument with its value.
struct Part {
  std::string name;
  Vector value;
};

/// An error at the place of a node.
Unexpected wrong(const Node& node, std::string message);

/// paste, paste0 and file.path: joins the elements of the parts side by side; shorter parts are
/// repeated, and empty ones are ignored. The argument `separator_name` (none, if that is empty) may
/// replace the separator; `collapse` joins all elements into one.
Expected<Vector> paste(const Node& node, std::vector<Part> parts, std::string_view separator_name,
                       std::optional<std::string> separator);

/// Sys.getenv("NAME", unset = ""), with one name.
Expected<Vector> environment_variable(const Node& node, std::vector<Part> parts,
                                      const Environment& environment);

}  // namespace swarmsmith::r
