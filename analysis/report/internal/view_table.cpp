#include "analysis/report/internal/view_table.h"

#include <charconv>

#include <fmt/format.h>

#include "analysis/records/names.h"
#include "analysis/records/records.h"
#include "base/plain_text.h"

namespace swarmsmith {
namespace {

using Cell = StoreReader::Cell;

std::string shown(const Cell& cell, Show show) {
  if (cell.type == Cell::Type::Null) return "-";
  switch (show) {
    case Show::Name:
      return as_words(cell.text);
    case Show::Text:
    case Show::Count:
      return cell.text;
    case Show::Number:
      return cell.type == Cell::Type::Text ? cell.text : shown_number(cell.real());
    case Show::Percent:
      return fmt::format("{:.0f} %", 100 * cell.real());
    case Show::Design:
      return "d" + cell.text;
    case Show::Candidate:
      return "c" + cell.text;
    case Show::YesNo:
      return cell.text == "0" ? "no" : "yes";
  }
  return cell.text;
}

bool is_number(Show show) {
  return show == Show::Count || show == Show::Number || show == Show::Percent;
}

}  // namespace

Expected<HtmlTable> view_table(StoreReader& store, const std::string& caption,
                               const std::vector<ViewColumn>& columns, const std::string& sql,
                               std::size_t most) {
  HtmlTable table{.caption = caption};
  for (const ViewColumn& column : columns)
    table.columns.push_back({column.title, is_number(column.show)});
  std::size_t rows = 0;
  const auto end = store.query(
      sql, kRecordLimits, [](const std::vector<std::string>&) {},
      [&](const std::vector<Cell>& cells) {
        if (++rows > most) return;
        std::vector<std::string> row;
        for (std::size_t i = 0; i < columns.size(); ++i)
          row.push_back(shown(cells[i], columns[i].show));
        table.rows.push_back(std::move(row));
      });
  if (!end) return Unexpected(end.error());
  if (rows > most) table.caption += fmt::format(" The first {} of {}.", most, counted(rows, "row"));
  return table;
}

Expected<std::vector<std::pair<std::string, std::string>>> view_facts(StoreReader& store,
                                                                      const std::string& sql) {
  std::vector<std::pair<std::string, std::string>> facts;
  const auto end = store.query(
      sql, kRecordLimits, [](const std::vector<std::string>&) {},
      [&](const std::vector<Cell>& cells) {
        facts.emplace_back(cells[0].text, shown(cells[1], Show::Number));
      });
  if (!end) return Unexpected(end.error());
  return facts;
}

}  // namespace swarmsmith
