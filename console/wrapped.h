#pragma once

#include <string>
#include <string_view>

namespace swarmsmith {

/// The usual width of a terminal, in columns.
inline constexpr std::size_t kPageWidth = 80;

/// Wraps the text so that no line is longer than `width`, if its words are short enough. Lines
/// without indentation form paragraphs, which are filled again. An indented line stays separate; it
/// continues two columns further to the right, or below its second column, or, if it is a command,
/// after a backslash. The first `first` columns of the first line are already used.
std::string wrapped(std::string_view text, std::size_t width = kPageWidth, std::size_t first = 0);

}  // namespace swarmsmith
