#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace swarmsmith {

/// Texts of control software made by other programs.

/// The error in the words before the text of a controller: options there would change the meaning
/// of the text for the program that made it.
std::optional<std::string> complaint_about_name(std::string_view before);

/// A remark that applies to all texts of this kind and cannot be checked; most kinds have none.
std::optional<std::string> remark_about(std::string_view text);

}  // namespace swarmsmith
