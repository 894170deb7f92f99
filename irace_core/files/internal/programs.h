#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace swarmsmith::irace {

/// The path of a program: a name without a slash is searched for in the folders of `search_path`
/// (separated by colons); if it is not found there, or has a slash, it is relative to `folder`.
std::filesystem::path find_program(std::string_view name, const std::filesystem::path& folder,
                                   std::string_view search_path);

/// The reason why a program cannot be run, and what to do; nothing if it can be run.
std::optional<std::string> complaint_about_program(const std::filesystem::path& program);

}  // namespace swarmsmith::irace
