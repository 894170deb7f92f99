#include "cli/dashboard/question.h"

#include <charconv>
#include <utility>

#include "analysis/records/records.h"

namespace swarmsmith::cli {

const std::string& Question::text(const std::string& name) const {
  static const std::string kNone;
  const auto found = parameters.find(name);
  return found == parameters.end() ? kNone : found->second;
}

Expected<std::int64_t> integer_parameter(const Parameters& parameters, const std::string& name,
                                         std::int64_t otherwise, std::int64_t least,
                                         std::int64_t most) {
  const auto found = parameters.find(name);
  if (found == parameters.end() || found->second.empty()) return otherwise;
  const std::string& given = found->second;
  std::int64_t value = 0;
  const char* const end = given.data() + given.size();
  const auto [stop, error] = std::from_chars(given.data(), end, value);
  if (error == std::errc() && stop == end && value >= least && value <= most) return value;
  return bad_input("must be a whole number from " + std::to_string(least) + " to " +
                       std::to_string(most) + ", not \"" + given + "\"",
                   name);
}

Expected<std::optional<DesignId>> Question::design_parameter() const {
  const std::string& given = text("design");
  if (given.empty()) return std::optional<DesignId>();
  const auto named = id_from_text<DesignTag>(given);
  if (named) return std::optional(*named);
  return bad_input("must be a design such as d3, not \"" + given + "\"", "design");
}

JsonObject answer_object() {
  return std::move(JsonObject().add("v", 1));
}

void add_columns(JsonObject& object, const Rows& rows) {
  for (std::size_t column = 0; column < rows.columns.size(); ++column) {
    object.add(rows.columns[column],
               json_list(rows.cells, [&](const std::vector<StoreReader::Cell>& cells) {
                 return cell_as_json(cells[column]);
               }));
  }
}

Expected<Rows> rows_of(const Question& question, const std::string& sql) {
  return select(question.store, sql, kRecordLimits);
}

Expected<void> check_design(const Question& question) {
  const auto rows = rows_of(
      question, "SELECT 1 FROM v_designs WHERE design = " + std::to_string(question.design.value));
  if (!rows) return Unexpected(rows.error());
  if (!rows->cells.empty()) return {};
  return unexpected(ErrorKind::NotFound, "the store has no such design",
                    to_string(question.design));
}

}  // namespace swarmsmith::cli
