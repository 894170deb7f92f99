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
  TagCorners corners{};  ///< pixels as ImagePoint has them, not as the library
  int hamming = 0;
  double margin = 0;
};

/// The mean of its corners.
ImagePoint middle_of(const TagCorners& corners);

/// A part of an image, pixels; right and bottom edges do not belong to it.
struct PixelBox {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
};

/// Finds AprilTags (Olson 2011, Wang and Olson 2016) with the apriltag library; codes with more
/// than one wrong bit are not tags. Not for two threads at once; each makes its own.
class TagDetector {
 public:
  /// BadInput for a family that is not among known_tag_families().
  static Expected<TagDetector> of_family(const std::string& family);
  TagDetector(TagDetector&&) noexcept;
  TagDetector& operator=(TagDetector&&) noexcept;
  ~TagDetector();

  /// Tags of a part of the image, cut off at its edges; searched at 1/`decimate` of its resolution;
  /// corners are refined at full resolution. Sorted by tag, then by margin, best first.
  std::vector<Detection> find(const GrayImage& image, const PixelBox& box, int decimate);
  std::vector<Detection> find(const GrayImage& image, int decimate);

 private:
  struct Library;
  explicit TagDetector(std::unique_ptr<Library> library);
  std::unique_ptr<Library> library_;
};

/// Tags, read without an error, that are the mirror images of tags, by number.
std::vector<int> mirrored_tags(TagDetector& detector, const GrayImage& image);
/// Whether an image shows tags as a mirror does: then none is found in it, whatever the light.
bool is_mirrored(TagDetector& detector, const GrayImage& image);
/// What to do about it.
inline constexpr const char* kMirroredAdvice =
    "the pictures are mirrored: tags are found in their mirror image alone; turn mirroring off in "
    "the camera's settings, and calibrate from pictures that are not mirrored";

}  // namespace swarmsmith
