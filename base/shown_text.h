#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace swarmsmith {

/// Texts from outside (names, hosts, output of programs, files) must not control the terminal:
/// characters that would do so, or would reverse a line, are replaced by readable escapes.

/// Length in bytes of the valid UTF-8 character at the beginning of the text (Unicode 15, table
/// 3-7); 0 when there is none. The text must not be empty.
std::size_t character_length(std::string_view text);

/// Whether the byte continues a character of several bytes.
constexpr bool is_continuation(char byte) {
  return (static_cast<unsigned char>(byte) & 0xc0U) == 0x80U;
}

/// The escape for the first character, whose length is given (0: not UTF-8): \n, \t, \u001b for a
/// control character (C0, DEL, C1), \u202e for one that breaks lines or changes the direction of
/// the text, \xff for a byte that is not UTF-8. Empty for a character that is shown unchanged.
std::string escape_of(std::string_view text, std::size_t length);

/// Whether line ends and tabs are kept, as in texts of several lines, or escaped, as in a name or a
/// cell.
enum class Layout { Kept, Escaped };

/// The text, with escapes for all characters that are not shown unchanged. A quoted text in JSON
/// stays JSON with the same value, if it was UTF-8.
std::string as_shown(std::string_view text, Layout layout = Layout::Kept);

}  // namespace swarmsmith
