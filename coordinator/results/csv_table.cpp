#include "coordinator/results/csv_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "base/csv.h"

namespace swarmsmith {
namespace {

/// Cuts the text into rows of fields, front to back.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
  }

  bool at_end() const { return rest_.empty(); }
  std::size_t line() const { return line_; }

  /// The next row; nothing when a quote is never closed. A blank line is one empty field.
  std::optional<std::vector<std::string>> next() {
    std::vector<std::string> fields;
    while (true) {
      auto field = rest_.starts_with('"') ? quoted() : plain();
      if (!field) return std::nullopt;
      fields.emplace_back(csv_text(*field));
      if (rest_.starts_with(',')) {
        rest_.remove_prefix(1);
        continue;
      }
      end_line();
      return fields;
    }
  }

 private:
  std::optional<std::string> plain() {
    const std::string_view field = rest_.substr(0, rest_.find_first_of(",\r\n"));
    rest_.remove_prefix(field.size());
    return std::string(field);
  }

  /// What follows the closing quote belongs to the field, too: "a"b is ab.
  std::optional<std::string> quoted() {
    std::string field;
    rest_.remove_prefix(1);
    while (true) {
      if (rest_.empty()) return std::nullopt;
      const char letter = rest_.front();
      rest_.remove_prefix(1);
      if (letter == '\n') ++line_;
      if (letter != '"') {
        field += letter;
      } else if (rest_.starts_with('"')) {
        field += '"';
        rest_.remove_prefix(1);
      } else {
        return field + *plain();
      }
    }
  }

  void end_line() {
    if (rest_.starts_with('\r')) rest_.remove_prefix(1);
    if (rest_.starts_with('\n')) rest_.remove_prefix(1);
    ++line_;
  }

  std::string_view rest_;
  std::size_t line_ = 1;
};

Error at(const std::string& file, std::size_t line, std::string message) {
  return {ErrorKind::BadInput, std::move(message), file + ":" + std::to_string(line)};
}

bool is_blank(const std::vector<std::string>& fields) {
  return fields.size() == 1 && fields.front().find_first_not_of(" \t") == std::string::npos;
}

}  // namespace

std::optional<std::size_t> CsvTable::column(std::string_view name) const {
  const auto found = std::ranges::find(columns, name);
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

std::string CsvTable::place(const CsvRow& row) const {
  return file + ":" + std::to_string(row.line);
}

OrErrors<CsvTable> parse_csv(std::string_view text, const std::string& file) {
  CsvTable table{.file = file, .columns = {}, .rows = {}};
  std::vector<Error> errors;
  Scanner scanner(text);
  while (!scanner.at_end()) {
    const std::size_t line = scanner.line();
    auto fields = scanner.next();
    if (!fields) {
      errors.push_back(at(file, line, "a quote is opened in this row and never closed"));
      break;
    }
    if (is_blank(*fields)) continue;
    if (table.columns.empty()) {
      table.columns = std::move(*fields);
      for (auto name = table.columns.begin(); name != table.columns.end(); ++name) {
        if (std::find(table.columns.begin(), name, *name) != name)
          errors.push_back(at(file, line, "the column " + *name + " is there twice"));
      }
    } else if (fields->size() != table.columns.size()) {
      errors.push_back(at(file, line,
                          "the row has " + std::to_string(fields->size()) +
                              " fields, the headline " + std::to_string(table.columns.size())));
    } else {
      table.rows.push_back({std::move(*fields), line});
    }
  }
  if (table.columns.empty() && errors.empty())
    errors.push_back({ErrorKind::BadInput, "the file is empty; a headline was wanted", file});
  if (!errors.empty()) return tl::unexpected(std::move(errors));
  return table;
}

std::string cell_of(const CsvTable& table, const CsvRow& row, std::string_view column) {
  const auto index = table.column(column);
  return index ? row.cells[*index] : std::string();
}

std::optional<std::int64_t> integer_in(std::string_view text) {
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> number_in(std::string_view text) {
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size()) return std::nullopt;
  if (std::isnan(value)) return std::nullopt;
  return value;
}

}  // namespace swarmsmith
