#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace swarmsmith {

/// Texts of control software from other programs.

/// What is wrong with what stands before a controller's text: options, which would change what the
/// text means to the program that it was made for.
std::optional<std::string> complaint_about_name(std::string_view before);

/// What holds of all texts of this kind and cannot be checked; nothing of most.
std::optional<std::string> remark_about(std::string_view text);

}  // namespace swarmsmith
