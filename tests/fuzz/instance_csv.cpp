#include "sim/mission/instance_csv.h"

#include <cmath>

#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {
namespace {

void check_starts(std::string_view text) {
  const auto starts = parse_starts_csv(text);
  if (!starts) return require_reasons({starts.error()});
  for (const auto& [seed, poses] : *starts) {
    require(!poses.empty(), "a seed has robots");
    for (const Pose& pose : poses) {
      require(std::isfinite(pose.x) && std::isfinite(pose.y), "a robot is somewhere");
      require(std::fabs(pose.theta) <= 3.1415926535897936, "an angle is wrapped");
    }
  }
}

void check_patches(std::string_view text) {
  const auto patches = parse_patches_csv(text);
  if (!patches) return require_reasons({patches.error()});
  for (const auto& [seed, placements] : *patches) {
    for (const PatchPlacement& patch : placements)
      require(std::isfinite(patch.centre.x) && std::isfinite(patch.centre.y),
              "a patch has a place");
  }
}

}  // namespace

/// Starts and patches that were written down elsewhere.
void run(std::string_view input) {
  check_starts(input);
  check_patches(input);
}

}  // namespace swarmsmith::fuzz
