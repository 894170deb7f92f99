#pragma once

#include <string>
#include <string_view>

namespace swarmsmith {

/// Columns of a terminal of the usual width.
inline constexpr std::size_t kPageWidth = 80;

/// The text with no line longer than `width`, where words allow it. Lines that begin at the margin
/// are a paragraph with those after them, and are filled anew; a line that is indented stays on its
/// own, and goes on two columns further in, below its second column, or, when it is a command,
/// behind a backslash. `first` columns of the first line are taken.
std::string wrapped(std::string_view text, std::size_t width = kPageWidth, std::size_t first = 0);

}  // namespace swarmsmith
