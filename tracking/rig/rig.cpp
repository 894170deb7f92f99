#include "tracking/rig/rig.h"

#include <cmath>

namespace swarmsmith {

std::array<Point, 4> corners_of(const ReferenceTag& tag) {
  constexpr std::array<Point, 4> kSquare{{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}};
  const double c = std::cos(tag.pose.theta) * tag.edge_m;
  const double s = std::sin(tag.pose.theta) * tag.edge_m;
  std::array<Point, 4> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    corners[i] = {tag.pose.x + c * kSquare[i].x - s * kSquare[i].y,
                  tag.pose.y + s * kSquare[i].x + c * kSquare[i].y};
  }
  return corners;
}

double squares_off(const View& view, const ReferenceTag& tag, const TagCorners& seen) {
  const std::array<Point, 4> corners = corners_of(tag);
  double squares = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ImagePoint at = image_of(view, Point3{corners[i].x, corners[i].y, 0});
    squares += std::pow(seen[i].u - at.u, 2) + std::pow(seen[i].v - at.v, 2);
  }
  return squares;
}

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
