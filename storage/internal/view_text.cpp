#include "storage/internal/view_text.h"

#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/assert.h"
#include "embedded/kViews.h"
#include "sim/control/flavour.h"

namespace swarmsmith {
namespace {

/// Rows of flavour_name without the flavour: ('s', 0, 'exploration'), ...
std::vector<std::string> rows_of(const Flavour& flavour) {
  std::vector<std::string> rows;
  for (const ModuleSpec& spec : flavour.behaviours)
    rows.push_back(fmt::format("'s', {}, '{}'", spec.number, id_of(spec.module)));
  for (const ModuleSpec& spec : flavour.conditions)
    rows.push_back(fmt::format("'c', {}, '{}'", spec.number, id_of(spec.module)));
  for (const LabelSpec& spec : flavour.floor.labels)
    rows.push_back(fmt::format("'l', {}, '{}'", spec.number, name_of(spec.label)));
  return rows;
}

/// The rows of the first flavour stand once for all flavours that have the same.
std::string made_flavour_view() {
  std::string same;
  std::string others;
  const std::vector<std::string> first = rows_of(*all_flavours().front());
  for (const Flavour* flavour : all_flavours()) {
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

}  // namespace

const std::string& flavour_view() {
  static const std::string kView = made_flavour_view();
  return kView;
}

const std::string& our_views() {
  static const std::string kOurs = [] {
    constexpr std::string_view kPlace = "-- flavour_name\n";
    std::string views(kViews);
    const std::size_t at = views.find(kPlace);
    SWARMSMITH_ASSERT(at != std::string::npos, "views.sql has the place of flavour_name");
    return views.replace(at, kPlace.size(), flavour_view());
  }();
  return kOurs;
}

}  // namespace swarmsmith
