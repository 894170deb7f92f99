#include "storage/internal/view_text.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/assert.h"
#include "embedded/kViews.h"

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

}  // namespace

/// The rows of the first flavour stand once for all flavours that have the same. Of two flavours
/// with one name, of merged campaigns, the first counts.
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
  constexpr std::string_view kPlace = "-- flavour_name\n";
  std::string views(kViews);
  const std::size_t at = views.find(kPlace);
  SWARMSMITH_ASSERT(at != std::string::npos, "views.sql has the place of flavour_name");
  return views.replace(at, kPlace.size(), flavour_view(own));
}

}  // namespace swarmsmith
