#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace swarmsmith {

/// What a file seems to be that was given in place of machines, with what to do instead: "a picture
/// (PNG)". Looks at how it begins; nothing of what may be machines.
std::optional<std::string> foreign_kind(std::string_view bytes);

}  // namespace swarmsmith
