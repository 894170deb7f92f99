#pragma once

#include <string>
#include <string_view>

namespace swarmsmith {

/// A byte within a character of several.
constexpr bool is_continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U;
}

/// The text with everything that is not UTF-8, or controls a terminal, as \xNN. Tabs and line ends
/// stay.
std::string as_utf8(std::string_view text);

}  // namespace swarmsmith
