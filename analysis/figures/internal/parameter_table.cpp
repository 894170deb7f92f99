#include "analysis/figures/internal/parameter_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "analysis/figures/internal/design_flavour.h"
#include "analysis/figures/internal/parameter_words.h"

#include "sim/control/controller.h"

namespace swarmsmith {
namespace {

constexpr double kNotActive = std::numeric_limits<double>::quiet_NaN();
constexpr double kMostWholeNumbers = 7;
constexpr std::size_t kTenths = 10;

double number_of(const std::string& text) {
  double value = kNotActive;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// Words in alphabetical order, numbers in numerical order.
struct ValueOrder {
  bool are_numbers = false;
  bool operator()(const std::string& a, const std::string& b) const {
    return are_numbers ? number_of(a) < number_of(b) : a < b;
  }
};

/// Whether there are only a few whole numbers in a small range, such as sizes and counts, which are
/// better shown one by one.
bool are_few_whole(const std::vector<const ParameterRecord*>& records) {
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  for (const ParameterRecord* record : records) {
    const double value = number_of(record->value);
    if (value != std::floor(value)) return false;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return high - low < kMostWholeNumbers;
}

ParameterColumn column_of(const ParameterTable& table, std::string name,
                          const std::vector<const ParameterRecord*>& records) {
  ParameterColumn column{.name = std::move(name), .active = records.size()};
  column.values.assign(table.candidates.size(), kNotActive);
  const bool are_numbers =
      std::ranges::all_of(records, [](const auto* record) { return record->is_number; });
  if (!are_numbers || are_few_whole(records)) {
    std::map<std::string, std::size_t, ValueOrder> places(ValueOrder{are_numbers});
    for (const ParameterRecord* record : records)
      places.emplace(record->value, 0);
    for (auto& [value, place] : places) {
      place = column.categories.size();
      column.categories.push_back(value);
    }
    for (const ParameterRecord* record : records)
      column.values[table.row_of(record->candidate)] =
          static_cast<double>(places.at(record->value));
    return column;
  }
  column.is_whole = std::ranges::all_of(records, [](const auto* record) {
    const double value = number_of(record->value);
    return value == std::floor(value);
  });
  column.low = column.high = number_of(records.front()->value);
  for (const ParameterRecord* record : records) {
    const double value = number_of(record->value);
    column.values[table.row_of(record->candidate)] = value;
    column.low = std::min(column.low, value);
    column.high = std::max(column.high, value);
  }
  return column;
}

/// Shares of the values of the candidates [first, end); the last share is the inactive ones.
std::vector<double> shares(const ParameterColumn& column, std::size_t first, std::size_t end) {
  const std::size_t kinds = column.is_category() ? column.categories.size() : kTenths;
  std::vector<double> result(kinds + 1, 0);
  const double width = column.high > column.low ? column.high - column.low : 1;
  for (std::size_t i = first; i < end; ++i) {
    std::size_t kind = kinds;
    if (!std::isnan(column.values[i])) {
      const double place = column.is_category() ? column.values[i]
                                                : kTenths * (column.values[i] - column.low) / width;
      kind = std::min(static_cast<std::size_t>(place), kinds - 1);
    }
    result[kind] += 1 / static_cast<double>(end - first);
  }
  return result;
}

/// The weights of a network are only in its text.
bool is_network(StoreReader& store, CandidateId id) {
  const auto found = candidate(store, id);
  return found && architecture_of_text(found->machine) == Architecture::Network;
}

}  // namespace

std::size_t ParameterTable::row_of(CandidateId candidate) const {
  const auto place =
      std::ranges::lower_bound(candidates, candidate, std::less<>(), &SampledRecord::candidate);
  if (place == candidates.end() || place->candidate != candidate) return candidates.size();
  return static_cast<std::size_t>(place - candidates.begin());
}

ParameterTable parameter_table(std::vector<SampledRecord> candidates,
                               const std::vector<ParameterRecord>& records) {
  ParameterTable table{.candidates = std::move(candidates), .columns = {}};
  std::ranges::sort(table.candidates, std::less<>(), &SampledRecord::candidate);
  std::map<std::string, std::vector<const ParameterRecord*>> by_name;
  for (const ParameterRecord& record : records) {
    // Ignores a candidate that a running campaign added between two queries.
    if (table.row_of(record.candidate) < table.candidates.size())
      by_name[record.parameter].push_back(&record);
  }
  for (const auto& [name, of_name] : by_name)
    table.columns.push_back(column_of(table, name, of_name));
  return table;
}

Expected<ParameterTable> read_parameter_table(StoreReader& store, DesignId design) {
  auto all = candidates(store, design);
  if (!all) return Unexpected(all.error());
  const auto records = parameters(store, design);
  if (!records) return Unexpected(records.error());
  ParameterTable table = parameter_table(std::move(*all), *records);
  if (table.columns.empty() && !table.candidates.empty() &&
      is_network(store, table.candidates.front().candidate)) {
    return bad_input(to_string(design) +
                     " searched the weights of a neural network, which have no names to show; "
                     "`figure machine` draws the winner's");
  }
  if (table.columns.empty()) {
    return unexpected(ErrorKind::NotFound,
                      fmt::format("{} has no candidates with parameters yet", to_string(design)));
  }
  const auto all_designs = designs(store, {.design = design});
  if (!all_designs) return Unexpected(all_designs.error());
  const Flavour* flavour = all_designs->empty()
                               ? nullptr
                               : flavour_of_design(store, design, all_designs->front().flavour);
  for (ParameterColumn& column : table.columns)
    column.words = flavour == nullptr ? column.name : words_of_parameter(column.name, *flavour);
  return table;
}

double movement(const ParameterColumn& column) {
  const std::size_t count = column.values.size();
  const std::size_t third = std::max<std::size_t>(1, count / 3);
  const std::vector<double> early = shares(column, 0, std::min(third, count));
  const std::vector<double> late = shares(column, count - std::min(third, count), count);
  double distance = 0;
  for (std::size_t i = 0; i < early.size(); ++i)
    distance += std::abs(early[i] - late[i]) / 2;
  return distance;
}

Expected<std::vector<std::size_t>> named_columns(const ParameterTable& table,
                                                 std::string_view names, std::size_t most) {
  std::vector<std::size_t> found;
  while (!names.empty()) {
    const std::size_t comma = std::min(names.find(','), names.size());
    std::string_view name = names.substr(0, comma);
    names.remove_prefix(std::min(comma + 1, names.size()));
    while (name.starts_with(' '))
      name.remove_prefix(1);
    while (name.ends_with(' '))
      name.remove_suffix(1);
    const auto column = std::ranges::find(table.columns, name, &ParameterColumn::name);
    if (column == table.columns.end()) {
      std::string known;
      for (const ParameterColumn& other : table.columns)
        known += (known.empty() ? "" : ", ") + other.name;
      return bad_input(fmt::format("--parameter: no candidate of this design has {}; there are {}",
                                   name.empty() ? "an empty name" : name, known));
    }
    found.push_back(static_cast<std::size_t>(column - table.columns.begin()));
  }
  if (found.size() > most) {
    return bad_input(fmt::format("--parameter names {}, and this figure shows at most {} at a time",
                                 found.size(), most));
  }
  return found;
}

}  // namespace swarmsmith
