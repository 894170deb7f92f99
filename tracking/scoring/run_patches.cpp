#include "tracking/scoring/run_patches.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/math.h"
#include "base/overloaded.h"
#include "base/plain_text.h"
#include "sim/files/color_text.h"
#include "sim/mission/polygon.h"
#include "tracking/rig/issue.h"

namespace swarmsmith {
namespace {

/// People write positions in logs with a precision of centimetres.
constexpr double kSamePlace_m = 0.005;

double distance(Point a, Point b) {
  return hypot(a.x - b.x, a.y - b.y);
}

Unexpected wrong(const std::string& text, const Mission& mission) {
  return Unexpected(error_of(IssueCode::Config, text, mission.name));
}

/// The number of patches of each colour must agree with the mission; otherwise the log is of
/// another mission.
std::optional<std::string> wrong_number(const Mission& mission, const std::vector<Patch>& patches) {
  for (const ShuffledPatches::Share& share : mission.shuffled.shares) {
    const auto count = std::ranges::count(patches, share.color, &Patch::color);
    if (count != share.count) {
      return fmt::format(
          "the run has {}, and the mission {}",
          counted(count, color_text(share.color) + " patch", color_text(share.color) + " patches"),
          share.count);
    }
  }
  return std::nullopt;
}

}  // namespace

Point centre_of(const Patch& patch) {
  return std::visit(Overloaded{[](const Disc& disc) { return disc.centre; },
                               [](const Rectangle& box) { return box.centre; },
                               [](const FloorImage& image) { return image.area.centre; }},
                    patch.shape);
}

Expected<std::vector<Patch>> run_patches(const Mission& mission,
                                         const std::optional<std::vector<Patch>>& patches) {
  const std::vector<Rectangle>& places = mission.shuffled.places;
  const bool has_none = !patches || patches->empty();
  if (places.empty()) {
    if (has_none) return std::vector<Patch>{};
    return wrong("the run log has patches, and the mission's floor is always the same", mission);
  }
  if (has_none) {
    return Unexpected(error_of(
        IssueCode::LayoutMissing,
        "the mission's patches are shuffled for each run; say them in the run log ([[patch]]), or "
        "let them be measured (layout = \"measured\")",
        mission.name));
  }
  std::vector<Patch> found;
  for (const Patch& patch : *patches) {
    const Point at = centre_of(patch);
    const auto nearest = std::ranges::min_element(
        places, {}, [&](const Rectangle& p) { return distance(p.centre, at); });
    if (!(distance(nearest->centre, at) <= kSamePlace_m)) {
      return wrong(fmt::format("there is no place for a patch at {}; the nearest is {}",
                               point_text(at), point_text(nearest->centre)),
                   mission);
    }
    if (std::ranges::find(mission.shuffled.shares, patch.color, &ShuffledPatches::Share::color) ==
        mission.shuffled.shares.end()) {
      return wrong(fmt::format("the mission has no {} patches", color_text(patch.color)), mission);
    }
    if (std::ranges::any_of(found,
                            [&](const Patch& p) { return centre_of(p) == nearest->centre; })) {
      return wrong("there are two patches at " + point_text(nearest->centre), mission);
    }
    found.push_back({*nearest, patch.color});
  }
  if (const auto number = wrong_number(mission, found)) return wrong(*number, mission);
  return found;
}

}  // namespace swarmsmith
