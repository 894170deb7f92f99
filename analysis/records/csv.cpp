#include "analysis/records/csv.h"

#include <vector>

namespace swarmsmith {
namespace {

constexpr StoreReader::QueryLimits kLimits{.rows = 50'000'000, .seconds = 600};

}  // namespace

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string field = "\"";
  for (const char letter : text) {
    field += letter;
    if (letter == '"') field += '"';
  }
  return field + "\"";
}

Expected<std::string> csv_of_rows(StoreReader& store, const std::string& sql) {
  std::string text;
  const auto add_row = [&](const auto& fields, const auto& text_of) {
    for (std::size_t i = 0; i < fields.size(); ++i)
      text += (i == 0 ? "" : ",") + csv_field(text_of(fields[i]));
    text += "\r\n";
  };
  const auto end = store.query(
      sql, kLimits,
      [&](const std::vector<std::string>& columns) {
        add_row(columns, [](const std::string& name) { return name; });
      },
      [&](const std::vector<StoreReader::Cell>& cells) {
        add_row(cells, [](const StoreReader::Cell& cell) { return cell.text; });
      });
  if (!end) return Unexpected(end.error());
  if (end->truncated) return bad_input("reading took over 600 s", sql);
  return text;
}

}  // namespace swarmsmith
