#include "tracking/detection/tag_detector.h"

#include <apriltag/apriltag.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <string_view>
#include <tuple>

#include "tracking/detection/internal/family_library.h"
#include "tracking/geometry/tag_family.h"

namespace swarmsmith {
namespace {

/// The library's table grows with codes x bits^n: with 2 bits it needs 3 GB for tagStandard52h13,
/// and no search accepts more than 1.
constexpr int kBitsCorrected = 1;

/// In a smaller image the library has no tiles for thresholds, and no tag can be read.
constexpr int kLeastSide = 16;

/// The centre of a pixel is at 0.5 for the library, and at 0 for us.
constexpr double kPixelMiddle = 0.5;

Detection detection_of(const apriltag_detection_t& found, const PixelBox& box) {
  Detection detection;
  detection.tag = found.id;
  for (std::size_t i = 0; i < detection.corners.size(); ++i)
    detection.corners[i] = {found.p[i][0] + box.left - kPixelMiddle,
                            found.p[i][1] + box.top - kPixelMiddle};
  detection.hamming = found.hamming;
  detection.margin = static_cast<double>(found.decision_margin);
  return detection;
}

}  // namespace

ImagePoint middle_of(const TagCorners& corners) {
  ImagePoint sum;
  for (const ImagePoint& corner : corners) {
    sum.u += corner.u;
    sum.v += corner.v;
  }
  return {sum.u / 4, sum.v / 4};
}

/// Detectors write to their family, so each detector has its own.
struct TagDetector::Library {
  FamilyPointer family;
  apriltag_detector_t* detector;

  explicit Library(FamilyPointer of) : family(std::move(of)), detector(apriltag_detector_create()) {
    apriltag_detector_add_family_bits(detector, family.get(), kBitsCorrected);
    detector->nthreads = 1;
    detector->refine_edges = true;
  }
  ~Library() { apriltag_detector_destroy(detector); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

TagDetector::TagDetector(std::unique_ptr<Library> library) : library_(std::move(library)) {}
TagDetector::TagDetector(TagDetector&&) noexcept = default;
TagDetector& TagDetector::operator=(TagDetector&&) noexcept = default;
TagDetector::~TagDetector() = default;

Expected<TagDetector> TagDetector::of_family(const std::string& family) {
  FamilyPointer found = tag_family_of(family);
  if (found) return TagDetector(std::make_unique<Library>(std::move(found)));
  std::string known;
  for (const TagFamily& each : known_tag_families())
    known += (known.empty() ? "" : ", ") + std::string(each.name);
  return bad_input("there is no tag family '" + family + "'; known are " + known);
}

std::vector<Detection> TagDetector::find(const GrayImage& image, const PixelBox& box,
                                         int decimate) {
  assert(decimate >= 1);
  const PixelBox inside{std::max(box.left, 0), std::max(box.top, 0),
                        std::min(box.right, image.width), std::min(box.bottom, image.height)};
  const int width = inside.right - inside.left;
  const int height = inside.bottom - inside.top;
  if (std::min(width, height) < kLeastSide * decimate) return {};
  const std::uint8_t* const corner =
      image.pixels + static_cast<std::ptrdiff_t>(inside.top) * image.stride + inside.left;
  // The library only reads the pixels, although its type is not constant.
  image_u8_t crop{width, height, static_cast<std::int32_t>(image.stride),
                  const_cast<std::uint8_t*>(corner)};
  library_->detector->quad_decimate = static_cast<float>(decimate);
  zarray_t* const found = apriltag_detector_detect(library_->detector, &crop);
  std::vector<Detection> detections;
  for (int i = 0; i < zarray_size(found); ++i) {
    apriltag_detection_t* each = nullptr;
    zarray_get(found, i, static_cast<void*>(&each));
    detections.push_back(detection_of(*each, inside));
  }
  apriltag_detections_destroy(found);
  std::sort(detections.begin(), detections.end(), [](const Detection& a, const Detection& b) {
    return std::tuple(a.tag, -a.margin, a.corners[0].u, a.corners[0].v) <
           std::tuple(b.tag, -b.margin, b.corners[0].u, b.corners[0].v);
  });
  return detections;
}

std::vector<Detection> TagDetector::find(const GrayImage& image, int decimate) {
  return find(image, {0, 0, image.width, image.height}, decimate);
}

std::vector<int> mirrored_tags(TagDetector& detector, const GrayImage& image) {
  std::vector<std::uint8_t> mirrored;
  mirrored.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  for (int row = 0; row < image.height; ++row) {
    const std::uint8_t* const first =
        image.pixels + static_cast<std::ptrdiff_t>(row) * image.stride;
    mirrored.insert(mirrored.end(), std::reverse_iterator(first + image.width),
                    std::reverse_iterator(first));
  }
  std::vector<int> tags;
  for (const Detection& tag :
       detector.find({mirrored.data(), image.width, image.height, image.width}, 1)) {
    if (tag.hamming == 0) tags.push_back(tag.tag);
  }
  return tags;
}

bool is_mirrored(TagDetector& detector, const GrayImage& image) {
  const auto is_whole = [](const Detection& tag) { return tag.hamming == 0; };
  return std::ranges::none_of(detector.find(image, 1), is_whole) &&
         !mirrored_tags(detector, image).empty();
}

}  // namespace swarmsmith
