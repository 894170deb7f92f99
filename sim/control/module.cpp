#include "sim/control/module.h"

#include <array>
#include <cstddef>

namespace swarmsmith {
namespace {

/// In the order of the enumerators.
constexpr std::array<std::string_view, 13> kIds = {"exploration",
                                                   "stop",
                                                   "phototaxis",
                                                   "anti_phototaxis",
                                                   "attraction",
                                                   "repulsion",
                                                   "black_floor",
                                                   "gray_floor",
                                                   "white_floor",
                                                   "neighbour_count",
                                                   "inverted_neighbour_count",
                                                   "fixed_probability",
                                                   "color_detection"};
static_assert(static_cast<std::size_t>(Module::ColorDetection) + 1 == kIds.size());

}  // namespace

std::string_view id_of(Module module) {
  return kIds[static_cast<std::size_t>(module)];
}

std::optional<Module> module_from_id(std::string_view id) {
  for (std::size_t i = 0; i < kIds.size(); ++i) {
    if (kIds[i] == id) return static_cast<Module>(i);
  }
  return std::nullopt;
}

}  // namespace swarmsmith
