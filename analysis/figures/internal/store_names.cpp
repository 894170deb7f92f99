#include "analysis/figures/internal/store_names.h"

#include <algorithm>

#include "analysis/records/names.h"
#include "analysis/records/records.h"

namespace swarmsmith {
namespace {

void sort(std::vector<std::string>& names) {
  std::ranges::sort(names, NameOrder());
  names.erase(std::unique(names.begin(), names.end()), names.end());
}

}  // namespace

Expected<StoreNames> names_of(StoreReader& store) {
  const auto all = designs(store, {});
  if (!all) return Unexpected(all.error());
  StoreNames names;
  for (const DesignRecord& design : *all) {
    names.methods.push_back(design.method);
    names.missions.push_back(design.mission);
  }
  const auto end = store.query(
      "SELECT DISTINCT source FROM v_design_scores", {}, [](const auto&) {},
      [&](const std::vector<StoreReader::Cell>& cells) {
        names.sources.push_back(cells.front().text);
      });
  if (!end) return Unexpected(end.error());
  sort(names.methods);
  sort(names.missions);
  sort(names.sources);
  return names;
}

std::size_t place_of(const std::vector<std::string>& names, std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

}  // namespace swarmsmith
