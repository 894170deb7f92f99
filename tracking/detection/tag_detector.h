#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/expected.h"
#include "tracking/geometry/tag_pose.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// A tag found in an image.
struct Detection {
  int tag = 0;
  TagCorners corners{};  ///< in pixels as for ImagePoint, not as in the library
  int hamming = 0;
  double margin = 0;
};

/// The mean of a tag's corners.
ImagePoint middle_of(const TagCorners& corners);

/// A part of an image, in pixels, without the right and bottom edges.
struct PixelBox {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
};

/// Finds AprilTags (Olson 2011, Wang and Olson 2016) with the apriltag library; a code with more
/// than one wrong bit does not count as a tag. Not thread-safe; create one per thread.
class TagDetector {
 public:
  /// BadInput for a family that is not in known_tag_families().
  static Expected<TagDetector> of_family(const std::string& family);
  TagDetector(TagDetector&&) noexcept;
  TagDetector& operator=(TagDetector&&) noexcept;
  ~TagDetector();

  /// Finds the tags in a part of the image; the part is clipped to the image. It is searched at
  /// 1/`decimate` of its resolution, and corners are refined at full resolution. Sorted by tag
  /// number, then by margin, largest first.
  std::vector<Detection> find(const GrayImage& image, const PixelBox& box, int decimate);
  std::vector<Detection> find(const GrayImage& image, int decimate);

 private:
  struct Library;
  explicit TagDetector(std::unique_ptr<Library> library);
  std::unique_ptr<Library> library_;
};

/// The numbers of tags that are seen mirrored, and read without a wrong bit.
std::vector<int> mirrored_tags(TagDetector& detector, const GrayImage& image);
/// Whether an image is mirrored. No tag can be found in such an image, whatever the light.
bool is_mirrored(TagDetector& detector, const GrayImage& image);
/// The advice for mirrored images.
inline constexpr const char* kMirroredAdvice =
    "the pictures are mirrored: tags are found only in their mirror image; turn mirroring off in "
    "the camera's settings, and calibrate from pictures that are not mirrored";

}  // namespace swarmsmith
