#pragma once

#include <string>
#include <string_view>

namespace swarmsmith::cli {

/// What docs/storage.md says of the public schema; empty where it says nothing.

/// "one row a campaign".
std::string text_of_view(std::string_view view);
std::string text_of_column(std::string_view view, std::string_view column);

}  // namespace swarmsmith::cli
