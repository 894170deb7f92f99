#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace swarmsmith {

/// Texts of others (names, hosts, what programs print, files) are shown, never obeyed: what would
/// steer a terminal, or turn a line around, becomes an escape that people can read.

/// Bytes of the well-formed character of UTF-8 that begins the text (Unicode 15, table 3-7); 0 when
/// none does. The text is not empty.
std::size_t character_length(std::string_view text);

/// A byte within a character of several.
constexpr bool is_continuation(char byte) {
  return (static_cast<unsigned char>(byte) & 0xc0U) == 0x80U;
}

/// The escape in place of the first character, whose length is given (0: no UTF-8): \n, \t,
/// \u001b for a control character (C0, DEL, C1), \u202e for one that breaks lines or turns the
/// order of letters around, \xff for a byte that is not UTF-8. Empty for what is shown as it is.
std::string escape_of(std::string_view text, std::size_t length);

/// Whether line ends and tabs stay: they do in texts of several lines, not in a name or a cell.
enum class Layout { Kept, Escaped };

/// The text with escapes in place of everything that is not shown as it is. What stands in quotes
/// in JSON stays JSON with the same value, when it was UTF-8.
std::string as_shown(std::string_view text, Layout layout = Layout::Kept);

}  // namespace swarmsmith
