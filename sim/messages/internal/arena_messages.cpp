#include "sim/messages/internal/arena_messages.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include "base/overloaded.h"
#include "sim/mission/polygon.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kMostCorners = 8;  ///< of an outline

void write(const Patch& patch, pb::Patch& out) {
  std::visit(
      Overloaded{[&](const Disc& disc) { write(disc, *out.mutable_disc()); },
                 [&](const Rectangle& rectangle) { write(rectangle, *out.mutable_rectangle()); },
                 [&](const FloorImage& image) {
                   write(image.area, *out.mutable_image()->mutable_area());
                   out.mutable_image()->set_png(image.picture->png());
                 }},
      patch.shape);
  write(patch.color, *out.mutable_color());
}

}  // namespace

void write(Rgb color, pb::Color& out) {
  out.set_r(color.r);
  out.set_g(color.g);
  out.set_b(color.b);
}

void write(Point point, pb::Point& out) {
  out.set_x_m(point.x);
  out.set_y_m(point.y);
}

void write(const Pose& pose, pb::Pose& out) {
  out.set_x_m(pose.x);
  out.set_y_m(pose.y);
  out.set_theta_rad(pose.theta);
}

void write(const Disc& disc, pb::Disc& out) {
  write(disc.centre, *out.mutable_centre());
  out.set_radius_m(disc.radius_m);
}

void write(const Rectangle& rectangle, pb::Rectangle& out) {
  write(rectangle.centre, *out.mutable_centre());
  out.set_width_m(rectangle.width_m);
  out.set_height_m(rectangle.height_m);
}

void write(const Outline& outline, pb::Outline& out) {
  std::visit(
      Overloaded{[&](const CircleOutline& circle) { out.set_circle_radius_m(circle.radius_m); },
                 [&](const BoxOutline& box) {
                   out.mutable_box()->set_length_m(box.length_m);
                   out.mutable_box()->set_width_m(box.width_m);
                 },
                 [&](const PolygonOutline& polygon) {
                   pb::Outline::Polygon& to = *out.mutable_polygon();
                   for (const Point corner : polygon.corners)
                     write(corner, *to.add_corners());
                 }},
      outline);
}

void write(const Arena& arena, pb::Arena& out) {
  for (const Wall& wall : arena.walls) {
    pb::Wall& to = *out.add_walls();
    write(wall.from, *to.mutable_from());
    write(wall.to, *to.mutable_to());
  }
  out.set_wall_height_m(arena.wall_height_m);
  write(arena.floor, *out.mutable_floor());
  for (const Patch& patch : arena.patches)
    write(patch, *out.add_patches());
  for (const Obstacle& obstacle : arena.obstacles) {
    pb::Obstacle& to = *out.add_obstacles();
    write(obstacle.outline, *to.mutable_outline());
    write(obstacle.pose, *to.mutable_pose());
    to.set_height_m(obstacle.height_m);
  }
  for (const MovableObject& object : arena.objects) {
    pb::MovableObject& to = *out.add_objects();
    write(object.outline, *to.mutable_outline());
    write(object.start, *to.mutable_start());
    to.set_mass_kg(object.mass_kg);
    to.set_friction_n(object.friction_N);
    to.set_height_m(object.height_m);
  }
  for (const Light& light : arena.lights) {
    pb::Light& to = *out.add_lights();
    to.set_x_m(light.x_m);
    to.set_y_m(light.y_m);
    to.set_z_m(light.z_m);
    to.set_intensity_cd(light.intensity_cd);
  }
}

void ArenaReader::complain(const std::string& field, const std::string& text) {
  if (!complaint.empty()) return;
  where = field;
  complaint = text;
}

double ArenaReader::number(double value, const std::string& field) {
  if (!std::isfinite(value)) complain(field, "a number that is not finite");
  return value;
}

double ArenaReader::size(double value, const std::string& field) {
  if (!(number(value, field) > 0)) complain(field, "a size that is not positive");
  return value;
}

Rgb ArenaReader::color(const pb::Color& message, const std::string& field) {
  for (const std::uint32_t channel : {message.r(), message.g(), message.b()}) {
    if (channel > 255) complain(field, "a colour channel of " + std::to_string(channel));
  }
  return {static_cast<std::uint8_t>(message.r()), static_cast<std::uint8_t>(message.g()),
          static_cast<std::uint8_t>(message.b())};
}

