#include "storage/internal/view_text.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/assert.h"
#include "embedded/kViews.h"
#include "storage/stored_enums.h"

namespace swarmsmith {
namespace {

/// Rows of flavour_name without the flavour: ('s', 0, 'exploration'), ...
std::vector<std::string> rows_of(const Flavour& flavour) {
  std::vector<std::string> rows;
  for (const ModuleSpec& spec : flavour.behaviours)
    rows.push_back(fmt::format("'s', {}, '{}'", spec.number, spec.id));
  for (const ModuleSpec& spec : flavour.conditions)
    rows.push_back(fmt::format("'c', {}, '{}'", spec.number, spec.id));
  for (const LabelSpec& spec : flavour.floor.labels)
    rows.push_back(fmt::format("'l', {}, '{}'", spec.number, name_of(spec.label)));
  return rows;
}

/// Replaces the only occurrence of `name` in the views.
void put(std::string& views, std::string_view name, const std::string& text) {
  const std::size_t at = views.find(name);
  SWARMSMITH_ASSERT(at != std::string::npos, "views.sql has a place for the generated part");
  views.replace(at, name.size(), text);
}

/// Replaces each NAME(COLUMN) by the field that stored_enums.h has for the purpose in the column.
void replace_purposes(std::string& views, std::string_view name,
                      std::string_view PurposeFacts::*field) {
  const std::string call = std::string(name) + "(";
  std::string whens;
  for (const Purpose purpose : all_purposes()) {
    whens +=
        fmt::format(" WHEN {} THEN '{}'", static_cast<int>(purpose), (*facts_of(purpose)).*field);
  }
  for (std::size_t at = 0; (at = views.find(call, at)) != std::string::npos;) {
    const std::size_t column = at + call.size();
    const std::size_t end = views.find(')', column);
    const std::string text =
        fmt::format("CASE {}{} END", views.substr(column, end - column), whens);
    views.replace(at, end + 1 - at, text);
  }
}

}  // namespace

/// Flavours with the same rows as the first one share its rows. If two flavours of merged campaigns
/// have the same name, the first one is used.
std::string flavour_view(const std::vector<const Flavour*>& own) {
  std::vector<const Flavour*> all(all_flavours().begin(), all_flavours().end());
  for (const Flavour* flavour : own) {
    if (std::ranges::find(all, flavour->name, &Flavour::name) == all.end()) all.push_back(flavour);
  }
  std::string same;
  std::string others;
  const std::vector<std::string> first = rows_of(*all.front());
  for (const Flavour* flavour : all) {
    const std::vector<std::string> rows = rows_of(*flavour);
    if (rows == first) {
      same += fmt::format("{}('{}')", same.empty() ? "" : ", ", flavour->name);
      continue;
    }
    for (const std::string& row : rows)
      others += fmt::format("{}('{}', {})", others.empty() ? "" : ",\n  ", flavour->name, row);
  }
  return fmt::format(
      "CREATE VIEW flavour_name(flavour, kind, number, name) AS\n"
      "WITH same(flavour) AS (VALUES {})\n"
      "SELECT s.flavour, v.column1, v.column2, v.column3\n"
      "FROM same AS s CROSS JOIN (VALUES\n  ({})) AS v\n"
      "UNION ALL VALUES\n  {};\n",
      same, fmt::join(first, "),\n  ("), others);
}

std::string our_views(const std::vector<const Flavour*>& own) {
  std::string views(kViews);
  put(views, "-- flavour_name\n", flavour_view(own));
  put(views, "PURPOSES_THAT_COUNT",
      numbers_in_sql([](const PurposeFacts& facts) { return !facts.counts_as.empty(); }));
  replace_purposes(views, "PURPOSE_LETTER", &PurposeFacts::letter);
  replace_purposes(views, "PURPOSE_WORD", &PurposeFacts::word);
  replace_purposes(views, "PURPOSE_COUNTS_AS", &PurposeFacts::counts_as);
  return views;
}

}  // namespace swarmsmith
