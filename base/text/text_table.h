#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace swarmsmith {

/// Number of terminal columns that the text needs: its characters, assuming that none of them is
/// wide.
std::size_t width_of(std::string_view text);

enum class Align { Left, Right };

/// The text, filled up with blanks to `width` columns; a longer text is not changed.
std::string padded(std::string_view text, std::size_t width, Align align);

/// Rows with the same number of texts, with two blanks between columns.
struct TextTable {
  std::vector<Align> aligns;  ///< alignment of each column; Right for missing ones
  std::vector<std::vector<std::string>> rows;
  std::size_t widest = 200;  ///< texts are aligned only up to this column, so that one long text
                             ///< does not widen every row
};

/// One line for each row, without trailing blanks. Control characters are escaped, including line
/// ends and tabs (base/shown_text.h).
std::string aligned(TextTable table);
/// Writes the same to a stream. Each row is freed after it has been written.
void write_aligned(std::ostream& out, TextTable table);

}  // namespace swarmsmith
