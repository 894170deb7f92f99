#include "analysis/figures/design_choice.h"

#include <utility>

#include <fmt/format.h>

namespace swarmsmith {

Expected<DesignRecord> chosen_design(StoreReader& store, const FigureOptions& options,
                                     std::string_view name) {
  auto found = designs(store, options.filter);
  if (!found) return Unexpected(found.error());
  if (found->empty()) {
    return unexpected(ErrorKind::NotFound,
                      "the store has no such design; `swarmsmith ls designs` shows what it has");
  }
  if (found->size() > 1) {
    return bad_input(fmt::format(
        "the figure {} shows one design, and there are {}: choose one, such as --design {}", name,
        found->size(), to_string(found->front().design)));
  }
  return std::move(found->front());
}

std::string title_of(const DesignRecord& design) {
  return design.mission + ", " + design.method;
}

}  // namespace swarmsmith
