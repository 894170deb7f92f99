#include "tracking/printing/tag_pattern.h"

#include <array>
#include <memory>
#include <string_view>

#include "base/suggestion.h"
#include "tracking/geometry/tag_family.h"

extern "C" {
#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h10.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagCircle21h7.h>
#include <apriltag/tagCircle49h12.h>
#include <apriltag/tagCustom48h12.h>
#include <apriltag/tagStandard41h12.h>
#include <apriltag/tagStandard52h13.h>
}

namespace swarmsmith {
namespace {

struct KnownFamily {
  std::string_view name;
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
};

constexpr std::array<KnownFamily, 9> kFamilies = {{
    {"tag36h11", tag36h11_create, tag36h11_destroy},
    {"tag25h9", tag25h9_create, tag25h9_destroy},
    {"tag16h5", tag16h5_create, tag16h5_destroy},
    {"tag36h10", tag36h10_create, tag36h10_destroy},
    {"tagStandard41h12", tagStandard41h12_create, tagStandard41h12_destroy},
    {"tagStandard52h13", tagStandard52h13_create, tagStandard52h13_destroy},
    {"tagCircle21h7", tagCircle21h7_create, tagCircle21h7_destroy},
    {"tagCircle49h12", tagCircle49h12_create, tagCircle49h12_destroy},
    {"tagCustom48h12", tagCustom48h12_create, tagCustom48h12_destroy},
}};

TagPattern pattern_of(apriltag_family_t& family, int id) {
  const std::unique_ptr<image_u8_t, void (*)(image_u8_t*)> image(apriltag_to_image(&family, id),
                                                                 image_u8_destroy);
  // The quiet zone is the outermost ring of the image, save where a family has bits there.
  const int ring = family.reversed_border ? 1 : 0;
  TagPattern pattern{.cells = image->width + 2 * ring, .border_cells = family.width_at_border};
  pattern.black.assign(static_cast<std::size_t>(pattern.cells * pattern.cells), false);
  for (int row = 0; row < image->height; ++row) {
    for (int column = 0; column < image->width; ++column) {
      const auto at = static_cast<std::size_t>((row + ring) * pattern.cells + column + ring);
      pattern.black[at] = image->buf[row * image->stride + column] == 0;
    }
  }
  return pattern;
}

}  // namespace

Expected<TagPattern> tag_pattern(const std::string& family, int id) {
  for (const KnownFamily& known : kFamilies) {
    if (known.name != family) continue;
    const std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)> made(known.create(),
                                                                                known.destroy);
    if (id >= 0 && id < static_cast<int>(made->ncodes)) return pattern_of(*made, id);
    return bad_input("there is no tag " + std::to_string(id) + " in " + family +
                         "; it has the ids 0 to " + std::to_string(made->ncodes - 1),
                     "--ids");
  }
  std::vector<std::string> names;
  for (const TagFamily& known : known_tag_families())
    names.emplace_back(known.name);
  return bad_input("\"" + family + "\" is none of: " + joined(names) + did_you_mean(family, names),
                   "--family");
}

}  // namespace swarmsmith
