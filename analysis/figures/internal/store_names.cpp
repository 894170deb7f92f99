#include "analysis/figures/internal/store_names.h"

#include <algorithm>
#include <utility>

#include "analysis/records/names.h"
#include "analysis/records/records.h"
#include "sim/mission/mission.h"

namespace swarmsmith {
namespace {

void sort(std::vector<std::string>& names) {
  std::ranges::sort(names, NameOrder());
  names.erase(std::unique(names.begin(), names.end()), names.end());
}

/// Sets the parameters that decide the unit, for the kinds of score that have them, from the
/// campaign's settings.
struct PutUnit {
  std::string at;
  std::string unit;

  void operator()(const ScoreField& /*field*/, When& value) const {
    value = when_from_name(at).value_or(value);
  }
  void operator()(const ScoreField& field, std::string& value) const {
    if (field.key == "unit") value = unit;
  }
  template <class Value>
  void operator()(const ScoreField& /*field*/, Value& /*value*/) const {}
};

std::string unit_of_score(const std::string& mission, const std::string& kind,
                          const std::string& at, const std::string& unit) {
  if (kind.empty()) {  // imported designs: only the names of their missions are known
    const auto known = built_in_mission(mission);
    return known ? unit_of(known->rule) : "";
  }
  auto rule = score_of_kind(kind);
  if (!rule) return "";
  PutUnit put{at, unit};
  visit_fields(*rule, put);
  return unit_of(*rule);
}

/// Reads the units from the campaigns' deciding settings: a JSON object of TOML values, in which
/// texts have quotes.
Expected<std::map<std::string, std::string>> units_of(StoreReader& store) {
  std::map<std::string, std::string> units;
  const auto end = store.query(
      "WITH asked AS (SELECT d.mission, iif(json_valid(c.deciding), c.deciding, '{}') AS deciding "
      "FROM v_designs AS d JOIN v_campaigns AS c ON c.campaign = d.campaign GROUP BY d.mission) "
      "SELECT mission, trim(deciding ->> ('$.\"mission.' || mission || '.score.kind\"'), '\"'), "
      "trim(deciding ->> ('$.\"mission.' || mission || '.score.at\"'), '\"'), "
      "trim(deciding ->> '$.\"simulator.kind\"', '\"'), "
      "trim(deciding ->> ('$.\"mission.' || mission || '.score.unit\"'), '\"') FROM asked",
      {}, [](const std::vector<std::string>&) {},
      [&](const std::vector<StoreReader::Cell>& cells) {
        const bool by_programs = cells[3].text == "command";
        std::string unit =
            by_programs ? "minus the cost"
                        : unit_of_score(cells[0].text, cells[1].text, cells[2].text, cells[4].text);
        if (!unit.empty()) units.emplace(cells[0].text, std::move(unit));
      });
  if (!end) return Unexpected(end.error());
  return units;
}

}  // namespace

std::string StoreNames::title_of(const std::string& mission) const {
  const auto unit = units.find(mission);
  return unit == units.end() ? as_words(mission) : as_words(mission) + " (" + unit->second + ")";
}

Expected<StoreNames> names_of(StoreReader& store) {
  const auto all = designs(store, {});
  if (!all) return Unexpected(all.error());
  StoreNames names;
  for (const DesignRecord& design : *all) {
    names.methods.push_back(design.method);
    names.missions.push_back(design.mission);
  }
  auto units = units_of(store);
  if (!units) return Unexpected(units.error());
  names.units = std::move(*units);
  sort(names.methods);
  sort(names.missions);
  return names;
}

Expected<StoreNames> names_with_sources(StoreReader& store) {
  auto names = names_of(store);
  if (!names) return names;
  const auto end = store.query(
      "SELECT DISTINCT source FROM v_design_scores", {}, [](const auto&) {},
      [&](const std::vector<StoreReader::Cell>& cells) {
        names->sources.push_back(cells.front().text);
      });
  if (!end) return Unexpected(end.error());
  sort(names->sources);
  return names;
}

std::size_t place_of(const std::vector<std::string>& names, std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

}  // namespace swarmsmith
