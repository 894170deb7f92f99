#include "cli/output/query_output.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <string_view>
#include <utility>

#include "base/csv.h"
#include "base/shown_text.h"
#include "console/terminal.h"

namespace swarmsmith::cli {
namespace {

using Cell = StoreReader::Cell;
using Type = StoreReader::Cell::Type;

/// Bytes that begin a character, so that UTF-8 is padded right.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char letter) { return (letter & '\xc0') != '\x80'; }));
}

/// For people six significant digits of a real are enough.
std::string shown(const Cell& cell) {
  if (cell.type == Type::Null) return "-";
  if (cell.type != Type::Real) return as_shown(cell.text, Layout::Escaped);
  char buffer[32];
  const int size =
      std::snprintf(buffer, sizeof buffer, "%.6g", std::strtod(cell.text.c_str(), nullptr));
  return {buffer, static_cast<std::size_t>(size)};
}

/// Columns are aligned up to here: one long text would widen each row.
constexpr std::size_t kWidestColumn = 200;

/// Numbers stand on the right of their column.
bool is_number(const Cell& cell) {
  return cell.type == Type::Integer || cell.type == Type::Real;
}

/// Pads by characters, not bytes.
void append_padded(std::string& line, const std::string& text, std::size_t width, bool right) {
  const std::size_t used = width_of(text);
  const std::string padding(width > used ? width - used : 0, ' ');
  line += right ? padding + text : text + padding;
}

/// Numbers in full precision.
std::string json_value(const Cell& cell) {
  switch (cell.type) {
    case Type::Null:
      return "null";
    case Type::Integer:
      return cell.text;
    case Type::Real:
      return json_number(std::strtod(cell.text.c_str(), nullptr));
    case Type::Text:
      break;
  }
  return json_text(cell.text);
}

char letter_of(const std::string& column) {
  if (column == "design") return 'd';
  if (column == "candidate" || column == "parent" || column == "best_candidate") return 'c';
  return '\0';
}

}  // namespace

Expected<Rows> select(StoreReader& store, const std::string& sql,
                      const StoreReader::QueryLimits& limits) {
  Rows rows;
  const auto end = store.query(
      sql, limits, [&](const std::vector<std::string>& columns) { rows.columns = columns; },
      [&](const std::vector<Cell>& cells) { rows.cells.push_back(cells); });
  if (!end) return Unexpected(end.error());
  rows.truncated = end->truncated;
  return rows;
}

void letter_ids(Rows& rows) {
  for (std::size_t column = 0; column < rows.columns.size(); ++column) {
    const char letter = letter_of(rows.columns[column]);
    if (letter == '\0') continue;
    for (auto& cells : rows.cells) {
      Cell& cell = cells[column];
      if (cell.type == Type::Integer) cell = {Type::Text, letter + cell.text};
    }
  }
}

bool is_of_programs(StoreReader& store) {
  const std::vector<DesignRow> designs = store.designs();
  return !designs.empty() && std::ranges::all_of(designs, [](const DesignRow& design) {
    return design.flavour.empty();
  });
}

void as_costs(Rows& rows) {
  constexpr std::array<std::string_view, 3> kOfMachines{"n_states", "n_transitions", "modules"};
  for (std::size_t column = rows.columns.size(); column-- > 0;) {
    if (std::ranges::find(kOfMachines, rows.columns[column]) == kOfMachines.end()) continue;
    rows.columns.erase(rows.columns.begin() + static_cast<std::ptrdiff_t>(column));
    for (auto& cells : rows.cells)
      cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(column));
  }
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kCosts{
      {{"score", "cost"},
       {"mean", "mean_cost"},
       {"best_mean", "best_mean_cost"},
       {"lowest", "highest"},
       {"highest", "lowest"}}};
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kNames{
      {{"candidate", "configuration"},
       {"best_candidate", "best_configuration"},
       {"fsm_config", "command_line"}}};
  for (std::size_t column = 0; column < rows.columns.size(); ++column) {
    std::string& name = rows.columns[column];
    const auto is_named = [&](const auto& pair) { return pair.first == name; };
    if (const auto* other = std::ranges::find_if(kNames, is_named); other != kNames.end())
      name = other->second;
    const auto* cost = std::ranges::find_if(kCosts, is_named);
    if (cost == kCosts.end()) continue;
    name = cost->second;
    for (auto& cells : rows.cells) {
      Cell& cell = cells[column];
      if (cell.type == Type::Null || cell.text == "0") continue;
      cell.text = cell.text.starts_with('-') ? cell.text.substr(1) : "-" + cell.text;
    }
  }
}

std::string rows_as_text(const Rows& rows) {
  std::vector<std::size_t> widths;
  std::vector<bool> right;
  for (std::size_t column = 0; column < rows.columns.size(); ++column) {
    widths.push_back(width_of(as_shown(rows.columns[column], Layout::Escaped)));
    right.push_back(!rows.cells.empty() && is_number(rows.cells.front()[column]));
    for (const auto& cells : rows.cells) {
      widths[column] = std::max(widths[column], width_of(shown(cells[column])));
    }
    widths[column] = std::min(widths[column], kWidestColumn);
  }
  std::string text;
  const auto add_line = [&](const auto& text_of) {
    std::string line;
    for (std::size_t column = 0; column < rows.columns.size(); ++column) {
      if (column > 0) line += "  ";
      append_padded(line, text_of(column), widths[column], right[column]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  };
  add_line([&](std::size_t column) { return as_shown(rows.columns[column], Layout::Escaped); });
  for (const auto& cells : rows.cells) {
    add_line([&](std::size_t column) { return shown(cells[column]); });
  }
  return text;
}

std::string cells_as_csv(const std::vector<Cell>& cells) {
  std::vector<std::string> texts;
  for (const Cell& cell : cells)
    texts.push_back(cell.text);
  return csv_line(texts);
}

std::string rows_as_csv(const Rows& rows) {
  std::string text = csv_line(rows.columns);
  for (const auto& cells : rows.cells)
    text += cells_as_csv(cells);
  return text;
}

std::string row_as_json(const Rows& rows, std::size_t row) {
  std::string text = "{";
  for (std::size_t column = 0; column < rows.columns.size(); ++column) {
    if (column > 0) text += ",";
    text += json_text(rows.columns[column]) + ":" + json_value(rows.cells[row][column]);
  }
  return text + "}";
}

std::string rows_as_json(const Rows& rows) {
  std::string text = "[";
  for (std::size_t row = 0; row < rows.cells.size(); ++row) {
    if (row > 0) text += ",";
    text += row_as_json(rows, row);
  }
  return text + "]";
}

void write_rows(Output& output, const Rows& rows, Form form) {
  switch (form) {
    case Form::Text:
      output.out << rows_as_text(rows);
      break;
    case Form::Csv:
      write_data(output, rows_as_csv(rows));
      break;
    case Form::Json: {
      std::string columns;
      for (const std::string& column : rows.columns) {
        columns += (columns.empty() ? "" : ",") + json_text(column);
      }
      output.out << "{\"columns\":[" << columns << "],\"rows\":" << rows_as_json(rows)
                 << ",\"truncated\":" << (rows.truncated ? "true" : "false") << "}\n";
      break;
    }
  }
  if (rows.truncated) note_truncated(output, rows.cells.size());
}

void note_truncated(Output& output, std::size_t rows) {
  print_note(output, "only the first " + std::to_string(rows) + " rows are shown");
}

}  // namespace swarmsmith::cli
