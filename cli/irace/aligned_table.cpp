#include "cli/irace/aligned_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "base/text/text_table.h"

namespace swarmsmith::cli {
namespace {

constexpr int kDigits = 7;  // significant digits in R's output

/// The digits that a number needs at kDigits significant digits.
struct Shape {
  int digits = 1;  ///< significant ones, without trailing zeros
  int exponent = 0;
  bool negative = false;
};

Shape shape_of(double value) {
  const std::string text = fmt::format("{:.{}e}", std::fabs(value), kDigits - 1);
  const std::size_t e = text.find('e');
  const std::size_t last = text.find_last_not_of('0', e - 1);
  return {.digits = last == 1 || last == 0 ? 1 : static_cast<int>(last),
          .exponent = std::stoi(text.substr(e + 1)),
          .negative = std::signbit(value)};
}

/// The format of all numbers of a column.
struct Format {
  int decimals = 0;
  int mantissa = 0;  ///< decimals in scientific form
  bool scientific = false;
};

Format format_of(std::span<const std::optional<double>> values) {
  Format format;
  int before_point = 1;
  bool negative = false;
  bool wide_exponent = false;
  for (const std::optional<double>& value : values) {
    if (!value || !std::isfinite(*value)) continue;
    const Shape shape = shape_of(*value);
    before_point =
        std::max(before_point, std::max(shape.exponent + 1, 1) + (shape.negative ? 1 : 0));
    format.decimals = std::max(format.decimals, shape.digits - shape.exponent - 1);
    format.mantissa = std::max(format.mantissa, shape.digits - 1);
    negative = negative || shape.negative;
    wide_exponent = wide_exponent || std::abs(shape.exponent) >= 100;
  }
  const int fixed = before_point + (format.decimals > 0 ? format.decimals + 1 : 0);
  const int scientific = (negative ? 1 : 0) + 1 + (format.mantissa > 0 ? format.mantissa + 1 : 0) +
                         (wide_exponent ? 5 : 4);
  format.scientific = scientific < fixed;
  return format;
}

}  // namespace

std::vector<std::string> real_cells(std::span<const std::optional<double>> values) {
  const Format format = format_of(values);
  std::vector<std::string> cells;
  for (const std::optional<double>& value : values) {
    if (!value || std::isnan(*value)) {
      cells.emplace_back("NA");
    } else if (std::isinf(*value)) {
      cells.emplace_back(*value > 0 ? "Inf" : "-Inf");
    } else if (format.scientific) {
      cells.push_back(fmt::format("{:.{}e}", *value, format.mantissa));
    } else {
      cells.push_back(fmt::format("{:.{}f}", *value, format.decimals));
    }
  }
  return cells;
}

std::string aligned_table(const std::vector<std::string>& row_names,
                          const std::vector<TableColumn>& columns) {
  std::size_t names_width = 0;
  for (const std::string& name : row_names)
    names_width = std::max(names_width, width_of(name));
  std::vector<std::string> lines{std::string(names_width, ' ')};
  for (const std::string& name : row_names)
    lines.push_back(padded(name, names_width, Align::Left));
  for (const TableColumn& column : columns) {
    std::size_t width = width_of(column.name);
    for (const std::string& cell : column.cells)
      width = std::max(width, width_of(cell));
    lines[0] += ' ' + padded(column.name, width, Align::Right);
    for (std::size_t row = 0; row < column.cells.size(); ++row)
      lines[row + 1] += ' ' + padded(column.cells[row], width, Align::Right);
  }
  std::string text;
  for (const std::string& line : lines)
    text += line + '\n';
  return text;
}

}  // namespace swarmsmith::cli
