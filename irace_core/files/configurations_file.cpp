#include "irace_core/files/configurations_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "base/suggestion.h"
#include "irace_core/files/command_line_text.h"
#include "irace_core/files/expression_text.h"
#include "irace_core/files/internal/table.h"
#include "irace_core/internal/check_parameter.h"
#include "irace_core/internal/rounding.h"

namespace swarmsmith {
namespace {

using irace::Cell;
using Row = std::vector<Cell>;

/// A decimal number; nothing for any other text.
std::optional<double> to_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc{} || read.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Reads the rows after the header.
class TableReader {
 public:
  TableReader(const std::string& file, const ParameterSpace& space) : file_(file), space_(space) {}

  Expected<void> read_header(const Row& header);
  Expected<Configuration> read_row(const Row& row, std::size_t number) const;
  std::size_t columns() const { return columns_; }

 private:
  std::string where(const Cell& cell) const { return file_ + ":" + r::to_string(cell.place); }
  /// The value of an active parameter; an error has no place.
  Expected<double> read_value(std::size_t parameter, const Cell& cell,
                              const Assignment& known) const;
  Expected<double> read_choice(std::size_t parameter, const std::string& text) const;
  Expected<double> read_numeric(std::size_t parameter, const std::string& text,
                                const Assignment& known) const;
  /// Whether the value is NA; "NA" in quotes may be a value of the parameter.
  bool is_missing(std::size_t parameter, const Cell& cell) const;

