#include "tracking/detection/tag_pattern.h"

#include <cstdint>
#include <memory>
#include <string_view>

#include "base/suggestion.h"
#include "tracking/detection/internal/family_library.h"
#include "tracking/geometry/tag_family.h"

namespace swarmsmith {
namespace {

TagPattern pattern_of(apriltag_family_t& family, int id) {
  const std::unique_ptr<image_u8_t, void (*)(image_u8_t*)> image(
      apriltag_to_image(&family, static_cast<std::uint16_t>(id)), image_u8_destroy);
  // The quiet zone is the outermost ring of the image, except for families that have bits there.
  const int ring = family.reversed_border ? 1 : 0;
  TagPattern pattern{.cells = image->width + 2 * ring, .border_cells = family.width_at_border};
  const int cells = pattern.cells * pattern.cells;
  pattern.black.assign(static_cast<std::size_t>(cells), false);
  for (int row = 0; row < image->height; ++row) {
    for (int column = 0; column < image->width; ++column) {
      const int at = (row + ring) * pattern.cells + column + ring;
      pattern.black[static_cast<std::size_t>(at)] = image->buf[row * image->stride + column] == 0;
    }
  }
  return pattern;
}

}  // namespace

Expected<TagPattern> tag_pattern(const std::string& family, int id) {
  const FamilyPointer made = tag_family_of(family);
  if (made) {
    if (id >= 0 && id < static_cast<int>(made->ncodes)) return pattern_of(*made, id);
    return bad_input("there is no tag " + std::to_string(id) + " in " + family +
                         "; it has the ids 0 to " + std::to_string(made->ncodes - 1),
                     "--ids");
  }
  std::vector<std::string> names;
  for (const TagFamily& known : known_tag_families())
    names.emplace_back(known.name);
  return bad_input(
      "\"" + family + "\" is not one of: " + joined(names) + did_you_mean(family, names),
      "--family");
}

}  // namespace swarmsmith
