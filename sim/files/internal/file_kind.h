#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace swarmsmith {

/// The kind of a file that was given instead of a machine file, with advice: "a picture (PNG)". It
/// looks at the beginning of the file; nothing if it may be a machine file.
std::optional<std::string> foreign_kind(std::string_view bytes);

}  // namespace swarmsmith
