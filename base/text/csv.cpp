#include "base/text/csv.h"
#include "base/plain_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

namespace swarmsmith {
namespace {

bool is_number(std::string_view text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return stop == end && (error == std::errc() || error == std::errc::result_out_of_range);
}

bool is_letter(char byte) {
  return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z');
}

bool is_switches(std::string_view text) {
  const std::size_t name = text.find_first_not_of('-');
  if (name == 0 || name > 2 || name >= text.size() || !is_letter(text[name])) return false;
  constexpr std::string_view kOthers = "0123456789 ._-/:,";
  return std::ranges::all_of(text, [&](char byte) {
    return is_letter(byte) || kOthers.find(byte) != std::string_view::npos;
  });
}

/// The text after leading apostrophes, which a spreadsheet would evaluate without them.
std::string_view behind_apostrophes(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of('\''), text.size()));
}

bool begins_as_formula(std::string_view text) {
  constexpr std::string_view kBegins = "=+-@\t\r\n";
  return !text.empty() && kBegins.find(text.front()) != std::string_view::npos;
}

Error at(const std::string& file, std::size_t line, std::string message) {
  return {ErrorKind::BadInput, std::move(message), file + ":" + std::to_string(line)};
}

bool is_blank(const std::vector<std::string>& fields) {
  return fields.size() == 1 && fields.front().find_first_not_of(" \t") == std::string::npos;
}

}  // namespace

std::string csv_field(std::string_view text) {
  // A text that begins with apostrophes gets one more, so that reading removes only that one.
  const bool guarded = begins_as_formula(behind_apostrophes(text)) &&
                       (text.front() == '\'' || (!is_number(text) && !is_switches(text)));
  std::string field = guarded ? "'" : "";
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return field += text;
  field.insert(0, 1, '"');
  for (const char letter : text) {
    field += letter;
    if (letter == '"') field += '"';
  }
  return field + "\"";
}

std::string csv_line(const std::vector<std::string>& texts) {
  std::string line;
  for (std::size_t i = 0; i < texts.size(); ++i)
    line += (i == 0 ? "" : ",") + csv_field(texts[i]);
  return line + "\n";
}

std::string_view csv_text(std::string_view field) {
  const bool guarded = field.starts_with('\'') && begins_as_formula(behind_apostrophes(field));
  return field.substr(guarded ? 1 : 0);
}

CsvReader::CsvReader(std::string_view text) : rest_(text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
}

std::optional<std::vector<std::string>> CsvReader::next() {
  std::vector<std::string> fields;
  while (true) {
    const std::optional<std::string> field = rest_.starts_with('"') ? quoted() : plain();
    if (!field) return std::nullopt;
    fields.emplace_back(csv_text(*field));
    if (!rest_.starts_with(',')) break;
    rest_.remove_prefix(1);
  }
  end_line();
  return fields;
}

std::string CsvReader::plain() {
  const std::string_view field = rest_.substr(0, rest_.find_first_of(",\r\n"));
  rest_.remove_prefix(field.size());
  return std::string(field);
}

/// Text after the closing quote also belongs to the field: "a"b is ab.
std::optional<std::string> CsvReader::quoted() {
  std::string field;
  rest_.remove_prefix(1);
  while (!rest_.empty()) {
    const char letter = rest_.front();
    rest_.remove_prefix(1);
    if (letter == '\n') ++line_;
    if (letter != '"') {
      field += letter;
    } else if (rest_.starts_with('"')) {
      field += '"';
      rest_.remove_prefix(1);
    } else {
      return field + plain();
    }
  }
  return std::nullopt;
}

void CsvReader::end_line() {
  if (rest_.starts_with('\r')) rest_.remove_prefix(1);
  if (rest_.starts_with('\n')) rest_.remove_prefix(1);
  ++line_;
}

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
  CsvReader reader(text);
  while (!reader.at_end()) {
    const std::size_t line = reader.line();
    auto fields = reader.next();
    if (!fields) {
      errors.push_back(at(file, line, "a quote is opened in this row and never closed"));
      break;
    }
    if (is_blank(*fields)) continue;
    if (table.columns.empty()) {
      table.columns = std::move(*fields);
      for (auto name = table.columns.begin(); name != table.columns.end(); ++name) {
        if (std::find(table.columns.begin(), name, *name) != name)
          errors.push_back(at(file, line, "the column " + *name + " occurs twice"));
      }
    } else if (fields->size() != table.columns.size()) {
      errors.push_back(at(file, line,
                          "the row has " + counted(fields->size(), "field") + ", the headline " +
                              std::to_string(table.columns.size())));
    } else {
      table.rows.push_back({std::move(*fields), line});
    }
  }
  if (table.columns.empty() && errors.empty())
    errors.push_back({ErrorKind::BadInput,
                      "the file is empty; it must begin with a line of column names", file});
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
