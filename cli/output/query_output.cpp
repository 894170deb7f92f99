#include "cli/output/query_output.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <iterator>
#include <ostream>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/plain_text.h"
#include "base/text/csv.h"
#include "base/text/text_table.h"
#include "console/terminal.h"

namespace swarmsmith::cli {
namespace {

using Cell = StoreReader::Cell;
using Type = StoreReader::Cell::Type;

/// People need only six significant digits of a real number.
std::string shown(Cell cell) {
  if (cell.type == Type::Null) return "-";
  if (cell.type != Type::Real) return std::move(cell.text);
  char buffer[32];
  const int size = std::snprintf(buffer, sizeof buffer, "%.6g", cell.real());
  return {buffer, static_cast<std::size_t>(size)};
}

/// Numbers are aligned on the right of their column.
bool is_number(const Cell& cell) {
  return cell.type == Type::Integer || cell.type == Type::Real;
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
  // One of our own statements needs all its rows, or as many as its limit asks for.
  if (rows.truncated && end->rows < limits.rows && !limits.typed) {
    return unexpected(
        ErrorKind::Unavailable,
        fmt::format("the store could not be read to the end: it took longer than {} s, or "
                    "the answer is too long",
                    limits.seconds));
  }
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
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kCosts{
      {{"score", "cost"},
       {"mean", "mean_cost"},
       {"best_mean", "best_mean_cost"},
       {"test_mean", "test_mean_cost"},
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

namespace {

TextTable table_of(Rows rows) {
  TextTable table{.aligns = {}, .rows = {std::move(rows.columns)}};
  for (std::size_t column = 0; column < table.rows.front().size(); ++column) {
    const bool right = !rows.cells.empty() && is_number(rows.cells.front()[column]);
    table.aligns.push_back(right ? Align::Right : Align::Left);
  }
  for (std::vector<Cell>& cells : rows.cells) {
    std::ranges::transform(cells, std::back_inserter(table.rows.emplace_back()),
                           [](Cell& cell) { return shown(std::move(cell)); });
    cells = {};
  }
  return table;
}

}  // namespace

std::string rows_as_text(Rows rows) {
  return aligned(table_of(std::move(rows)));
}

std::string cells_as_csv(const std::vector<Cell>& cells) {
  std::vector<std::string> texts;
  texts.reserve(cells.size());
  for (const Cell& cell : cells)
    texts.push_back(cell.text);
  return csv_line(texts);
}

JsonPiece cell_as_json(const Cell& cell) {
  switch (cell.type) {
    case Type::Null:
      return {"null"};
    case Type::Integer:
      return {cell.text};
    case Type::Real:
      return {json_number(cell.real())};
    case Type::Text:
      break;
  }
  return {json_text(cell.text)};
}

namespace {

JsonObject as_object(const std::vector<std::string>& columns, const std::vector<Cell>& cells) {
  JsonObject object;
  for (std::size_t column = 0; column < columns.size(); ++column)
    object.add(columns[column], cell_as_json(cells[column]));
  return object;
}

void write_json(std::ostream& out, Rows rows, bool as_lists) {
  out << "{\"columns\":" << json_of(rows.columns) << ",\"rows\":[";
  std::string_view between;
  for (std::vector<Cell>& cells : rows.cells) {
    out << std::exchange(between, ",")
        << (as_lists ? json_list(cells, cell_as_json).text : as_object(rows.columns, cells).text());
    cells = {};
  }
  out << "],\"truncated\":" << json_of(rows.truncated) << "}\n";
}

}  // namespace

JsonObject row_as_json(const Rows& rows, std::size_t row) {
  return as_object(rows.columns, rows.cells[row]);
}

JsonPiece rows_as_json(const Rows& rows) {
  return json_list(rows.cells, [&](const auto& cells) { return as_object(rows.columns, cells); });
}

void write_rows(Output& output, Rows rows, Form form) {
  const bool truncated = rows.truncated;
  const std::size_t count = rows.cells.size();
  switch (form) {
    case Form::Text:
      write_aligned(output.out, table_of(std::move(rows)));
      break;
    case Form::Json:
    case Form::JsonLists:
      write_json(output.out, std::move(rows), form == Form::JsonLists);
      break;
  }
  if (truncated) note_truncated(output, count);
}

void note_truncated(Output& output, std::size_t rows) {
  print_note(output, rows == 1 ? "only the first row is shown"
                               : "only the first " + counted(rows, "row") + " are shown");
}

}  // namespace swarmsmith::cli
