#include "sim/files/internal/arena_text.h"

#include <variant>

#include "base/base64.h"
#include "base/overloaded.h"
#include "sim/files/color_text.h"

namespace swarmsmith {
namespace {

std::string color_value(Rgb color) {
  return quoted_text(color_text(color));
}

/// The inline table of one spot.
std::string spot_text(const Patch& patch) {
  return std::visit(Overloaded{[&](const Disc& disc) {
                                 return "{ shape = \"circle\", x = " + number_text(disc.centre.x) +
                                        ", y = " + number_text(disc.centre.y) +
                                        ", diameter = " + number_text(2 * disc.radius_m) +
                                        ", color = " + color_value(patch.color) + " }";
                               },
                               [&](const Rectangle& rectangle) {
                                 return "{ shape = \"rectangle\", " + rectangle_text(rectangle) +
                                        ", color = " + color_value(patch.color) + " }";
                               },
                               [&](const FloorImage& image) {
                                 return "{ shape = \"image\", " + rectangle_text(image.area) +
                                        ", data = \"" + base64_text(image.picture->png()) + "\" }";
                               }},
                    patch.shape);
}

/// The inline table `shuffled`.
std::string shuffled_text(const ShuffledPatches& shuffled) {
  const std::string colors = list_of(shuffled.shares, [](const ShuffledPatches::Share& share) {
    return color_key(share.color) + " = " + std::to_string(share.count);
  });
  const std::string places = list_of(
      shuffled.places, [](const Rectangle& place) { return "{ " + rectangle_text(place) + " }"; });
  return "{ colors = { " + colors + " }, places = [" + places + "] }";
}

std::string obstacle_text(const Obstacle& obstacle) {
  return "{ " + outline_text(obstacle.outline) + ", " + pose_text(obstacle.pose) +
         ", height = " + number_text(obstacle.height_m) + " }";
}

std::string object_text(const MovableObject& object) {
  return "{ " + outline_text(object.outline) + ", " + pose_text(object.start) +
         ", mass = " + number_text(object.mass_kg) +
         ", friction = " + number_text(object.friction_N) +
         ", height = " + number_text(object.height_m) + " }";
}

std::string light_text(const Light& light) {
  return "{ x = " + number_text(light.x_m) + ", y = " + number_text(light.y_m) +
         ", z = " + number_text(light.z_m) + ", intensity = " + number_text(light.intensity_cd) +
         " }";
}

}  // namespace

std::string point_list(const std::vector<Point>& points) {
  return "[" +
         list_of(points,
                 [](Point point) {
                   return "[" + number_text(point.x) + ", " + number_text(point.y) + "]";
                 }) +
         "]";
}

std::vector<SectionLine> outline_lines(const Outline& outline) {
  using Lines = std::vector<SectionLine>;
  return std::visit(
      Overloaded{
          [](const CircleOutline& circle) {
            return Lines{{"shape", "\"circle\""}, {"diameter", number_text(2 * circle.radius_m)}};
          },
          [](const BoxOutline& box) {
            return Lines{{"shape", "\"box\""},
                         {"length", number_text(box.length_m)},
                         {"width", number_text(box.width_m)}};
          },
          [](const PolygonOutline& polygon) {
            return Lines{{"shape", "\"polygon\""}, {"corners", point_list(polygon.corners)}};
          }},
      outline);
}

std::string outline_text(const Outline& outline) {
  return list_of(outline_lines(outline),
                 [](const SectionLine& line) { return line.key + " = " + line.value; });
}

std::string pose_text(const Pose& pose) {
  return "x = " + number_text(pose.x) + ", y = " + number_text(pose.y) +
         ", theta = " + number_text(pose.theta);
}

std::string rectangle_text(const Rectangle& shape) {
  return "x = " + number_text(shape.centre.x) + ", y = " + number_text(shape.centre.y) +
         ", width = " + number_text(shape.width_m) + ", height = " + number_text(shape.height_m);
}

/// The walls of the thesis are written by name; other walls by their corners, however they were
/// given.
std::vector<SectionLine> arena_lines(const Mission& mission) {
  const Arena& arena = mission.arena;
  std::vector<SectionLine> lines;
  if (arena.walls == dodecagon_of_the_thesis().walls) {
    lines.push_back({"shape", "\"dodecagon\""});
  } else {
    lines.push_back({"shape", "\"polygon\""});
    lines.push_back({"corners", point_list(corners_of(arena))});
  }
  lines.push_back({"wall_height", number_text(arena.wall_height_m)});
  lines.push_back({"floor", color_value(arena.floor)});
  lines.push_back({"spots", "[" + list_of(arena.patches, spot_text) + "]"});
  if (!mission.shuffled.places.empty()) {
    lines.push_back({"shuffled", shuffled_text(mission.shuffled)});
  }
  lines.push_back({"obstacles", "[" + list_of(arena.obstacles, obstacle_text) + "]"});
  lines.push_back({"objects", "[" + list_of(arena.objects, object_text) + "]"});
  lines.push_back({"lights", "[" + list_of(arena.lights, light_text) + "]"});
  return lines;
}

}  // namespace swarmsmith
