#include "tests/fuzz/fuzz.h"
#include "tracking/rig/rig_file.h"

namespace swarmsmith::fuzz {

/// Arena files without calibrations: refused with reasons, places and codes, or read to a rig that
/// holds what tracking takes for granted.
void run(std::string_view input) {
  const auto nothing = [](CalibrationKind, const std::string&,
                          const std::string&) -> Expected<std::optional<std::string>> {
    return std::nullopt;
  };
  const auto rig = parse_rig(input, "arena.toml", nothing);
  if (!rig) return require_reasons(rig.error(), "E_");
  require(!rig->cameras.empty(), "a rig has a camera");
  for (const RobotSetup& robot : rig->robots) {
    require(robot.edge_m > 0 && robot.height_m >= 0, "a tag has a size and a height");
    for (const CameraSetup& camera : rig->cameras)
      require(robot.height_m < camera.least_height_m, "a tag is below the cameras");
  }
  require(misfits(*rig).empty(), "without calibrations none misfits");
}

}  // namespace swarmsmith::fuzz
