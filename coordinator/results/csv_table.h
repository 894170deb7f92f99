#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// A value, or everything that is wrong with a text: `where` is "file:line".
template <class T>
using OrErrors = tl::expected<T, std::vector<Error>>;

/// One row below the headline.
struct CsvRow {
  std::vector<std::string> cells;  ///< as many as there are columns
  std::size_t line = 0;            ///< on which it begins, from 1
};

/// A comma-separated text with a headline (RFC 4180): fields in quotes may hold commas, line breaks
/// and doubled quotes; an apostrophe that keeps a spreadsheet from calculating is none of the text
/// (base/csv.h). Line ends are LF or CRLF; blank lines are skipped, and a byte order mark.
struct CsvTable {
  std::string file;  ///< for messages
  std::vector<std::string> columns;
  std::vector<CsvRow> rows;

  std::optional<std::size_t> column(std::string_view name) const;
  /// "results.csv:12".
  std::string place(const CsvRow& row) const;
};

/// Errors: no headline, a column twice, a row with another number of fields, an open quote.
OrErrors<CsvTable> parse_csv(std::string_view text, const std::string& file);

/// One cell by the name of its column; empty when there is no such column.
std::string cell_of(const CsvTable& table, const CsvRow& row, std::string_view column);

/// Whole texts only; nothing for anything else.
std::optional<std::int64_t> integer_in(std::string_view text);
/// Finite or infinite; "NaN" is none.
std::optional<double> number_in(std::string_view text);

}  // namespace swarmsmith
