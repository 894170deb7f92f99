#include "cli/irace/candidate_table.h"

#include <algorithm>
#include <optional>

#include "cli/irace/aligned_table.h"

namespace swarmsmith::cli {

Expected<void> CandidateTable::add(const CandidateRow& row) {
  auto values = parse_parameter_values(row.parameters);
  if (!values) return Unexpected(values.error());
  candidates_[number_of(row.id)] = {.parent = row.parent ? number_of(row.parent) : 0,
                                    .parameters = row.parameters,
                                    .values = std::move(*values),
                                    .command_line = row.machine};
  return {};
}

const CandidateTable::Candidate* CandidateTable::find(std::int64_t number) const {
  const auto found = candidates_.find(number);
  return found == candidates_.end() ? nullptr : &found->second;
}

/// R shows missing texts as <NA>, but missing numbers as NA.
std::vector<std::string> CandidateTable::cells(std::size_t parameter,
                                               std::span<const std::int64_t> numbers) const {
  const std::string& name = space_[parameter].name;
  const bool numeric = space_.is_numeric(parameter);
  const bool whole = std::holds_alternative<Integer>(space_[parameter].domain);
  std::vector<std::string> texts;
  std::vector<std::optional<double>> reals;
  for (const std::int64_t number : numbers) {
    const Candidate* candidate = find(number);
    const auto value =
        candidate == nullptr ? ParameterValues::const_iterator() : candidate->values.find(name);
    const bool active = candidate != nullptr && value != candidate->values.end();
    if (!active) {
      texts.emplace_back(numeric ? "NA" : "<NA>");
      reals.emplace_back();
    } else if (const double* real = std::get_if<double>(&value->second)) {
      texts.push_back(std::to_string(static_cast<std::int64_t>(*real)));
      reals.emplace_back(*real);
    } else {
      texts.push_back(std::get<std::string>(value->second));
      reals.emplace_back();
    }
  }
  return numeric && !whole ? real_cells(reals) : texts;
}

std::string CandidateTable::configurations(std::span<const std::int64_t> numbers,
                                           bool metadata) const {
  std::vector<std::string> names;
  std::vector<std::string> parents;
  for (const std::int64_t number : numbers) {
    names.push_back(std::to_string(number));
    const Candidate* candidate = find(number);
    const std::int64_t parent = candidate == nullptr ? 0 : candidate->parent;
    parents.push_back(parent > 0 ? std::to_string(parent) : "NA");
  }
  std::vector<TableColumn> columns;
  if (metadata) columns.push_back({".ID.", names});
  for (std::size_t i = 0; i < space_.size(); ++i)
    columns.push_back({space_[i].name, cells(i, numbers)});
  if (metadata) columns.push_back({".PARENT.", parents});
  return aligned_table(names, columns);
}

std::string CandidateTable::command_lines(std::span<const std::int64_t> numbers) const {
  std::size_t width = 0;
  for (const std::int64_t number : numbers)
    width = std::max(width, std::to_string(number).size());
  std::string text;
  for (const std::int64_t number : numbers) {
    const std::string name = std::to_string(number);
    text += name + std::string(width - name.size(), ' ') + "  " + command_line(number) + '\n';
  }
  return text;
}

std::string CandidateTable::parameters(std::int64_t number) const {
  const Candidate* candidate = find(number);
  return candidate == nullptr ? "" : candidate->parameters;
}

std::string CandidateTable::command_line(std::int64_t number) const {
  const Candidate* candidate = find(number);
  return candidate == nullptr ? "" : candidate->command_line;
}

}  // namespace swarmsmith::cli
