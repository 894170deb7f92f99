#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace swarmsmith::irace {

/// Where a program lies: a name without a slash is looked for in the folders of `search_path`
/// (separated by colons); what is not found there, or has a slash, is relative to `folder`.
std::filesystem::path find_program(std::string_view name, const std::filesystem::path& folder,
                                   std::string_view search_path);

/// What keeps a program from being run, with what to do; nothing when it can be.
std::optional<std::string> complaint_about_program(const std::filesystem::path& program);

}  // namespace swarmsmith::irace
