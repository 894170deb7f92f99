#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// Tables in CSV (RFC 4180, lines end with LF), as all programs of this project write and read
/// them.

/// One field, in quotes if necessary. A text that a spreadsheet would read as a formula, or as a
/// new line, gets an apostrophe before it: one that begins with = + - @, a tab or a line end.
/// Numbers do not, nor do switches and their values (--s0 1 -a 0.5): a minus and a letter, followed
/// only by letters, digits, blanks and . _ - / : , cannot call a function.
std::string csv_field(std::string_view text);

/// The texts as fields of one line, with its end.
std::string csv_line(const std::vector<std::string>& texts);

/// The text of a field that `csv_field` or a user wrote: without that apostrophe.
std::string_view csv_text(std::string_view field);

/// Splits a text into rows of fields, from the beginning: fields in quotes may contain commas, line
/// breaks and doubled quotes; lines end with LF or CRLF; a byte order mark at the beginning is
/// skipped.
class CsvReader {
 public:
  /// The text must outlive the reader.
  explicit CsvReader(std::string_view text);

  bool at_end() const { return rest_.empty(); }
  /// The line of the next row, from 1.
  std::size_t line() const { return line_; }
  /// The next row's fields, as `csv_text` gives them; empty when a quote is never closed. A blank
  /// line is one empty field.
  std::optional<std::vector<std::string>> next();

 private:
  std::string plain();
  std::optional<std::string> quoted();
  void end_line();

  std::string_view rest_;
  std::size_t line_ = 1;
};

/// A value, or all errors in a text; their `where` is "file:line".
template <class T>
using OrErrors = tl::expected<T, std::vector<Error>>;

/// One row below the header line.
struct CsvRow {
  std::vector<std::string> cells;  ///< one for each column
  std::size_t line = 0;            ///< the row's first line in the file, from 1
};

/// A comma-separated text with a header line (RFC 4180). Fields in quotes may contain commas, line
/// breaks and doubled quotes; an apostrophe that protects from a spreadsheet's formulas is not part
/// of the text (`csv_field`). Line ends are LF or CRLF; blank lines and a byte order mark are
/// skipped.
struct CsvTable {
  std::string file;  ///< for messages
  std::vector<std::string> columns;
  std::vector<CsvRow> rows;

  std::optional<std::size_t> column(std::string_view name) const;
  /// "results.csv:12".
  std::string place(const CsvRow& row) const;
};

/// Errors: no header line, two columns with one name, a row with another number of fields, an open
/// quote.
OrErrors<CsvTable> parse_csv(std::string_view text, const std::string& file);

/// The cell of the row in the column with this name; empty when there is no such column.
std::string cell_of(const CsvTable& table, const CsvRow& row, std::string_view column);

/// The number, if the whole text is an integer; else empty.
std::optional<std::int64_t> integer_in(std::string_view text);
/// A finite or infinite number; empty for "NaN".
std::optional<double> number_in(std::string_view text);

}  // namespace swarmsmith
