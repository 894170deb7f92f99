#include "analysis/figures/internal/design_flavour.h"

#include "sim/control/flavour_file.h"

namespace swarmsmith {

const Flavour* flavour_of_design(StoreReader& store, DesignId design, const std::string& name) {
  if (const auto known = find_flavour(name)) return *known;
  const auto campaign = store.campaign_of(design);
  if (!campaign) return nullptr;
  for (const Flavour* own : own_flavours_in(campaign->row.file)) {
    if (own->name == name) return own;
  }
  return nullptr;
}

}  // namespace swarmsmith
