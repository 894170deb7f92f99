#include "tracking/rig/rig.h"

#include <algorithm>
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

const CameraSetup* Rig::setup_of(const std::string& camera) const {
  if (camera.empty() && cameras.size() == 1) return &cameras.front();
  const auto found = std::ranges::find(cameras, camera, &CameraSetup::name);
  return found == cameras.end() ? nullptr : &*found;
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
  if (const OffsetCalibration* const own = of_tag(found->second, robot.tag)) return own->offset;
  // For a robot with one tag, the tag's number is checked elsewhere (`misfits`).
  const bool is_first = std::ranges::find(robots, robot.tag, &RobotSetup::tag) != robots.end();
  return is_first ? std::optional(found->second.offset) : std::nullopt;
}

std::vector<RobotSetup> each_tag(const RobotSetup& robot) {
  std::vector<RobotSetup> tags{robot};
  tags.insert(tags.end(), robot.more_tags.begin(), robot.more_tags.end());
  return tags;
}

std::vector<RobotSetup> each_tag(std::span<const RobotSetup> robots) {
  std::vector<RobotSetup> tags;
  for (const RobotSetup& robot : robots) {
    tags.push_back(robot);
    tags.insert(tags.end(), robot.more_tags.begin(), robot.more_tags.end());
  }
  return tags;
}

std::string tags_text(const RobotSetup& robot) {
  std::string text = (robot.more_tags.empty() ? "tag " : "tags ") + std::to_string(robot.tag);
  for (const RobotSetup& tag : robot.more_tags)
    text += ", " + std::to_string(tag.tag);
  return text;
}

const OffsetCalibration* of_tag(const OffsetCalibration& calibration, int tag) {
  if (calibration.tag == tag) return &calibration;
  const auto found = std::ranges::find(calibration.more_tags, tag, &OffsetCalibration::tag);
  return found == calibration.more_tags.end() ? nullptr : &*found;
}

}  // namespace swarmsmith
