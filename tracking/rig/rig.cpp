#include "tracking/rig/rig.h"

namespace swarmsmith {

std::optional<View> Rig::view_of(const CameraSetup& camera) const {
  const auto model = models.find(camera.model_file);
  const auto place = places.find(camera.place_file);
  if (model == models.end() || place == places.end()) return std::nullopt;
  return View{model->second.model, place->second.place};
}

std::optional<TagOffset> Rig::offset_of(const RobotSetup& robot) const {
  const auto found = offsets.find(robot.offset_file);
  if (found == offsets.end()) return std::nullopt;
  return found->second.offset;
}

}  // namespace swarmsmith
