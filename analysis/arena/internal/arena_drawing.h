#pragma once

#include <cstddef>

#include "analysis/arena/arena_picture.h"
#include "analysis/arena/internal/arena_view.h"
#include "analysis/drawing/svg.h"

namespace swarmsmith {

/// Swarms up to this size show each robot apart.
inline constexpr std::size_t kMostNamedRobots = 8;

/// The whole picture, with its texts.
Svg drawing_of(const ArenaPicture& picture);

/// Floor, patches, walls, and the obstacles.
void draw_place(Svg& svg, const ArenaPicture& picture, const ArenaView& view);

/// Movable objects: where they went, and where they were.
void draw_objects(Svg& svg, const ArenaPicture& picture, const ArenaView& view);

/// Trails, starts, and bodies on top.
void draw_robots(Svg& svg, const ArenaPicture& picture, const ArenaView& view);

/// A small sun.
void draw_light(Svg& svg, PagePoint centre);

/// A bar of 1, 2 or 5 times a power of ten metres, at most a quarter of the picture.
void draw_scale(Svg& svg, const ArenaView& view, double top);

}  // namespace swarmsmith