  const std::string& file_;
  const ParameterSpace& space_;
  std::size_t columns_ = 0;
  std::vector<std::optional<std::size_t>> column_of_;  ///< by parameter
};

Expected<void> TableReader::read_header(const Row& header) {
  std::vector<std::string> names;
  for (const Parameter& parameter : space_.parameters())
    names.push_back(parameter.name);
  columns_ = header.size();
  column_of_.assign(space_.size(), std::nullopt);
  for (std::size_t column = 0; column < header.size(); ++column) {
    const std::string& name = header[column].text;
    const std::optional<std::size_t> parameter = space_.index_of(name);
    if (!parameter) {
      return bad_input("there is no parameter '" + name + "'" + did_you_mean(name, names),
                       where(header[column]));
    }
    if (column_of_[*parameter]) {
      return bad_input("the name '" + name + "' occurs twice", where(header[column]));
    }
    column_of_[*parameter] = column;
  }
  std::vector<std::string> absent;
  for (std::size_t i = 0; i < space_.size(); ++i) {
    if (!column_of_[i] && !space_.is_fixed(i)) absent.push_back(names[i]);
  }
  if (absent.empty()) return {};
  return bad_input("the first line must name every parameter; these are missing: " + joined(absent),
                   where(header.front()));
}

bool TableReader::is_missing(std::size_t parameter, const Cell& cell) const {
  const auto values = irace::choice_values(space_[parameter].domain);
  const bool is_value =
      cell.quoted && std::find(values.begin(), values.end(), cell.text) != values.end();
  return cell.is_missing() && !is_value;
}

Expected<double> TableReader::read_choice(std::size_t parameter, const std::string& text) const {
  const auto values = irace::choice_values(space_[parameter].domain);
  const auto found = std::find(values.begin(), values.end(), text);
  if (found != values.end()) return static_cast<double>(found - values.begin());
  return bad_input("'" + text + "' is not among its values: " +
                   joined(std::vector<std::string>(values.begin(), values.end())));
}

Expected<double> TableReader::read_numeric(std::size_t parameter, const std::string& text,
                                           const Assignment& known) const {
  const std::optional<double> number = to_number(text);
  if (!number) return bad_input("'" + text + "' is not a number");
  const bool whole = std::holds_alternative<Integer>(space_[parameter].domain);
  if (whole && *number != std::floor(*number)) {
    return bad_input(text + " is not a whole number");
  }
  const double value = whole ? *number : irace::round_to_digits(*number, space_.digits());
  const auto domain = space_.interval(parameter, known);
  if (!domain) return Unexpected(domain.error());
  if (!*domain) return bad_input("has a value, but a parameter in its bounds has none");
  if (value >= (*domain)->lower && value <= (*domain)->upper) return value;
  return bad_input(exact_text(value) + " is not in its domain (" + exact_text((*domain)->lower) +
                   ", " + exact_text((*domain)->upper) + ")");
}

Expected<double> TableReader::read_value(std::size_t parameter, const Cell& cell,
                                         const Assignment& known) const {
  if (!space_.is_numeric(parameter)) return read_choice(parameter, cell.text);
  return read_numeric(parameter, cell.text, known);
}

Expected<Configuration> TableReader::read_row(const Row& row, std::size_t number) const {
  const std::size_t skipped = row.size() - columns_;  // the name of a row
  Assignment values(space_);
  for (const std::size_t i : space_.hierarchy_order()) {
    const Parameter& parameter = space_[i];
    const auto problem = [&](const std::string& what, const Cell& cell) {
      return bad_input("configuration " + std::to_string(number) + ", parameter '" +
                           parameter.name + "': " + what,
                       where(cell));
    };
    const bool active = space_.is_active(i, values);
    if (!column_of_[i]) {
      if (active) values.set(i, 0);
      continue;
    }
    const Cell& cell = row[skipped + *column_of_[i]];
    // A value may depend on a parameter without a value, and is then missing itself.
    const bool needed = active && (!space_.is_numeric(i) || space_.constant_interval(i) != nullptr);
    if (active ? is_missing(i, cell) : cell.is_missing()) {
      if (!needed) {
        const auto domain = active ? space_.interval(i, values) : std::nullopt;
        if (!domain) return problem(domain.error().message, cell);
        if (!*domain) continue;
      }
      return problem("is active and needs a value, found NA", cell);
    }
    if (!active) {
      return problem("must be NA, because its condition does not hold (" +
                         print(*parameter.condition) + "), found " + cell.text,
                     cell);
    }
    const auto value = read_value(i, cell, values);
    if (!value) return problem(value.error().message, cell);
    values.set(i, *value);
  }
  return values.configuration();
}

}  // namespace

Expected<std::vector<Configuration>> parse_configurations_file(const IraceText& source,
                                                               const ParameterSpace& space) {
  const auto rows = irace::read_table(source);
  if (!rows) return Unexpected(rows.error());
  if (rows->empty()) {
    return bad_input("expected a first line with the parameters' names", source.file + ":1:1");
  }
  TableReader reader(source.file, space);
  if (auto header = reader.read_header(rows->front()); !header) return Unexpected(header.error());
  std::vector<Configuration> configurations;
  for (std::size_t i = 1; i < rows->size(); ++i) {
    const Row& row = (*rows)[i];
    const std::string where = source.file + ":" + r::to_string(row.front().place);
    const std::size_t wanted =
        (*rows)[1].size() == reader.columns() + 1 ? reader.columns() + 1 : reader.columns();
    if (row.size() != wanted) {
      return bad_input("expected " + std::to_string(wanted) +
                           " fields, as many as the first line "
                           "has names, found " +
                           std::to_string(row.size()),
                       where);
    }
    auto configuration = reader.read_row(row, i);
    if (!configuration) return Unexpected(configuration.error());
    const auto same = std::find(configurations.begin(), configurations.end(), *configuration);
    if (same != configurations.end()) {
      return bad_input("configuration " + std::to_string(i) + " is the same as configuration " +
                           std::to_string(same - configurations.begin() + 1),
                       where);
    }
    configurations.push_back(std::move(*configuration));
  }
  return configurations;
}

Expected<std::string> print_configurations_file(const ParameterSpace& space,
                                                std::span<const Configuration> configurations) {
  std::string text;
  for (const Parameter& parameter : space.parameters())
    text += (text.empty() ? "" : " ") + parameter.name;
  text += '\n';
  for (const Configuration& configuration : configurations) {
    for (std::size_t i = 0; i < space.size(); ++i) {
      if (i > 0) text += ' ';
      if (!configuration.is_active(i)) {
        text += "NA";
      } else if (space.is_numeric(i)) {
        text += print(Expression::number(configuration[i]));
      } else {
        auto field = irace::print_field(value_text(space, i, configuration[i]));
        if (!field)
          return Unexpected(Error{field.error().kind, field.error().message, space[i].name});
        text += *field;
      }
    }
    text += '\n';
  }
  return text;
}

}  // namespace swarmsmith
