#pragma once

#include <cstdint>
#include <memory>

#include "tests/support/film/lens_map.h"
#include "tests/support/film/scene.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith::film {

/// Takes pictures of a scene. The background is painted once; in each picture only the surroundings
/// of what moves are painted anew, by 4 x 4 samples a pixel, which motion blur spreads over the
/// exposure; then blur, then noise. Pictures depend on scene, shooting, seed and the arguments, not
/// on the pictures before.
class VirtualCamera {
 public:
  /// `lens` is that of shooting.view.camera (it takes a while to make, and cameras can share it).
  VirtualCamera(Scene scene, Shooting shooting, std::shared_ptr<const LensMap> lens,
                std::uint64_t seed);
  VirtualCamera(Scene scene, Shooting shooting, std::uint64_t seed);
  VirtualCamera(VirtualCamera&&) noexcept;
  VirtualCamera& operator=(VirtualCamera&&) noexcept;
  ~VirtualCamera();

  /// `time_s`: the middle of the exposure of the first row; `number` chooses the noise.
  ColorImage picture(double time_s, std::int64_t number) const;

  /// Where the corners of a robot's tag are in the picture of that time, each row at its own
  /// instant.
  TagCorners corners_of_robot(std::size_t robot, double time_s) const;
  const Scene& scene() const;
  const Shooting& shooting() const;

 private:
  struct Stage;
  std::unique_ptr<Stage> stage_;
};

/// Brightness as video codecs have it (ITU-R BT.601), row by row.
std::vector<std::uint8_t> gray_of(const ColorImage& image);
/// The same pixels as a GrayImage that belongs to the vector.
GrayImage as_gray_image(const std::vector<std::uint8_t>& gray, ImageSize size);

}  // namespace swarmsmith::film
