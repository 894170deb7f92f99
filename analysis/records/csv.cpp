#include "analysis/records/csv.h"

#include <limits>
#include <vector>

#include "base/text/csv.h"

namespace swarmsmith {
namespace {

constexpr StoreReader::QueryLimits kLimits{.rows = 50'000'000,
                                           .seconds = 600,
                                           .bytes = std::numeric_limits<std::int64_t>::max(),
                                           .memory = std::int64_t{1} << 30U,
                                           .spill = true};

}  // namespace

Expected<std::string> csv_of_rows(StoreReader& store, const std::string& sql) {
  std::string text;
  std::vector<std::string> texts;
  const auto end = store.query(
      sql, kLimits, [&](const std::vector<std::string>& columns) { text += csv_line(columns); },
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
