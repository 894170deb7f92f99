#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace swarmsmith {

/// Columns of a terminal that the text takes: its characters, none of them a wide one.
std::size_t width_of(std::string_view text);

enum class Align { Left, Right };

/// The text on this side of `width` columns; a longer one stays as it is.
std::string padded(std::string_view text, std::size_t width, Align align);

/// Rows of as many texts as the first one has, two blanks between columns.
struct TextTable {
  std::vector<Align> aligns;  ///< where a column's texts stand; what is missing is Right
  std::vector<std::vector<std::string>> rows;
  std::size_t widest = 200;  ///< columns of texts are aligned up to here: one long text would widen
                             ///< each row
};

/// A line a row, without blanks at its end. Texts are shown with all but letters escaped
/// (base/shown_text.h).
std::string aligned(TextTable table);
/// The same to a stream. Each row is freed once it is written.
void write_aligned(std::ostream& out, TextTable table);

}  // namespace swarmsmith
