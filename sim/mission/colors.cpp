#include "sim/mission/colors.h"

namespace swarmsmith {

std::optional<Rgb> color_from_name(std::string_view name) {
  for (const NamedColor& named : kNamedColors) {
    if (named.name == name) return named.color;
  }
  return std::nullopt;
}

}  // namespace swarmsmith
