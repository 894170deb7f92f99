#include "base/text/text_table.h"

#include <algorithm>
#include <ostream>
#include <sstream>
#include <utility>

#include "base/shown_text.h"

namespace swarmsmith {

std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char letter) { return !is_continuation(letter); }));
}

std::string padded(std::string_view text, std::size_t width, Align align) {
  const std::size_t used = width_of(text);
  std::string line(width > used ? width - used : 0, ' ');
  return line.insert(align == Align::Left ? 0 : line.size(), text);
}

void write_aligned(std::ostream& out, TextTable table) {
  std::vector<std::size_t> widths(table.rows.front().size());
  for (std::vector<std::string>& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      row[i] = as_shown(row[i], Layout::Escaped);
      widths[i] = std::min(std::max(widths[i], width_of(row[i])), table.widest);
    }
  }
  table.aligns.resize(widths.size(), Align::Right);
  for (std::vector<std::string>& row : table.rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += (i == 0 ? "" : "  ") + padded(row[i], widths[i], table.aligns[i]);
    line.erase(line.find_last_not_of(' ') + 1);
    out << line << '\n';
    row = {};
  }
}

std::string aligned(TextTable table) {
  std::ostringstream text;
  write_aligned(text, std::move(table));
  return std::move(text).str();
}

}  // namespace swarmsmith
