#pragma once

#include <string>

#include "base/math.h"
#include "base/rng.h"
#include "sim/mission/mission.h"
#include "sim/mission/polygon.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {

/// The picture of examples/missions: 52 x 52 pixels, a yellow ring on grey.
inline std::shared_ptr<const Picture> ring_picture() {
  return Picture::from_png(whole_file(SWARMSMITH_SOURCE_DIR "/examples/missions/ring.png")).value();
}

inline Rgb random_color(Rng& rng) {
  const auto channel = [&rng] { return static_cast<std::uint8_t>(rng.below(256)); };
  const std::uint8_t r = channel();
  const std::uint8_t g = channel();
  return {r, g, channel()};
}

inline Outline random_outline(Rng& rng, double least_m, double most_m) {
  switch (rng.below(3)) {
    case 0:
      return CircleOutline{rng.uniform(least_m, most_m) / 2};
    case 1: {
      const double length_m = rng.uniform(least_m, most_m);
      return BoxOutline{length_m, rng.uniform(least_m, most_m)};
    }
    default: {
      const int sides = static_cast<int>(rng.uniform_int(3, 8));
      std::vector<Point> corners = regular_polygon(sides, rng.uniform(least_m, most_m) / 4);
      // Not regular, and with the origin where a reader would put it.
      for (Point& corner : corners)
        corner.x *= 0.7;
      const Point middle = centroid(corners);
      for (Point& corner : corners)
        corner = {corner.x - middle.x, corner.y - middle.y};
      return PolygonOutline{std::move(corners)};
    }
  }
}

inline Placement random_placement(Rng& rng, int robots) {
  switch (rng.below(4)) {
    case 0:
      return PlaceInDisc{.centre = {rng.uniform(-0.1, 0.1), 0}, .radius_m = rng.uniform(2, 3)};
    case 1:
      return PlaceInRectangle{{{0, rng.uniform(-0.1, 0.1)}, rng.uniform(3, 4), 3.5}};
    case 2:
      return PlaceAnywhere{};
    default: {
      PlaceAt fixed;
      for (int i = 0; i < robots; ++i)
        fixed.poses.push_back({-1 + 0.7 * i, 1.8, rng.uniform(-3, 3)});
      return fixed;
    }
  }
}

/// A mission with something in every field, numbers of all bits: a star-shaped arena that is seldom
/// convex, obstacles within 1 m of its middle, objects outside of that.
inline Mission random_mission(std::uint64_t seed) {
  Rng rng(seed);
  Mission mission;
  mission.name = "random" + std::to_string(seed);
  std::vector<Point> corners;
  const int count = static_cast<int>(rng.uniform_int(8, 14));
  for (int k = 0; k < count; ++k) {
    const SinCos at = sin_cos(2 * kPi * (k + rng.uniform(-0.2, 0.2)) / count);
    const double radius_m = rng.uniform(2.6, 4);
    corners.push_back({radius_m * at.cos, radius_m * at.sin});
  }
  Arena& arena = mission.arena;
  arena.walls = walls_around(std::move(corners));
  arena.wall_height_m = rng.uniform(0.05, 1);
  arena.floor = random_color(rng);
  arena.patches = {
      {Disc{{rng.uniform(-1, 1), rng.uniform(-1, 1)}, rng.uniform(0.1, 1)}, random_color(rng)},
      {FloorImage{{{rng.uniform(-1, 1), 0}, rng.uniform(1, 2), rng.uniform(1, 2)}, ring_picture()},
       {}},
      {Rectangle{{0, rng.uniform(-1, 1)}, rng.uniform(0.1, 1), 0.5}, random_color(rng)}};
  for (int i = 0; i < 3; ++i) {
    arena.obstacles.push_back({random_outline(rng, 0.1, 0.6),
                               {rng.uniform(-0.9, 0.9), rng.uniform(-0.9, 0.9), rng.uniform(-3, 3)},
                               rng.uniform(0.1, 1)});
  }
  for (const double x : {-1.8, 1.8}) {
    arena.objects.push_back({random_outline(rng, 0.1, 0.4),
                             {x, rng.uniform(-0.2, 0.2), rng.uniform(-3, 3)},
                             rng.uniform(0.1, 5),
                             rng.uniform(0, 4),
                             rng.uniform(0.1, 1)});
  }
  arena.lights = {{rng.uniform(-5, 5), rng.uniform(-5, 5), rng.uniform(), rng.uniform(1, 5000)}};
  mission.shuffled.places = {{{rng.uniform(), 0.5}, 0.1, 0.2}, {{rng.uniform(), 0}, 0.2, 0.1}};
  mission.shuffled.shares = {{{9, 8, 7}, 1}};
  mission.robots = static_cast<int>(rng.uniform_int(1, 4));
  mission.robot.body.outline = random_outline(rng, 0.1, 0.3);
  mission.cycles = static_cast<int>(rng.uniform_int(1, 5000));
  mission.placement = random_placement(rng, mission.robots);
  mission.rule = RobotsOn{random_color(rng)};
  return mission;
}

}  // namespace swarmsmith
