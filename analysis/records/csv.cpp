#include "analysis/records/csv.h"

#include <vector>

#include "analysis/records/records.h"
#include "base/text/csv.h"

namespace swarmsmith {
Expected<std::string> csv_of_rows(StoreReader& store, const std::string& sql) {
  std::string text;
  std::vector<std::string> texts;
  const auto end = store.query(
      sql, kRecordLimits,
      [&](const std::vector<std::string>& columns) { text += csv_line(columns); },
      [&](const std::vector<StoreReader::Cell>& cells) {
        texts.clear();
        for (const StoreReader::Cell& cell : cells)
          texts.push_back(cell.text);
        text += csv_line(texts);
      });
  if (!end) return Unexpected(end.error());
  if (end->truncated) return bad_input("reading took over 600 s", sql);
  return text;
}

}  // namespace swarmsmith
