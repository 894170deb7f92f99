#include "tracking/geometry/tag_family.h"

#include <array>

namespace swarmsmith {

std::span<const TagFamily> known_tag_families() {
  // From version 3.3 of the apriltag library.
  static constexpr std::array<TagFamily, 9> kFamilies = {{{"tag36h11", 587},
                                                          {"tag36h10", 2320},
                                                          {"tag25h9", 35},
                                                          {"tag16h5", 30},
                                                          {"tagCircle21h7", 38},
                                                          {"tagStandard41h12", 2115},
                                                          {"tagStandard52h13", 48'714},
                                                          {"tagCircle49h12", 65'535},
                                                          {"tagCustom48h12", 42'211}}};
  return kFamilies;
}

}  // namespace swarmsmith
