#pragma once

#include <string>
#include <string_view>

namespace swarmsmith::cli {

/// The description of the public schema in docs/storage.md; empty if there is none.

/// "one row a campaign".
std::string text_of_view(std::string_view view);
std::string text_of_column(std::string_view view, std::string_view column);

}  // namespace swarmsmith::cli
