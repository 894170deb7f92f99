#include "cli/output/query_output.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <iterator>
#include <numeric>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/text/csv.h"
#include "base/text/text_table.h"
#include "console/terminal.h"

namespace swarmsmith::cli {
namespace {

using Cell = StoreReader::Cell;
using Type = StoreReader::Cell::Type;

/// For people six significant digits of a real are enough.
std::string shown(const Cell& cell) {
  if (cell.type == Type::Null) return "-";
  if (cell.type != Type::Real) return cell.text;
  char buffer[32];
  const int size =
      std::snprintf(buffer, sizeof buffer, "%.6g", std::strtod(cell.text.c_str(), nullptr));
  return {buffer, static_cast<std::size_t>(size)};
}

/// Numbers stand on the right of their column.
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
  // Of a statement of our own all rows are wanted, or as many as were asked for.
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
  TextTable table{.aligns = {}, .rows = {rows.columns}};
  for (std::size_t column = 0; column < rows.columns.size(); ++column) {
    const bool right = !rows.cells.empty() && is_number(rows.cells.front()[column]);
    table.aligns.push_back(right ? Align::Right : Align::Left);
  }
  for (const auto& cells : rows.cells)
    std::ranges::transform(cells, std::back_inserter(table.rows.emplace_back()), shown);
  return aligned(std::move(table));
}

std::string cells_as_csv(const std::vector<Cell>& cells) {
  std::vector<std::string> texts;
  texts.reserve(cells.size());
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

JsonPiece cell_as_json(const Cell& cell) {
  switch (cell.type) {
    case Type::Null:
      return {"null"};
    case Type::Integer:
      return {cell.text};
    case Type::Real:
      return {json_number(std::strtod(cell.text.c_str(), nullptr))};
    case Type::Text:
      break;
  }
  return {json_text(cell.text)};
}

JsonObject row_as_json(const Rows& rows, std::size_t row) {
  JsonObject object;
  for (std::size_t column = 0; column < rows.columns.size(); ++column)
    object.add(rows.columns[column], cell_as_json(rows.cells[row][column]));
  return object;
}

JsonPiece rows_as_json(const Rows& rows) {
  std::vector<std::size_t> numbers(rows.cells.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return json_list(numbers, [&](std::size_t row) { return row_as_json(rows, row); });
}

namespace {

JsonPiece rows_as_lists(const Rows& rows) {
  return json_list(rows.cells,
                   [](const std::vector<Cell>& cells) { return json_list(cells, cell_as_json); });
}

}  // namespace

void write_rows(Output& output, const Rows& rows, Form form) {
  switch (form) {
    case Form::Text:
      output.out << rows_as_text(rows);
      break;
    case Form::Csv:
      write_data(output, rows_as_csv(rows));
      break;
    case Form::Json:
    case Form::JsonLists:
      output.out << JsonObject()
                        .add("columns", rows.columns)
                        .add("rows", form == Form::Json ? rows_as_json(rows) : rows_as_lists(rows))
                        .add("truncated", rows.truncated)
                        .text()
                 << "\n";
      break;
  }
  if (rows.truncated) note_truncated(output, rows.cells.size());
}

void note_truncated(Output& output, std::size_t rows) {
  print_note(output, "only the first " + std::to_string(rows) + " rows are shown");
}

}  // namespace swarmsmith::cli
