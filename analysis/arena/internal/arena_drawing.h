#pragma once

#include <cstddef>

#include "analysis/arena/arena_picture.h"
#include "analysis/arena/internal/arena_view.h"
#include "analysis/drawing/svg.h"

namespace swarmsmith {

/// In swarms up to this size, each robot is drawn with its own colour and number.
inline constexpr std::size_t kMostNamedRobots = 8;

/// The complete picture with its texts.
Svg drawing_of(const ArenaPicture& picture);

/// Floor, patches, walls, and the obstacles.
void draw_place(Svg& svg, const ArenaPicture& picture, const ArenaView& view);

/// Movable objects: their paths, and their places.
void draw_objects(Svg& svg, const ArenaPicture& picture, const ArenaView& view);

/// Trails and starts, with the bodies on top.
void draw_robots(Svg& svg, const ArenaPicture& picture, const ArenaView& view);

/// Draws a light as a small sun.
void draw_light(Svg& svg, PagePoint centre);

/// Draws a bar of 1, 2 or 5 times a power of ten metres, at most a quarter of the picture wide.
void draw_scale(Svg& svg, const ArenaView& view, double top);

}  // namespace swarmsmith
