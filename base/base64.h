#pragma once

#include <string>
#include <string_view>

#include "base/expected.h"

namespace swarmsmith {

/// Conversion of bytes to text and back (RFC 4648, with padding).
std::string base64_text(std::string_view bytes);
Expected<std::string> bytes_from_base64(std::string_view text);

}  // namespace swarmsmith
