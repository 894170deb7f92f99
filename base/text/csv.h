#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// Tables with commas (RFC 4180, lines end with LF), as every program here writes and reads them.

/// One field: in quotes when it must be. A text that a spreadsheet would take for a formula, or for
/// a line of its own, begins with an apostrophe then: one that begins with = + - @, a tab or a line
/// end. Numbers stay as they are; so do switches and their values, --s0 1 -a 0.5: a minus, a
/// letter, and nothing but letters, digits, blanks and . _ - / : , call nothing.
std::string csv_field(std::string_view text);

/// The texts as fields of one line, with its end.
std::string csv_line(const std::vector<std::string>& texts);

/// The text of a field that `csv_field` wrote, or a person: without that apostrophe.
std::string_view csv_text(std::string_view field);

/// Cuts a text into rows of fields, front to back: fields in quotes may hold commas, line breaks
/// and doubled quotes; lines end with LF or CRLF; a byte order mark at the begin is skipped.
class CsvReader {
 public:
  /// The text must outlive the reader.
  explicit CsvReader(std::string_view text);

  bool at_end() const { return rest_.empty(); }
  /// Of the next row, from 1.
  std::size_t line() const { return line_; }
  /// The next row's fields, as `csv_text` gives them; nothing when a quote is never closed. A blank
  /// line is one empty field.
  std::optional<std::vector<std::string>> next();

 private:
  std::string plain();
  std::optional<std::string> quoted();
  void end_line();

  std::string_view rest_;
  std::size_t line_ = 1;
};

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
/// (`csv_field`). Line ends are LF or CRLF; blank lines are skipped, and a byte order mark.
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