Point ArenaReader::point(const pb::Point& message, const std::string& field) {
  return {number(message.x_m(), field), number(message.y_m(), field)};
}

Pose ArenaReader::pose(const pb::Pose& message, const std::string& field) {
  return {number(message.x_m(), field), number(message.y_m(), field),
          number(message.theta_rad(), field)};
}

Disc ArenaReader::disc(const pb::Disc& message, const std::string& field) {
  return {point(message.centre(), field + ".centre"),
          number(message.radius_m(), field + ".radius")};
}

Rectangle ArenaReader::rectangle(const pb::Rectangle& message, const std::string& field) {
  return {point(message.centre(), field + ".centre"), number(message.width_m(), field + ".width"),
          number(message.height_m(), field + ".height")};
}

Outline ArenaReader::outline(const pb::Outline& message, const std::string& field) {
  switch (message.shape_case()) {
    case pb::Outline::kCircleRadiusM:
      return CircleOutline{size(message.circle_radius_m(), field + ".radius")};
    case pb::Outline::kBox:
      return BoxOutline{size(message.box().length_m(), field + ".length"),
                        size(message.box().width_m(), field + ".width")};
    case pb::Outline::kPolygon: {
      PolygonOutline polygon;
      for (const pb::Point& corner : message.polygon().corners())
        polygon.corners.push_back(point(corner, field + ".corners"));
      const bool good = polygon.corners.size() <= kMostCorners && !flaw_of(polygon.corners) &&
                        signed_area(polygon.corners) > 0 && is_convex(polygon.corners);
      if (!good) complain(field + ".corners", "an outline that is not convex with 3 to 8 corners");
      return polygon;
    }
    case pb::Outline::SHAPE_NOT_SET:
      complain(field, "a solid without an outline");
      break;
  }
  return CircleOutline{};
}

Patch ArenaReader::patch(const pb::Patch& message, const std::string& field) {
  Patch patch;
  patch.color = color(message.color(), field + ".color");
  switch (message.shape_case()) {
    case pb::Patch::kDisc:
      patch.shape = disc(message.disc(), field);
      break;
    case pb::Patch::kRectangle:
      patch.shape = rectangle(message.rectangle(), field);
      break;
    case pb::Patch::kImage: {
      auto picture = Picture::from_png(message.image().png(), 2 * Picture::kMostPixelsInUse);
      if (!picture) {
        complain(field + ".image", picture.error().message);
        break;
      }
      patch.shape = FloorImage{rectangle(message.image().area(), field), std::move(*picture)};
      break;
    }
    case pb::Patch::SHAPE_NOT_SET:
      complain(field, "a patch without a shape");
      break;
  }
  return patch;
}

Arena ArenaReader::arena(const pb::Arena& message) {
  Arena arena;
  for (const pb::Wall& wall : message.walls()) {
    arena.walls.push_back(
        {point(wall.from(), "arena.walls.from"), point(wall.to(), "arena.walls.to")});
  }
  if (const auto flaw = flaw_of(corners_of(arena))) complain("arena.walls", *flaw);
  arena.wall_height_m = size(message.wall_height_m(), "arena.wall_height");
  arena.floor = color(message.floor(), "arena.floor");
  for (const pb::Patch& one : message.patches())
    arena.patches.push_back(patch(one, "arena.patches"));
  for (const pb::Obstacle& one : message.obstacles()) {
    arena.obstacles.push_back({outline(one.outline(), "arena.obstacles"),
                               pose(one.pose(), "arena.obstacles.pose"),
                               size(one.height_m(), "arena.obstacles.height")});
  }
  for (const pb::MovableObject& one : message.objects()) {
    const std::string field = "arena.objects";
    const double friction_N = number(one.friction_n(), field + ".friction");
    if (friction_N < 0) complain(field + ".friction", "a negative friction");
    arena.objects.push_back({outline(one.outline(), field), pose(one.start(), field + ".start"),
                             size(one.mass_kg(), field + ".mass"), friction_N,
                             size(one.height_m(), field + ".height")});
  }
  for (const pb::Light& one : message.lights()) {
    arena.lights.push_back({number(one.x_m(), "arena.lights"), number(one.y_m(), "arena.lights"),
                            number(one.z_m(), "arena.lights"),
                            number(one.intensity_cd(), "arena.lights")});
  }
  return arena;
}

}  // namespace swarmsmith
