#include "irace_core/files/internal/table.h"

#include "irace_core/files/internal/line_reader.h"

namespace swarmsmith::irace {
namespace {

bool is_quote(char c) {
  return c == '"' || c == '\'';
}

/// `line` must be positioned before the opening quote, and is moved past the closing one.
Expected<std::string> read_quoted(LineReader& line) {
  const std::string_view rest = line.rest();
  const char quote = rest[0];
  std::string text;
  std::size_t i = 1;
  for (; i < rest.size() && rest[i] != quote; ++i) {
    if (rest[i] == '\\' && i + 1 < rest.size() && rest[i + 1] == quote) ++i;
    text += rest[i];
  }
  if (i == rest.size()) return line.expected(std::string("a closing quote ") + quote);
  line.advance(i + 1);
  return text;
}

std::string read_unquoted(LineReader& line) {
  const std::string_view rest = line.rest();
  std::size_t end = 0;
  while (end < rest.size() && !is_blank(rest[end]) && rest[end] != '#')
    ++end;
  line.advance(end);
  return std::string(rest.substr(0, end));
}

Expected<std::vector<Cell>> read_row(LineReader line) {
  std::vector<Cell> cells;
  while (!line.at_comment_or_end()) {
    Cell cell{{}, is_quote(line.rest().front()), line.place()};
    if (cell.quoted) {
      auto text = read_quoted(line);
      if (!text) return Unexpected(text.error());
      cell.text = std::move(*text);
    } else {
      cell.text = read_unquoted(line);
    }
    cells.push_back(std::move(cell));
  }
  return cells;
}

/// Whether `text` between two of these quotes is read back unchanged.
bool fits(const std::string& text, char quote) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool before_quote = i + 1 == text.size() || text[i + 1] == quote;
    if (text[i] == '\\' && before_quote) return false;
  }
  return true;
}

}  // namespace

Expected<std::vector<std::vector<Cell>>> read_table(const IraceText& source) {
  std::vector<std::vector<Cell>> rows;
  std::size_t number = 0;
  for (const std::string_view text : split_lines(source.text)) {
    auto row = read_row(LineReader(source.file, text, ++number));
    if (!row) return Unexpected(row.error());
    if (!row->empty()) rows.push_back(std::move(*row));
  }
  return rows;
}

Expected<std::string> print_field(const std::string& text) {
  if (text.find_first_of("\n\r") == std::string::npos) {
    const bool plain = !text.empty() && !is_quote(text[0]) && text != "NA" && text != "<NA>" &&
                       text.find_first_of(" \t\f\v#") == std::string::npos;
    if (plain) return text;
    for (const char quote : {'"', '\''}) {
      if (!fits(text, quote)) continue;
      std::string field(1, quote);
      for (const char c : text) {
        if (c == quote) field += '\\';
        field += c;
      }
      return field + quote;
    }
  }
  return bad_input("a table of configurations cannot hold the value '" + text + "'");
}

}  // namespace swarmsmith::irace
