#pragma once

#include <array>
#include <span>
#include <vector>

#include "tests/support/film/cell_picture.h"
#include "tests/support/film/lens_map.h"
#include "tests/support/film/scene.h"

namespace swarmsmith::film {

/// Samples of a pixel along each axis.
inline constexpr int kFine = 4;
inline constexpr int kSamples = kFine * kFine;

/// Blue, green, red, 0 to 255.
using Bgr = std::array<float, 3>;

/// Turning and place of a thing on the floor.
struct Placing {
  float c = 1, s = 0, x = 0, y = 0;
};

/// Where a thing is at each of a pixel's samples in time; one when nothing moves.
using Placings = std::vector<Placing>;

/// A tag on its plate, at a height.
struct Plate {
  const CellPicture* picture = nullptr;
  float height_m = 0;
  float cell_m = 0;
  float half_m = 0;  ///< of the plate
};

/// The box below a plate.
struct Body {
  float half_m = 0;
  float height_m = 0;
};

/// A robot or a loose tag, at one time or at a pixel's times.
struct Painted {
  Plate plate;
  Body body;        ///< half_m 0: none
  Placings tags;    ///< of the plate; one or kSamples
  Placings robots;  ///< of the body
};

/// The four by four samples of a pixel, brought to a plane at height z of the floor map.
struct PixelSamples {
  std::array<float, kSamples> x{};
  std::array<float, kSamples> y{};
};

/// Paints one thing on the samples of a pixel: `colors` where it covers, untouched elsewhere.
/// `camera` is where it hangs.
void paint(const Painted& thing, const Footprint& pixel, const Point3& camera,
           std::array<Bgr, kSamples>& colors);

/// The arm over the samples of a pixel.
void paint(const Arm& arm, const Footprint& pixel, const Point3& camera,
           std::array<Bgr, kSamples>& colors);

/// The colour of the arena as seen along one ray: floor, walls, and what is around. `corners` are
/// the arena's, which a picture of millions of rays asks for once.
Bgr arena_color(const Arena& arena, std::span<const Point> corners, const Point3& camera,
                Point floor);

/// The moment of a sample within the exposure, -0.5 to 0.5: each row and column of samples has
/// early and late ones, so that no edge is seen at one time only.
float moment_of(int sample);

}  // namespace swarmsmith::film
